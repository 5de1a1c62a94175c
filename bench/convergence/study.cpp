#include "study.hpp"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace convergence {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double squared(double x) {
    return x * x;
}

// The least-squares slope of log relative error over log effort, without one of the seeds. A point whose error vanishes in
// that of the reference says nothing.
double slope_without(const Series& series, Over over, std::size_t left_out) {
    std::vector<double> x, y;
    for (std::size_t point = 0; point < series.samples.size(); ++point) {
        double time = 0, error = 0;
        for (std::size_t seed = 0; seed < series.runs.size(); ++seed) {
            if (seed == left_out) continue;
            time += series.runs[seed][point].cpu_seconds;
            error += series.runs[seed][point].relative_squared_error;
        }
        if (!(error > 0 && time > 0)) continue;
        x.push_back(std::log(over == Over::CpuTime ? time : static_cast<double>(series.samples[point])));
        y.push_back(0.5 * std::log(error));
    }
    if (x.size() < 2) return nan;
    const auto count = static_cast<double>(x.size());
    const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / count;
    double xx = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * y[i];
    }
    return xy / xx;
}

// The least error that the slope of an integral can have: the logarithm of a mean over n squares of normal errors has the
// variance 2 / n, which a few seeds that lie together by chance do not show.
double slope_error_of_normal(const Series& series) {
    const std::size_t points = series.samples.size();
    if (std::isnan(series.pooled.mean) || series.runs_per_seed.size() != points) return 0;
    Moments x;
    for (const std::int64_t samples : series.samples) x.add(std::log(static_cast<double>(samples)));
    double variance = 0;
    const double xx = x.variance() * static_cast<double>(points - 1);
    for (std::size_t i = 0; i < points; ++i) {
        const auto runs = static_cast<double>(series.runs_per_seed[i]) * static_cast<double>(series.runs.size());
        variance += squared((std::log(static_cast<double>(series.samples[i])) - x.mean()) / xx) / (2 * runs);
    }
    return std::sqrt(variance);
}

// Student's t with one degree of freedom less than there are seeds: exceeded with the probability `tail`.
double student_t(const Series& series, double tail) {
    if (series.runs.size() < 2) return nan;
    const boost::math::students_t t{static_cast<double>(series.runs.size() - 1)};
    return quantile(complement(t, tail));
}

// Where the efficiency is read off, and the time to an error: an unbiased estimator's are the same at every sample count.
std::size_t firmest_point(const Series& series) {
    const std::size_t last = series.samples.size() - 1;
    if (!series.unbiased || series.is_whole || verdict(series) == Verdict::Plateau || series.runs_per_seed.empty()) {
        return last;
    }
    std::size_t best = last;
    for (std::size_t i = 0; i < last; ++i) {
        if (series.runs_per_seed[i] > series.runs_per_seed[best]) best = i;
    }
    return best;
}

}  // namespace

Estimate ratio(const Moments& numerator, const Moments& denominator) {
    const double value = numerator.mean() / denominator.mean();
    return {value, value * std::hypot(numerator.standard_error() / numerator.mean(),
                                      denominator.standard_error() / denominator.mean())};
}

Estimate slope(const Series& series, Over over) {
    const std::size_t seeds = series.runs.size();
    Moments without_one;
    for (std::size_t seed = 0; seed < seeds; ++seed) without_one.add(slope_without(series, over, seed));
    const double variance_factor = squared(static_cast<double>(seeds) - 1) / static_cast<double>(seeds);
    const double jackknife = std::sqrt(variance_factor * without_one.variance());
    return {slope_without(series, over, seeds), std::max(jackknife, slope_error_of_normal(series))};
}

Estimate root_mean_square(const Series& series, std::size_t point) {
    const auto errors = series.over_seeds(point, &Measurement::squared_error);
    const double root = std::sqrt(std::max(errors.mean(), 0.0));
    return {root, errors.standard_error() / (2 * root)};
}

Band relative_error(const Series& series, std::size_t point) {
    const auto errors = series.over_seeds(point, &Measurement::relative_squared_error);
    const double root = std::sqrt(std::max(errors.mean(), 0.0));
    const double half_width = student_t(series, 0.025) * errors.standard_error() / (2 * errors.mean());
    return {root, root * std::exp(-half_width), root * std::exp(half_width)};
}

Spread spread(const Series& series) {
    const std::size_t point = firmest_point(series);
    const double root = relative_error(series, point).value;
    if (!(root > 0 && std::isfinite(root))) return {nan, nan, nan, nan, nan};
    std::vector<double> errors;
    for (const auto& run : series.runs) {
        errors.push_back(std::sqrt(std::max(run[point].relative_squared_error, 0.0)) / root);
    }
    std::ranges::sort(errors);
    const auto quantile = [&errors](double part) {
        const double place = part * static_cast<double>(errors.size() - 1);
        const auto below = static_cast<std::size_t>(place), above = std::min(below + 1, errors.size() - 1);
        return std::lerp(errors[below], errors[above], place - static_cast<double>(below));
    };
    return {errors.front(), quantile(0.25), quantile(0.5), quantile(0.75), errors.back()};
}

double slope_limit(const Series& series) {
    return student_t(series, Rules::slope_significance / 2);
}

double tail_share(std::vector<double> squares) {
    const double all = std::accumulate(squares.begin(), squares.end(), 0.0);
    if (all == 0) return 0;
    if (!std::isfinite(all)) return nan;  // and NaN has no place in an order
    const auto largest = squares.begin() + static_cast<std::ptrdiff_t>((squares.size() + 999) / 1000);
    std::nth_element(squares.begin(), largest - 1, squares.end(), std::greater<>{});
    return std::accumulate(squares.begin(), largest, 0.0) / all;
}

Pooled pool(std::span<const double> means, double answer, double answer_error) {
    Moments moments;
    for (const double mean : means) moments.add(mean);
    std::vector<double> squares;
    for (const double mean : means) squares.push_back(squared(mean - moments.mean()));
    // Sums of numbers in double are off by their rounding, whatever their spread.
    const double rounding = 1e-13 * answer;
    const double error = std::hypot(moments.standard_error(), answer_error, rounding);
    const bool no_hits = std::ranges::all_of(means, [](double mean) { return mean == 0; });
    return {moments.mean(), moments.standard_error(), (moments.mean() - answer) / error, tail_share(std::move(squares)),
            no_hits};
}

Verdict verdict(const Series& series) {
    bool exact = true;
    for (std::size_t i = 0; i < series.samples.size(); ++i) {
        const double squared_error = series.over_seeds(i, &Measurement::relative_squared_error).mean();
        if (!std::isfinite(squared_error)) return Verdict::NotFinite;
        exact = exact && std::abs(squared_error) <= squared(1e-12);  // below 0: lost in the reference's own
    }
    if (exact) return Verdict::Exact;
    if (series.pooled.no_hits) return Verdict::NoHits;
    const bool image = std::isnan(series.pooled.mean);
    const double tail_limit = image ? Rules::tail_share_limit_of_images : Rules::tail_share_limit;
    if (series.pooled.tail_share > tail_limit) return Verdict::HeavyTails;
    if (std::abs(series.pooled.bias_z) > Rules::bias_z_limit) return Verdict::Plateau;
    const Estimate exponent = slope(series, Over::Samples);
    const double beyond = exponent.value + 0.5, limit = slope_limit(series) * exponent.standard_error;
    const bool as_expected = (series.is_whole ? beyond : std::abs(beyond)) <= limit;
    return as_expected ? Verdict::Converges : Verdict::Unexplained;
}

std::string_view name(Verdict verdict) {
    switch (verdict) {
        case Verdict::NotFinite:
            return "not finite";
        case Verdict::NoHits:
            return "no hits";
        case Verdict::Exact:
            return "exact";
        case Verdict::HeavyTails:
            return "heavy tails";
        case Verdict::Plateau:
            return "plateau";
        case Verdict::Converges:
            return "converges";
        case Verdict::Unexplained:
            break;
    }
    return "unexplained";
}

std::optional<Effort> effort_to(const Series& series, double target) {
    const auto at = [&](std::size_t point) {
        return Effort{static_cast<double>(series.samples[point]),
                      series.over_seeds(point, &Measurement::cpu_seconds).mean(), false};
    };
    const auto by_slope = [&](std::size_t point, bool is_beyond) {
        const Effort from = at(point);
        const double samples = std::max(from.samples * squared(relative_error(series, point).value / target), 1.0);
        return Effort{samples, from.cpu_seconds * (samples / from.samples), is_beyond};
    };
    const Verdict found = verdict(series);
    if (found == Verdict::NotFinite || found == Verdict::NoHits) return {};
    const std::size_t points = series.samples.size();
    std::size_t reached = 0;
    while (reached < points && !(relative_error(series, reached).value <= target)) ++reached;
    const bool is_beyond = reached == 0 || reached == points;
    if (series.unbiased && !series.is_whole && found == Verdict::Converges)
        return by_slope(firmest_point(series), is_beyond);
    if (reached == 0) return by_slope(0, is_beyond);
    if (reached == points) {
        if (!series.unbiased || found == Verdict::Plateau) return {};
        return by_slope(points - 1, is_beyond);
    }
    const double before = relative_error(series, reached - 1).value, after = relative_error(series, reached).value;
    const Effort low = at(reached - 1), high = at(reached);
    const double part = after > 0 ? std::log(before / target) / std::log(before / after) : 1;
    return Effort{low.samples * std::pow(high.samples / low.samples, part),
                  low.cpu_seconds * std::pow(high.cpu_seconds / low.cpu_seconds, part), false};
}

Estimate efficiency(const Series& series) {
    const Verdict found = verdict(series);
    if (found == Verdict::NotFinite || found == Verdict::NoHits || found == Verdict::Exact) return {nan, nan};
    const std::size_t point = firmest_point(series);
    const auto error = series.over_seeds(point, &Measurement::relative_squared_error),
               time = series.over_seeds(point, &Measurement::cpu_seconds);
    if (!(error.mean() > 0 && time.mean() > 0)) return {nan, nan};
    const double value = 1 / (error.mean() * time.mean());
    return {value, value * std::hypot(error.standard_error() / error.mean(), time.standard_error() / time.mean())};
}

Estimate relative_efficiency(const Series& series, const Series& baseline) {
    const Estimate own = efficiency(series), base = efficiency(baseline);
    const double value = own.value / base.value;
    if (&series == &baseline) return {value, 0};
    return {value, value * std::hypot(own.standard_error / own.value, base.standard_error / base.value)};
}

const Series& baseline(const Study& study) {
    const auto is_known = [](const Series& series) { return !std::isnan(efficiency(series).value); };
    const auto power = std::ranges::find(study.series, "power", &Series::name);
    if (power != study.series.end() && is_known(*power)) return *power;
    const auto first = std::ranges::find_if(study.series, is_known);
    return first == study.series.end() ? study.series.front() : *first;
}

std::vector<std::int64_t> doubling_up_to(std::int64_t largest) {
    std::vector<std::int64_t> counts;
    for (std::int64_t n = largest; n >= 1; n /= 2) counts.insert(counts.begin(), n);
    return counts;
}

}  // namespace convergence
