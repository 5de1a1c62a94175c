// Splits of samples by pilot rounds: their variances, what is chosen by them, and that estimates stay unbiased.
#include "assertions.hpp"
#include "catch.hpp"
#include "one_dimensional.hpp"
#include "z_test.hpp"
#include <lumis/combine/allocate.hpp>
#include <lumis/combine/multi_sample.hpp>
#include <lumis/combine/one_sample.hpp>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>

using lumis::allocate;
using lumis::BalanceHeuristic;
using lumis::PowerHeuristic;
using lumis::take;

namespace {

using Source = lumis::Uniforms<std::mt19937_64, double>;
using Counts = std::array<int, 2>;

const auto exponential = [](double x) { return std::exp(x); };

// Density 2 x over [0, 1].
struct Steep {
    using Scalar = double;
    using Point = double;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    [[nodiscard]] lumis::Sample<double, double> sample(glm::dvec1 u) const noexcept {
        const double x = std::sqrt(1 - u.x);
        return {x, pdf(x)};
    }
    [[nodiscard]] double pdf(double x) const noexcept { return x >= 0 && x <= 1 ? 2 * x : 0; }
};

// Evenly over [0, 1/2), by half of the uniforms; the others yield nothing.
struct HalfOfHalf {
    using Scalar = double;
    using Point = double;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    [[nodiscard]] lumis::Sample<double, double> sample(glm::dvec1 u) const noexcept {
        return u.x < 0.5 ? lumis::Sample<double, double>{u.x, 1} : lumis::Sample<double, double>{};
    }
    [[nodiscard]] double pdf(double x) const noexcept { return x >= 0 && x < 0.5 ? 1 : 0; }
};

// Two points of probability 1/4 and 3/4.
struct TwoPoints {
    using Scalar = double;
    using Point = double;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;
    static constexpr bool is_delta = true;

    [[nodiscard]] lumis::Sample<double, double> sample(glm::dvec1 u) const noexcept {
        return u.x < 0.25 ? lumis::Sample<double, double>{0, 0.25} : lumis::Sample<double, double>{1, 0.75};
    }
    [[nodiscard]] double pdf(double) const noexcept { return 0; }
};

template <class Plan>
Plan piloted(Plan plan, const auto& f, int rounds, std::uint64_t seed = 1) {
    Source uniforms{std::mt19937_64{seed}};
    for (int i = 0; i < rounds; ++i) plan.add(f, uniforms);
    return plan;
}

// The variance by the balance heuristic of e^x, from n samples of density 1 and m of density 2 x: midpoint rule.
double variance_of_exponential(double n, double m) {
    constexpr int steps = 100'000;
    double second = 0, first_of_1 = 0, first_of_2 = 0;
    for (int i = 0; i < steps; ++i) {
        const double x = (i + 0.5) / steps, f = std::exp(x), sum = n + m * 2 * x;
        second += f * f / sum / steps;
        first_of_1 += f / sum / steps;
        first_of_2 += 2 * x * f / sum / steps;
    }
    return second - n * first_of_1 * first_of_1 - m * first_of_2 * first_of_2;
}

}  // namespace

// Measured with 40,000 estimates, and predicted from 40,000 rounds that draw two and three samples: 1 % each, thrice.
TEMPLATE_TEST_CASE("the variance of every split is that of its estimator", "[allocate]", BalanceHeuristic,
                   PowerHeuristic, lumis::MaximumHeuristic) {
    const TestType heuristic{};
    const auto check = [&](const auto& f, const auto& a, const auto& b, double tolerance) {
        const auto forecast = piloted(allocate(heuristic, take(2, a), take(3, b)), f, 40'000).forecast();
        for (const Counts n : {Counts{1, 1}, {2, 6}, {3, 2}, {16, 1}, {1, 0}}) {
            INFO("counts " << n[0] << ", " << n[1]);
            const auto several = multi_sample(heuristic, take(n[0], a), take(n[1], b));
            const double measured =
                moments_of<double>([&](auto& u) { return several.estimate(f, u); }, 40'000, 2).variance();
            CHECK(std::abs(forecast.multi_sample_variance(n) / measured - 1) <= tolerance);

            const double sum = n[0] + n[1];
            const auto one = one_sample(heuristic, lumis::choose(n[0] / sum, a), lumis::choose(n[1] / sum, b));
            const double measured_of_one =
                moments_of<double>([&](auto& u) { return one.estimate(f, u); }, 40'000, 3).variance();
            CHECK(std::abs(forecast.one_sample_variance(n) / measured_of_one - 1) <= tolerance);
        }
    };
    check(exponential, Interval<double>{0, 1}, Steep{}, 0.06);
    check([](double x) { return x < 0.5 ? 4 + x : x; }, Interval<double>{0, 1}, HalfOfHalf{}, 0.03);
}

TEST_CASE("e^x by the densities 1 and 2 x, the second of four times the cost", "[allocate]") {
    const double even = variance_of_exponential(1, 1) * 5, best = variance_of_exponential(10, 9) * (10 + 4 * 9);
    CHECK(std::abs(even / best - 1.2086) <= 0.0005);

    const auto plan =
        piloted(allocate(BalanceHeuristic{}, take(1, Interval<double>{0, 1}), take(1, Steep{})), exponential, 20'000);
    const auto forecast = plan.forecast();
    CHECK(std::abs(forecast.multi_sample_variance({1, 1}) / 0.0023561674044 - 1) <= 0.03);
    CHECK(std::abs(forecast.multi_sample_variance({10, 9}) / variance_of_exponential(10, 9) - 1) <= 0.03);
    CHECK(plan.counts({.of_sample = {1, 4}}, {.most_samples = 20}) == Counts{10, 9});
    CHECK(plan.counts({.of_sample = {1, 4}}, {.most_samples = 3}) == Counts{1, 1});
    // By one sample the gain is 1.226.
    const auto probabilities = plan.probabilities({.of_sample = {1, 4}});
    CHECK(std::abs(probabilities[0] - 10 / 19.0) <= 1e-12);
    CHECK(probabilities[0] + probabilities[1] == 1);
    const double gain = forecast.one_sample_variance({1, 1}) * 2.5 / (forecast.one_sample_variance({10, 9}) * 46 / 19);
    CHECK(std::abs(gain - 1.226) <= 0.02);
    // Few rounds see nearly as much, though the variance is a thousandth of the second moment.
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto few = piloted(allocate(BalanceHeuristic{}, take(1, Interval<double>{0, 1}), take(1, Steep{})),
                                 exponential, 64, seed);
        const Counts n = few.counts({.of_sample = {1, 4}});
        CHECK(variance_of_exponential(n[0], n[1]) * (n[0] + 4 * n[1]) <= even);
    }
}

TEST_CASE("optimal weights draw the cheap technique and keep the other as a control variate", "[allocate]") {
    const auto pilot = allocate(lumis::OptimalWeights{}, take(1, Interval<double>{0, 1}), take(1, Steep{}));
    auto plan = piloted(pilot, exponential, 10'000, 1);
    plan.merge(piloted(pilot, exponential, 10'000, 2));
    const auto forecast = plan.forecast();
    // What is left of e^x by regression on 2 x, over [0, 1].
    const double e = std::numbers::e, regression = (e * e - 1) / 2 - (e - 1) * (e - 1) - 3 * (3 - e) * (3 - e);
    constexpr double even = 0.0020220066861;
    CHECK(std::abs(even * 5 / regression - 2.56) <= 0.01);
    CHECK(std::abs(forecast.multi_sample_variance({1, 1}) / even - 1) <= 0.03);
    CHECK(std::abs(forecast.multi_sample_variance({3, 0}) / (regression / 3) - 1) <= 0.03);
    CHECK(std::abs(forecast.one_sample_variance({1, 1}) / (2 * even) - 1) <= 0.03);
    CHECK(plan.counts({.of_sample = {1, 4}}, {.covers = {true, false}}) == Counts{1, 0});
    CHECK(plan.counts({.of_sample = {1, 4}}, {.most_samples = 65}) == Counts{64, 1});
    CHECK(plan.probabilities({.of_sample = {1, 4}}, {.covers = {true, false}}) == std::array{1.0, 0.0});
    // A control variate is asked for its density where it is not drawn: at this price samples of it are worth more.
    CHECK(plan.counts({.of_sample = {1, 4}, .of_density = {0, 10}}, {.covers = {true, false}}) != Counts{1, 0});

    // Draws that yield nothing count, and a control variate that has such does not integrate to 1.
    const auto f = [](double x) { return x < 0.5 ? 4 + x : x; };
    const auto nothing =
        piloted(allocate(lumis::OptimalWeights{}, take(1, Interval<double>{0, 1}), take(2, HalfOfHalf{})), f, 20'000);
    CHECK(std::abs(nothing.forecast().multi_sample_variance({1, 1}) / 1.546875 - 1) <= 0.02);
    CHECK(nothing.forecast().multi_sample_variance({1, 0}) > 1e300);
    CHECK(nothing.counts({.of_sample = {1, 1000}}, {.covers = {true, false}})[1] > 0);
}

// Where techniques do not meet, counts are in proportion to the standard deviation over the root of the cost (Neyman).
TEST_CASE("costs and deviations decide between techniques that do not meet", "[allocate]") {
    const Interval<double> left{0, 1}, right{1, 2};
    const auto f = [](double x) { return x < 1 ? 8 * x : x; };
    const auto plan = piloted(allocate(PowerHeuristic{}, take(1, left), take(1, right)), f, 10'000);
    CHECK(plan.counts() == Counts{8, 1});
    CHECK(plan.counts({.of_sample = {16, 1}}) == Counts{2, 1});
    CHECK(plan.counts({.of_sample = {1, 4}}, {.most_samples = 17}) == Counts{16, 1});
    // The first technique's density is asked for at the second's samples, which cost 16 as well then.
    CHECK(plan.counts({.of_sample = {16, 1}, .of_density = {15, 0}}) == Counts{8, 1});
    // What an estimate costs besides is spread over as many samples as are allowed.
    CHECK(plan.counts({.of_estimate = 1}) == Counts{14, 2});
    CHECK(plan.counts({.of_estimate = 1}, {.most_samples = 36}) == Counts{32, 4});
    CHECK(plan.counts({}, {.most_samples = 3}) == Counts{2, 1});
    CHECK(plan.counts({}, {.most_samples = 1}) == Counts{1, 1});
}

TEST_CASE("a technique is left out if another covers all, and if the pilot was long enough", "[allocate]") {
    // The second technique fits perfectly, as far as it goes.
    const Interval<double> all{0, 1}, right{0.5, 1};
    const auto f = [](double x) { return x < 0.5 ? 0.0 : 1.0; };
    const auto plan = [&](int rounds) {
        return piloted(allocate(BalanceHeuristic{}, take(1, all), take(1, right)), f, rounds);
    };
    CHECK(plan(128).counts({}, {.covers = {false, true}}) == Counts{0, 1});
    CHECK(plan(128).probabilities({}, {.covers = {false, true}}) == std::array{0.0, 1.0});
    CHECK(plan(128).counts({}, {.covers = {true, false}})[0] > 0);
    CHECK(plan(128).counts({}, {.most_samples = 65}) == Counts{1, 64});
    CHECK(plan(127).counts({}, {.covers = {false, true}, .most_samples = 65}) == Counts{1, 64});
    CHECK(plan(8).counts({}, {.covers = {false, true}, .most_samples = 65}) == Counts{1, 7});
    CHECK(plan(0).counts({}, {.covers = {false, true}}) == Counts{1, 1});
    // A sample that the second cannot draw tells what no limit may deny.
    const auto seen = piloted(allocate(BalanceHeuristic{}, take(1, all), take(1, right)), exponential, 200);
    CHECK(seen.counts({.of_sample = {9, 1}}, {.covers = {false, true}})[0] > 0);
}

TEST_CASE("a delta strategy gets what its own variance is worth", "[allocate]") {
    const auto f = [](double x, auto... delta) { return sizeof...(delta) > 0 ? 2 + 30 * x : x; };
    const auto pilot = allocate(PowerHeuristic{}, take(2, TwoPoints{}), take(1, Interval<double>{0, 1}));
    auto plan = piloted(pilot, f, 10'000, 1);
    plan.merge(piloted(pilot, f, 10'000, 2));
    const auto forecast = plan.forecast();
    // 2 / (1/4) or 32 / (3/4), and any of [0, 1).
    const double point = std::pow(128.0 / 3 - 8, 2) * 3 / 16, line = 1.0 / 12;
    CHECK(std::abs(forecast.multi_sample_variance({1, 1}) / (point + line) - 1) <= 0.02);
    CHECK(std::abs(forecast.multi_sample_variance({8, 2}) / (point / 8 + line / 2) - 1) <= 0.02);
    // Deviations 15 and 0.29.
    CHECK(plan.counts({}, {.most_samples = 33}) == Counts{32, 1});
    const double second = std::pow(2, 2) * 4 + std::pow(32, 2) * 4 / 3, mean = 34.5;
    CHECK(std::abs(forecast.one_sample_variance({3, 1}) / (second * 4 / 3 + 4 / 3.0 - mean * mean) - 1) <= 0.02);
    const auto probabilities = plan.probabilities();
    CHECK(std::abs(probabilities[0] / probabilities[1] / (std::sqrt(second / (1 / 3.0))) - 1) <= 0.1);
    CHECK(std::abs(probabilities[0] + probabilities[1] - 1) <= 1e-15);
}

TEST_CASE("rounds of several threads and of several integrals", "[allocate]") {
    const auto plan = [](std::uint64_t seed, const auto& f) {
        return piloted(allocate(PowerHeuristic{}, take(1, Interval<double>{0, 1}), take(2, Steep{})), f, 500, seed);
    };
    auto merged = plan(1, exponential);
    merged.merge(plan(2, exponential));
    Source both{std::mt19937_64{1}};
    auto one_after_the_other = plan(1, exponential);
    Source second{std::mt19937_64{2}};
    for (int i = 0; i < 500; ++i) one_after_the_other.add(exponential, second);
    const double together = one_after_the_other.forecast().multi_sample_variance({2, 1});
    CHECK(std::abs(merged.forecast().multi_sample_variance({2, 1}) / together - 1) <= 1e-12);

    const auto seven = [](double x) { return 7 * x; };
    auto sum = plan(1, exponential).forecast();
    sum += plan(2, seven).forecast();
    const double of_both = plan(1, exponential).forecast().one_sample_variance({1, 1}) +
                           plan(2, seven).forecast().one_sample_variance({1, 1});
    CHECK(std::abs(sum.one_sample_variance({1, 1}) / of_both - 1) <= 1e-12);
}

TEST_CASE("colours count by luminance or by what is asked for", "[allocate]") {
    const auto f = [](double x) { return glm::dvec3{std::exp(x), 3 * x, 1 / (1 + x)}; };
    auto plan = allocate(BalanceHeuristic{}, take(1, Interval<double>{0, 1}), take(1, Steep{}));
    auto blue = plan, green = plan, grey = plan;
    Source uniforms{std::mt19937_64{1}};
    for (int i = 0; i < 300; ++i) {
        Source same = uniforms, again = uniforms, once_more = uniforms;
        const glm::dvec3 estimate = plan.add(f, uniforms);
        const double luminance = grey.add([&](double x) { return glm::dot(f(x), {0.2126, 0.7152, 0.0722}); }, same);
        CHECK(std::abs(glm::dot(estimate, {0.2126, 0.7152, 0.0722}) / luminance - 1) <= 1e-14);
        blue.add(f, again, [](const glm::dvec3& rgb) { return rgb.z; });
        green.add([&](double x) { return f(x).z; }, once_more);
    }
    const Counts n{3, 1};
    CHECK(std::abs(plan.forecast().multi_sample_variance(n) / grey.forecast().multi_sample_variance(n) - 1) <= 1e-9);
    CHECK(blue.forecast().multi_sample_variance(n) == green.forecast().multi_sample_variance(n));
}

TEST_CASE("estimates by a plan are unbiased, and with the pilot's own by fixed weights", "[allocate]") {
    const auto step = [](double x) { return x < 0.9 ? 8.0 : 80.0; };
    const auto estimate = [&](auto& uniforms) {
        auto plan = allocate(PowerHeuristic{}, take(1, everywhere), take(1, above));
        double pilot = 0;
        for (int i = 0; i < 4; ++i) pilot += plan.add(step, uniforms) / 4;
        const auto limits = lumis::AllocationLimits<2>{.covers = {true, false}};
        const auto n = plan.counts({.of_sample = {1, 2}}, limits);
        const auto p = plan.probabilities({}, limits);
        const double several =
            multi_sample(PowerHeuristic{}, take(n[0], everywhere), take(n[1], above)).estimate(step, uniforms);
        const double one = one_sample(PowerHeuristic{}, lumis::choose(p[0], everywhere), lumis::choose(p[1], above))
                               .estimate(step, uniforms);
        return 0.25 * pilot + 0.5 * several + 0.25 * one;
    };
    const auto test = z_test<double>(estimate, Step::integral, 1);
    INFO(test.message);
    CHECK(test.passed);
}

TEST_CASE("costs from times are those that the times were made of", "[allocate]") {
    using Plan = decltype(allocate(BalanceHeuristic{}, take(1, Steep{}), take(1, TwoPoints{}), take(1, HalfOfHalf{}),
                                   take(1, Steep{})));
    const std::array samples{3.0, 2.0, 7.0, 5.0}, densities{0.5, 0.0, 2.0, 1.0};
    const double together = 17 + 2 * 3.5;
    const auto costs = Plan::costs_from_times(samples, together,
                                              {together + 3 + 3, together + 2, together + 7 + 1.5, together + 5 + 2.5});
    CHECK(costs.of_sample == samples);
    CHECK(costs.of_density == densities);
}
