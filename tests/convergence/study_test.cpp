// The statistics of the report, on synthetic runs whose answers are known.
#include "study.hpp"

#include "catch.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace convergence;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

// 8 seeds of 256 pieces of `count` estimates; the mean of a piece is piece(engine). A sample takes a microsecond.
template <class Piece>
Series measured(Piece piece, double answer, std::int64_t count = 100) {
    constexpr std::size_t seeds = 8, pieces = 256;
    Series series;
    series.name = "synthetic";
    for (std::size_t n = pieces, length = 1; n >= 1; n /= 4, length *= 4) {
        series.samples.push_back(count * static_cast<std::int64_t>(length));
        series.runs_per_seed.push_back(static_cast<std::int64_t>(n));
    }
    std::vector<double> all;
    for (std::size_t seed = 0; seed < seeds; ++seed) {
        std::mt19937_64 engine{seed};
        std::vector<double> means(pieces);
        for (double& mean : means) mean = piece(engine);
        all.insert(all.end(), means.begin(), means.end());
        std::vector<Measurement> run;
        for (const std::int64_t samples : series.samples) {
            lumis::RunningMoments<> squares;
            for (const double mean : means) squares.add((mean - answer) * (mean - answer));
            const double seconds = 1e-6 * static_cast<double>(samples);
            run.push_back({seconds, seconds, squares.mean(), squares.mean() / (answer * answer)});
            for (std::size_t i = 0; i < means.size() / 4; ++i) {
                means[i] = (means[4 * i] + means[4 * i + 1] + means[4 * i + 2] + means[4 * i + 3]) / 4;
            }
            means.resize(means.size() / 4);
        }
        series.runs.push_back(run);
    }
    series.pooled = pool(all, answer, 0);
    return series;
}

Series normal(double mean, double deviation) {
    return measured([=](auto& engine) { return std::normal_distribution{mean, deviation}(engine); }, 2);
}

// Errors that follow a power of the time exactly.
Series power_law(double constant, double exponent) {
    Series series;
    for (const std::int64_t samples : {100, 400, 1600}) series.samples.push_back(samples);
    for (int seed = 0; seed < 4; ++seed) {
        std::vector<Measurement> run;
        for (const std::int64_t samples : series.samples) {
            const double seconds = 1e-3 * static_cast<double>(samples);
            const double error = constant * std::pow(seconds, exponent);
            run.push_back({seconds, seconds, error * error, error * error});
        }
        series.runs.push_back(run);
    }
    return series;
}

}  // namespace

TEST_CASE("the slope of an exact power law is its exponent") {
    for (const double exponent : {-0.5, -1.0, 0.0}) {
        const Estimate fit = slope(power_law(0.2, exponent));
        CHECK_THAT(fit.value, WithinAbs(exponent, 1e-12));
        CHECK(fit.standard_error <= 1e-12);
    }
}

TEST_CASE("the jackknife's error is that of the slope") {
    // Over many studies, slopes stray about -1/2 by what each of them claims.
    lumis::RunningMoments<> slopes, claims;
    std::mt19937_64 seeds{1};
    for (int i = 0; i < 200; ++i) {
        std::mt19937_64 noise{seeds()};
        const Estimate fit = slope(measured([&](auto&) { return std::normal_distribution{2.0, 0.1}(noise); }, 2));
        slopes.add(fit.value);
        claims.add(fit.standard_error);
    }
    CHECK_THAT(slopes.mean(), WithinAbs(-0.5, 0.02));  // the logarithm of a mean square of few is biased
    CHECK_THAT(claims.mean(), WithinRel(std::sqrt(slopes.variance()), 0.25));
}

TEST_CASE("seeds that lie together by chance do not make a slope certain") {
    Series series = power_law(0.2, -0.62);
    series.runs_per_seed = {16, 4, 1};
    series.pooled = {1, 0.1, 0, 0};
    CHECK(slope(series).standard_error >= 0.05);
    CHECK(verdict(series) == Verdict::Converges);
}

TEST_CASE("what is unbiased converges") {
    const Series series = normal(2, 0.1);
    CHECK(verdict(series) == Verdict::Converges);
    CHECK(std::abs(series.pooled.bias_z) <= 4);
    CHECK(series.pooled.tail_share <= 0.05);
}

TEST_CASE("a bias is a plateau whether or not the slope shows it") {
    const Series seen = normal(2.2, 0.1), early = normal(2.02, 0.1);
    CHECK(slope(seen).value >= -0.1);
    CHECK(slope(early).value <= -0.2);
    CHECK(verdict(seen) == Verdict::Plateau);
    CHECK(verdict(early) == Verdict::Plateau);
    CHECK_THAT(early.pooled.bias_z, WithinRel(0.02 / (0.1 / std::sqrt(2048.0)), 0.3));
    CHECK_FALSE(effort_to(seen, 0.01).has_value());
    CHECK_FALSE(effort_to(early, 0.001).has_value());
}

TEST_CASE("an error of the answer itself is no bias") {
    const std::vector<double> means{2.01, 2.02, 2.01, 2.02};
    CHECK(pool(means, 2, 0).bias_z >= 5);
    CHECK(pool(means, 2, 0.01).bias_z <= 2);
}

TEST_CASE("heavy tails are told apart from a bias") {
    // Pareto of index 1.2: the mean is 6, the variance infinite.
    const Series series =
        measured([](auto& engine) { return std::pow(1 - std::uniform_real_distribution{}(engine), -1 / 1.2); }, 6);
    CHECK(verdict(series) == Verdict::HeavyTails);
    CHECK(series.pooled.tail_share >= 0.5);
}

TEST_CASE("an estimator that has hit nothing yet is called neither biased nor efficient") {
    const Series series = measured([](auto&) { return 0.0; }, 2);
    CHECK(verdict(series) == Verdict::NoHits);
    CHECK_FALSE(effort_to(series, 1).has_value());
    CHECK(std::isnan(efficiency(series).value));
}

TEST_CASE("a constant is exact or a plateau") {
    CHECK(verdict(measured([](auto&) { return 2.0; }, 2)) == Verdict::Exact);
    CHECK(verdict(measured([](auto&) { return 3.0; }, 2)) == Verdict::Plateau);
}

TEST_CASE("an error that is lost in the reference's own is not exact") {
    Series series = power_law(0.2, -0.5);
    for (auto& run : series.runs) {
        for (Measurement& m : run) m.relative_squared_error = -1e-6;
    }
    CHECK(verdict(series) == Verdict::Unexplained);
    CHECK(std::isnan(efficiency(series).value));
}

TEST_CASE("a slope that nothing explains is marked") {
    Series series = power_law(0.2, -0.3);
    CHECK(verdict(series) == Verdict::Unexplained);
    series.pooled.bias_z = std::numeric_limits<double>::quiet_NaN();  // what is not known is no excuse
    CHECK(verdict(series) == Verdict::Unexplained);
}

TEST_CASE("where runs are wholes a slope may be steeper, and the longest run is judged by") {
    Series steep = power_law(0.2, -1.2), shallow = power_law(0.2, -0.3);
    steep.runs_per_seed = shallow.runs_per_seed = {4096, 4096, 4096};
    CHECK(verdict(steep) == Verdict::Unexplained);
    steep.is_whole = shallow.is_whole = true;
    CHECK(verdict(steep) == Verdict::Converges);
    CHECK(verdict(shallow) == Verdict::Unexplained);
    // After 1.6 s, the longest run, the error is 0.2 * 1.6^-1.2.
    CHECK_THAT(efficiency(steep).value, WithinRel(1 / (1.6 * std::pow(0.2 * std::pow(1.6, -1.2), 2)), 1e-9));
    // The steps measured decide in between; the slope -1/2, which is sure, decides beyond.
    CHECK_THAT(effort_to(steep, 0.2 * std::pow(0.8, -1.2))->cpu_seconds, WithinRel(0.8, 1e-9));
    CHECK_THAT(effort_to(steep, 0.1 * std::pow(1.6, -1.2))->cpu_seconds, WithinRel(6.4, 1e-9));
}

TEST_CASE("what a run costs besides its samples is no convergence") {
    Series series = power_law(0.2, -0.5);
    int hash = 0;
    for (auto& run : series.runs) {
        for (Measurement& m : run) {
            m.cpu_seconds += 0.05;                                    // half of what the shortest takes
            m.relative_squared_error *= 1 + 1e-6 * (hash++ * 7 % 5);  // without a spread no slope has an error
        }
    }
    CHECK(slope(series).value <= -0.55);
    CHECK_THAT(slope(series, Over::Samples).value, WithinAbs(-0.5, 1e-5));
    CHECK(verdict(series) == Verdict::Converges);
}

TEST_CASE("the spread over seeds shows an outlier") {
    Series series = power_law(0.2, -0.5);
    const double alike = spread(series).largest;
    CHECK_THAT(alike, WithinRel(1.0, 1e-9));
    CHECK(spread(series).least == alike);
    // One of four seeds is off by five times as much: over a root mean square of sqrt(7) times the others.
    for (Measurement& m : series.runs[2]) m.relative_squared_error *= 25;
    const Spread uneven = spread(series);
    CHECK_THAT(uneven.largest, WithinRel(5 / std::sqrt(7.0), 1e-9));
    CHECK_THAT(uneven.median, WithinRel(1 / std::sqrt(7.0), 1e-9));
    CHECK_THAT(uneven.upper_quartile, WithinRel((1 + 0.25 * 4) / std::sqrt(7.0), 1e-9));
    series.runs[0].back().relative_squared_error = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isnan(spread(series).largest));
}

TEST_CASE("the tail share is that of the largest thousandth") {
    std::vector<double> squares(2000, 1.0);
    CHECK_THAT(tail_share(squares), WithinRel(2.0 / 2000, 1e-12));
    squares[7] = 1001;
    CHECK_THAT(tail_share(squares), WithinRel(1002.0 / 3000, 1e-12));
    CHECK_THAT(tail_share({1, 3}), WithinRel(0.75, 1e-12));
    CHECK(tail_share({0, 0}) == 0);
}

TEST_CASE("the time to an error is interpolated between points and extrapolated beyond") {
    const Series series = power_law(0.01, -0.5);  // an error of 0.01 after a second; from 0.1 s to 1.6 s
    const auto within = effort_to(series, 0.01), beyond = effort_to(series, 0.001), before = effort_to(series, 0.1);
    REQUIRE((within && beyond && before));
    CHECK_THAT(within->cpu_seconds, WithinRel(1.0, 1e-9));
    CHECK_THAT(within->samples, WithinRel(1000.0, 1e-9));
    CHECK_FALSE(within->extrapolated);
    CHECK_THAT(beyond->cpu_seconds, WithinRel(100.0, 1e-9));
    CHECK(beyond->extrapolated);
    CHECK_THAT(before->cpu_seconds, WithinRel(0.01, 1e-9));
    CHECK(before->extrapolated);
    const auto one = effort_to(series, 10);  // there is no part of a sample
    CHECK(one->samples == 1);
    CHECK_THAT(one->cpu_seconds, WithinRel(1e-3, 1e-9));
}

TEST_CASE("the time to an error goes by where most runs stand behind it") {
    const Series series = normal(2, 0.1);  // a piece of 100 samples, 0.1 ms, is off by 5 %: 1 % takes 25 of them
    const auto effort = effort_to(series, 0.01);
    REQUIRE(effort.has_value());
    CHECK_THAT(effort->cpu_seconds, WithinRel(2.5e-3, 0.1));  // five standard errors of 2048 squares
    CHECK_THAT(effort->samples, WithinRel(2500.0, 0.1));
    CHECK_FALSE(effort->extrapolated);
}

TEST_CASE("efficiency is the inverse of variance times time") {
    Series twice = normal(2, 0.1);
    for (auto& run : twice.runs) {
        for (Measurement& m : run) m.cpu_seconds *= 2;
    }
    const Series base = measured([](auto& engine) { return 2 + std::normal_distribution{0.0, 0.3}(engine); }, 2);
    const Estimate relative = relative_efficiency(twice, base);
    CHECK_THAT(relative.value, WithinRel(9 / 2.0, 0.25));
    CHECK(std::abs(relative.value - 4.5) <= 4 * relative.standard_error);
    CHECK(relative.standard_error <= 0.5);
    // 100 samples take 0.2 ms and are off by 5 %.
    const Estimate absolute = efficiency(twice);
    CHECK_THAT(absolute.value, WithinRel(1 / (0.05 * 0.05 * 2e-4), 0.2));
    CHECK(std::abs(absolute.value - 2e6) <= 4 * absolute.standard_error);
}

TEST_CASE("an efficiency tells estimators apart of which one sample is enough") {
    const Series good = normal(2, 1e-3), better = normal(2, 5e-4);
    CHECK(effort_to(good, 0.01)->samples == 1);
    CHECK(effort_to(better, 0.01)->samples == 1);
    CHECK_THAT(relative_efficiency(better, good).value, WithinRel(4.0, 0.25));
}

TEST_CASE("the baseline is power or the first that has an efficiency") {
    Study study;
    study.series = {measured([](auto&) { return 2.0; }, 2), normal(2, 0.1), normal(2, 0.2)};
    CHECK(&baseline(study) == &study.series[1]);
    study.series[2].name = "power";
    CHECK(&baseline(study) == &study.series[2]);
    CHECK(relative_efficiency(study.series[2], baseline(study)).value == 1);
    study.series[0].name = "power";
    study.series[2].name = "another";
    CHECK(&baseline(study) == &study.series[1]);
}

TEST_CASE("the band holds the error and widens with the spread of the seeds") {
    const Series series = normal(2, 0.1);
    const Band first = relative_error(series, 0), last = relative_error(series, 4);
    CHECK((first.low < 0.05 && 0.05 < first.high));
    CHECK(first.high / first.low < last.high / last.low);
    CHECK(last.low > 0);
}
