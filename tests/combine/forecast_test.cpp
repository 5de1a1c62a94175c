// What pilots predict: variances of all splits against measured ones and closed forms, and the counts that follow.
#include "assertions.hpp"
#include "catch.hpp"
#include "one_dimensional.hpp"
#include "pilots.hpp"
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
TEMPLATE_TEST_CASE("the variance of every split is that of its estimator", "[forecast]", BalanceHeuristic,
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
    check([](double x) { return x < 0.5 ? 4 + x : x; }, Interval<double>{0, 1}, HalfTheTime{}, 0.03);
}

TEST_CASE("e^x by the densities 1 and 2 x, the second of four times the cost", "[forecast]") {
    const double even = variance_of_exponential(1, 1) * 5, best = variance_of_exponential(10, 9) * (10 + 4 * 9);
    CHECK(std::abs(even / best - 1.2086) <= 0.0005);

    const auto plan =
        piloted(allocate(BalanceHeuristic{}, take(1, Interval<double>{0, 1}), take(1, Steep{})), exponential, 20'000);
    const auto forecast = plan.forecast();
    CHECK(std::abs(forecast.multi_sample_variance({1, 1}) / 0.0023561674044 - 1) <= 0.03);
    CHECK(std::abs(forecast.multi_sample_variance({10, 9}) / variance_of_exponential(10, 9) - 1) <= 0.03);
    CHECK(plan.counts({.of_sample = {1, 4}}, {.most_samples = 20}) == Counts{10, 9});
    CHECK(plan.counts({.of_sample = {1, 4}}, {.most_samples = 3}) == Counts{1, 1});
    // The gain by one sample is 1.226.
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

TEST_CASE("optimal weights draw the cheap technique and keep the other as a control variate", "[forecast]") {
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
        piloted(allocate(lumis::OptimalWeights{}, take(1, Interval<double>{0, 1}), take(2, HalfTheTime{})), f, 20'000);
    CHECK(std::abs(nothing.forecast().multi_sample_variance({1, 1}) / 1.546875 - 1) <= 0.02);
    CHECK(nothing.forecast().multi_sample_variance({1, 0}) > 1e300);
    CHECK(nothing.counts({.of_sample = {1, 1000}}, {.covers = {true, false}})[1] > 0);
}

TEST_CASE("three techniques and more", "[forecast]") {
    // Three that do not meet, of deviations 8, 2 and 1.
    const auto f = [](double x) { return x < 1 ? 8 * x : x < 2 ? 2 * x : x; };
    const auto apart = piloted(allocate(PowerHeuristic{}, take(1, Interval<double>{0, 1}),
                                        take(2, Interval<double>{1, 2}), take(1, Interval<double>{2, 3})),
                               f, 10'000);
    CHECK(apart.counts() == std::array{8, 2, 1});
    CHECK(apart.counts({.of_sample = {4, 1, 1}}) == std::array{4, 2, 1});

    // Three that do, one of which yields nothing at times.
    const auto overlapping =
        piloted(allocate(BalanceHeuristic{}, take(1, Interval<double>{0, 1}), take(1, Steep{}), take(1, HalfTheTime{})),
                exponential, 40'000);
    for (const std::array n : {std::array{1, 1, 1}, {1, 4, 2}, {2, 0, 1}}) {
        const auto several = multi_sample(BalanceHeuristic{}, take(n[0], Interval<double>{0, 1}), take(n[1], Steep{}),
                                          take(n[2], HalfTheTime{}));
        const double measured =
            moments_of<double>([&](auto& u) { return several.estimate(exponential, u); }, 40'000, 5).variance();
        CHECK(std::abs(overlapping.forecast().multi_sample_variance(n) / measured - 1) <= 0.06);
    }

    // One alone takes what it is given; five are as many as are split.
    const auto alone = piloted(allocate(BalanceHeuristic{}, take(1, Steep{})), exponential, 100);
    CHECK(alone.counts({.of_estimate = 1}, {.most_samples = 7}) == std::array{7});
    CHECK(alone.probabilities() == std::array{1.0});
    const auto five = piloted(
        allocate(BalanceHeuristic{}, take(1, Steep{}), take(1, Steep{}), take(1, Steep{}), take(1, Steep{}),
                 take(1, Interval<double>{0, 1})),
        [](double x) { return 2 * x; }, 100);
    CHECK(five.counts({}, {.most_samples = 50}) == std::array{8, 8, 8, 8, 1});
}

TEST_CASE("costs from times are those that the times were made of", "[forecast]") {
    using Plan = decltype(allocate(BalanceHeuristic{}, take(1, Steep{}), take(1, TwoPoints{}), take(1, HalfTheTime{}),
                                   take(1, Steep{})));
    const std::array samples{3.0, 2.0, 7.0, 5.0}, densities{0.5, 0.0, 2.0, 1.0};
    const double together = 17 + 2 * 3.5;
    const auto costs = Plan::costs_from_times(samples, together,
                                              {together + 3 + 3, together + 2, together + 7 + 1.5, together + 5 + 2.5});
    CHECK(costs.of_sample == samples);
    CHECK(costs.of_density == densities);
}
