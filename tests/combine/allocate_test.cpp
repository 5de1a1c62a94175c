// What is chosen by pilots: within limits, for delta strategies and colours, by several threads; and estimates are unbiased.
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
#include <cstdint>
#include <limits>
#include <random>

using lumis::allocate;
using lumis::BalanceHeuristic;
using lumis::PowerHeuristic;
using lumis::take;

namespace {

using Source = lumis::Uniforms<std::mt19937_64, double>;
using Counts = std::array<int, 2>;

const auto exponential = [](double x) { return std::exp(x); };

}  // namespace

// Techniques that do not meet: counts are in proportion to the standard deviation over the root of the cost (Neyman).
TEST_CASE("costs and deviations decide between techniques that do not meet", "[allocate]") {
    const Interval<double> left{0, 1}, right{1, 2};
    const auto f = [](double x) { return x < 1 ? 8 * x : x; };
    const auto plan = piloted(allocate(PowerHeuristic{}, take(1, left), take(1, right)), f, 10'000);
    CHECK(plan.counts() == Counts{8, 1});
    CHECK(plan.counts({.of_sample = {16, 1}}) == Counts{2, 1});
    CHECK(plan.counts({.of_sample = {1, 4}}, {.most_samples = 17}) == Counts{16, 1});
    // An estimate with a cost of its own takes as many samples as it may, and none of them is counted to find out.
    CHECK(plan.counts({.of_estimate = 1e6}, {.most_samples = 36}) == Counts{32, 4});
    const auto many = plan.counts({.of_estimate = 1e6}, {.most_samples = std::numeric_limits<int>::max()});
    CHECK(many[0] == 8 * many[1]);
    CHECK(many[1] > 100'000'000);
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
    CHECK(plan(256).counts({}, {.covers = {false, true}}) == Counts{0, 1});
    CHECK(plan(256).probabilities({}, {.covers = {false, true}}) == std::array{0.0, 1.0});
    CHECK(plan(256).counts({}, {.covers = {true, false}})[0] > 0);
    CHECK(plan(256).counts({}, {.most_samples = 65}) == Counts{1, 64});
    CHECK(plan(255).counts({}, {.covers = {false, true}, .most_samples = 65}) == Counts{1, 64});
    CHECK(plan(8).counts({}, {.covers = {false, true}, .most_samples = 65}) == Counts{1, 7});
    CHECK(plan(0).counts({}, {.covers = {false, true}}) == Counts{1, 1});
    // A sample that the second cannot draw tells what no limit may deny.
    const auto seen = piloted(allocate(BalanceHeuristic{}, take(1, all), take(1, right)), exponential, 300);
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

TEST_CASE("a pilot sample that is not finite is counted and left out", "[allocate]") {
    const Interval<double> left{0, 1}, right{1, 2};
    const auto pilot = [&](double now_and_then) {
        int call = 0;
        return piloted(
            allocate(BalanceHeuristic{}, take(1, left), take(1, right)),
            [&](double x) { return ++call % 100 == 0 ? now_and_then
                                   : x < 1           ? 8 * x
                                                     : x; }, 10'000);
    };
    for (const double bad : {std::nan(""), HUGE_VAL}) {
        auto plan = pilot(bad);
        CHECK(plan.counts() == pilot(1).counts());
        CHECK(plan.counts() != Counts{1, 1});
        plan.merge(plan);
        CHECK(plan.rejected() == 400);
    }
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
