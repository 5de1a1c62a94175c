#include "study.hpp"

namespace convergence {

Estimate slope(const Series& series) {
    lumis::RunningMoments<> slopes;
    for (const auto& run : series.runs) {
        lumis::RunningMoments<> x, y;
        for (const Measurement& m : run) {
            x.add(std::log(m.cpu_seconds));
            y.add(0.5 * std::log(m.relative_squared_error));
        }
        double xx = 0, xy = 0;
        for (const Measurement& m : run) {
            const double from_mean = std::log(m.cpu_seconds) - x.mean();
            xx += from_mean * from_mean;
            xy += from_mean * (0.5 * std::log(m.relative_squared_error) - y.mean());
        }
        slopes.add(xy / xx);
    }
    return {slopes.mean(), slopes.standard_error()};
}

Estimate root_mean_square(const Series& series, std::size_t point) {
    const auto squared = series.over_seeds(point, &Measurement::squared_error);
    const double root = std::sqrt(std::max(squared.mean(), 0.0));
    return {root, squared.standard_error() / (2 * root)};
}

Estimate relative_efficiency(const Series& series, const Series& baseline) {
    if (&series == &baseline) return {1, 0};
    const auto at_end = [](const Series& s, double Measurement::*figure) {
        return s.over_seeds(s.samples.size() - 1, figure);
    };
    const auto error = [&](const Series& s) { return at_end(s, &Measurement::relative_squared_error); };
    const auto time = [&](const Series& s) { return at_end(s, &Measurement::cpu_seconds); };
    const auto relative_variance = [](const lumis::RunningMoments<>& m) {
        return std::pow(m.standard_error() / m.mean(), 2);
    };
    const double ratio = error(baseline).mean() * time(baseline).mean() / (error(series).mean() * time(series).mean());
    const double variance = relative_variance(error(baseline)) + relative_variance(time(baseline)) +
                            relative_variance(error(series)) + relative_variance(time(series));
    return {ratio, ratio * std::sqrt(variance)};
}

const Series& baseline(const Study& study) {
    return *std::ranges::find(study.series, "power", &Series::name);
}

std::vector<std::int64_t> doubling_up_to(std::int64_t largest) {
    std::vector<std::int64_t> counts;
    for (std::int64_t n = largest; n >= 1; n /= 2) counts.insert(counts.begin(), n);
    return counts;
}

}  // namespace convergence
