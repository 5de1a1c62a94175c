// Tests that one may look at while they run: they raise no more false alarms than they say, and stop early at what is wrong.
//     lumis_tests "[sequential]"    prints the figures of docs/testing.md, which take some minutes
#include "broken.hpp"
#include "catch.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

// The hemisphere's uniform density, of which one half has `more` than its share and the other half less: the chart's t, which
// turns about +z, is below 0.1 or above 0.6 there.
laws::Expectation<V> expected_of(double more) {
    laws::DirectionChart chart = laws::sphere_chart();
    chart.t_edges = {0, 0.1, 0.35, 0.6, 1};
    const auto lopsided = [=](const V& w) {
        if (!(w.z > 0)) return 0.0;
        const double t = chart.coordinates(w).y;
        return (1 + (t > 0.1 && t < 0.6 ? -more : more)) * Uniform{}.pdf(w);
    };
    return laws::expectation(laws::Density<V>{lopsided}, chart);
}

laws::SequentialResult look(double more, const laws::Sequential& options) {
    return laws::chi_square(Uniform{}, expected_of(more), options);
}

using Source = lumis::Uniforms<std::mt19937_64, double>;

// Numbers of [0, 1] with mean p, of which the rest are 0: the rarer they are the larger is their variance.
auto hits(double p, std::uint64_t seed) {
    return laws::Bounded{
        0, 1, [p, uniforms = Source{std::mt19937_64{seed}}]() mutable { return uniforms.next<1>().x < p ? 1.0 : 0.0; }};
}

}  // namespace

TEST_CASE("a sequential chi-square test stops as soon as it knows", "[laws]") {
    const auto right = look(0, {0.01, 50'000});
    INFO(right);
    CHECK(right.passed);
    CHECK(right.samples == 50'000);
    std::int64_t before = 0;
    for (const double more : {0.9, 0.3, 0.1}) {
        const auto wrong = look(more, {0.01, 50'000});
        INFO(wrong);
        CHECK_FALSE(wrong.passed);
        CHECK(wrong.number <= 0.01);
        CHECK(wrong.samples > before);
        CHECK(static_cast<double>(wrong.samples) <= 60 / (more * more));
        before = wrong.samples;
    }
    // Nothing is drawn too seldom, or too often: evenly, so that no cell has more than its share of the rest.
    const auto half = consistently_broken(Uniform{}, [](const V&, double pdf) { return pdf / 2; });
    const auto forgetful = Broken{Uniform{},
                                  [](auto sample) {
                                      if (std::fmod(1e6 * sample.value.z, 1.0) < 0.1) sample.pdf = 0;
                                      return sample;
                                  },
                                  same_pdf};
    const auto seldom = laws::chi_square(half, laws::sphere_chart(), laws::Sequential{});
    const auto often = laws::chi_square(forgetful, laws::sphere_chart(), laws::Sequential{});
    CHECK_FALSE((seldom.passed || often.passed));
    CHECK(seldom.samples < 100);
    CHECK(often.samples < 200);
}

TEST_CASE("a sequential chi-square test refuses what can be told at once", "[laws]") {
    const auto below = Broken{Uniform{},
                              [](auto sample) {
                                  sample.value.z = -sample.value.z;
                                  return sample;
                              },
                              same_pdf};
    const auto law = laws::chi_square(below, laws::sphere_chart(), laws::Sequential{});
    CHECK_FALSE(law.passed);
    CHECK(law.decided);
    CHECK(law.samples == 1);
    CHECK(law.message.find("in a cell of probability 0") != std::string::npos);
    const auto double_mass = consistently_broken(Uniform{}, [](const V&, double pdf) { return 2 * pdf; });
    CHECK_FALSE(laws::chi_square(double_mass, laws::sphere_chart(), laws::Sequential{}).passed);
}

TEST_CASE("a sequential test of a mean stops as soon as it knows", "[laws]") {
    for (const double p : {0.5, 0.01}) {
        const auto right = laws::unbiased(hits(p, 1), p, laws::Sequential{0.01, 50'000});
        INFO(right);
        CHECK(right.passed);
        CHECK(right.samples == 50'000);
        for (const double factor : {0.7, 1.4}) {
            const auto wrong = laws::unbiased(hits(p, 1), factor * p, laws::Sequential{0.01, 50'000});
            INFO(wrong);
            CHECK_FALSE(wrong.passed);
            CHECK(wrong.samples < 50'000);
            CHECK(laws::agreement(hits(p, 2), hits(factor * p, 3), laws::Sequential{0.01, 50'000}).number <= 0.01);
        }
        CHECK(laws::agreement(hits(p, 2), hits(p, 3), laws::Sequential{0.01, 50'000}));
        // What is known of the answer alone cannot be more wrong than that.
        CHECK(laws::unbiased(hits(p, 1), 1.4 * p, laws::Sequential{0.01, 50'000}, 0.45 * p));
    }
    const auto colour = laws::Bounded{0, 1, [one = hits(0.5, 4)]() mutable { return one() * glm::dvec3{0, 0.5, 1}; }};
    CHECK(laws::unbiased(colour, glm::dvec3{0, 0.25, 0.5}, laws::Sequential{0.01, 10'000}));
    CHECK_FALSE(laws::unbiased(colour, glm::dvec3{0, 0.3, 0.5}, laws::Sequential{0.01, 10'000}));
}

namespace {

template <class Estimate>
concept Promises = requires(Estimate estimate) {
    laws::unbiased(estimate, 1.0, laws::Sequential{});
};
template <class First, class Second>
concept PromisesAgreement = requires(First a, Second b) {
    laws::agreement(a, b, laws::Sequential{});
};
double unbounded() {
    return 1;
}
using Plain = double (*)();

static_assert(Promises<laws::Bounded<Plain>> && !Promises<Plain>);
static_assert(PromisesAgreement<laws::Bounded<Plain>, laws::Bounded<Plain>>);
static_assert(!PromisesAgreement<laws::Bounded<Plain>, Plain> && !PromisesAgreement<Plain, Plain>);

}  // namespace

TEST_CASE("a bound that does not hold is no promise", "[laws]") {
    const auto beyond = laws::unbiased(laws::Bounded{0, 0.5, unbounded}, 0.25, laws::Sequential{});
    CHECK_FALSE(beyond.passed);
    CHECK_FALSE(beyond.decided);
    CHECK(beyond.message == "drew 1, which is beyond the bound: from 0 to 0.5");
    const auto nan = laws::unbiased(laws::Bounded{0, 1, [] { return std::nan(""); }}, 0.5, laws::Sequential{});
    CHECK_FALSE(nan.passed);
    CHECK(nan.decided);
    CHECK_FALSE(laws::unbiased(laws::Bounded{0, 1, unbounded}, 2, laws::Sequential{}).passed);
    CHECK_FALSE(laws::unbiased(laws::Bounded{1, 1, unbounded}, 1, laws::Sequential{}).passed);
    CHECK(laws::unbiased(laws::Bounded{0, 1, unbounded}, 1, laws::Sequential{0.01, 1000}));
    CHECK_FALSE(laws::unbiased(laws::Bounded{0, 1, unbounded}, 1, laws::Sequential{0.01, 0}).decided);
    // Nobody can bet where the width of the bound is no number.
    constexpr double infinity = std::numeric_limits<double>::infinity(), largest = (std::numeric_limits<double>::max)();
    CHECK_FALSE(laws::unbiased(laws::Bounded{0, infinity, unbounded}, 0.9, laws::Sequential{0.01, 100}).decided);
    CHECK_FALSE(laws::unbiased(laws::Bounded{-largest, largest, unbounded}, 0.9, laws::Sequential{0.01, 100}).decided);
    // A float rounds as a float does, whichever of two estimates it is.
    const laws::Bounded none{0, 1.0 / 3, [] { return 0.0; }};
    const laws::Bounded third{0, 1.0 / 3, [] { return 1.0f / 3; }};
    CHECK(laws::agreement(none, third, laws::Sequential{0.01, 100}).decided);
    CHECK(laws::agreement(third, none, laws::Sequential{0.01, 100}).decided);
}

// 300 runs at 5 %: Ville's inequality allows 15 on average, and more than 30 come about once in 10,000 times.
TEST_CASE("whoever looks after every few samples is not deceived", "[laws]") {
    const auto expected = expected_of(0);
    int cells = 0, means = 0, rare = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const laws::Sequential options{0.05, 2'000, seed};
        cells += !laws::chi_square(Uniform{}, expected, options).passed;
        means += !laws::unbiased(hits(0.5, seed), 0.5, options).passed;
        rare += !laws::unbiased(hits(0.003, seed), 0.003, options).passed;
    }
    CHECK(cells <= 30);
    CHECK(means <= 30);
    CHECK(rare <= 30);
}

namespace {

// The median over runs of how many samples it takes. run(seed) yields a SequentialResult.
template <class Run>
double median_samples(int runs, const Run& run) {
    std::vector<double> samples;
    for (int seed = 1; seed <= runs; ++seed) {
        samples.push_back(static_cast<double>(run(static_cast<std::uint64_t>(seed)).samples));
    }
    std::nth_element(samples.begin(), samples.begin() + runs / 2, samples.end());
    return samples[static_cast<std::size_t>(runs / 2)];
}

// How many samples a chi-square test of a fixed size needs that fails every second time, if its author knew the deviation.
double fixed_size(double freedom, double more, double false_alarm) {
    const boost::math::chi_squared_distribution<double> null{freedom};
    const double critical = quantile(complement(null, false_alarm));
    double low = 0, high = critical + 10 * freedom;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        const boost::math::non_central_chi_squared_distribution<double> wrong{freedom, middle};
        (cdf(wrong, critical) > 0.5 ? low : high) = middle;
    }
    return high / (more * more);
}

// How often, over as many runs, a correct strategy is told wrong; every run looks to its end.
template <class Run>
int false_alarms(int runs, const Run& run) {
    int alarms = 0;
    for (int seed = 1; seed <= runs; ++seed) alarms += !run(static_cast<std::uint64_t>(seed)).passed;
    return alarms;
}

}  // namespace

TEST_CASE("sequential tests, measured", "[.][sequential]") {
    const auto right = expected_of(0);
    std::printf("false alarms of 2,000 correct strategies, of 20,000 samples at most\n");
    for (const double alpha : {1e-2, 1e-3}) {
        const auto cells = [&](std::uint64_t seed) {
            return laws::chi_square(Uniform{}, right, laws::Sequential{alpha, 20'000, seed});
        };
        const auto mean_of = [&](double p) {
            return [=](std::uint64_t seed) {
                return laws::unbiased(hits(p, seed), p, laws::Sequential{alpha, 20'000});
            };
        };
        const auto two = [&](std::uint64_t seed) {
            return laws::agreement(hits(0.3, 2 * seed), hits(0.3, 2 * seed + 1), laws::Sequential{alpha, 20'000});
        };
        std::printf("at %g, %g allowed: chi_square %d, unbiased %d, of rare hits %d, agreement %d\n", alpha,
                    2000 * alpha, false_alarms(2000, cells), false_alarms(2000, mean_of(0.5)),
                    false_alarms(2000, mean_of(0.003)), false_alarms(2000, two));
    }
    for (const double alpha : {1e-2, 1e-3}) {
        std::printf("at %g, the median of 51 runs stops after\n", alpha);
        for (const double more : {0.3, 0.1, 0.03}) {
            const auto wrong = expected_of(more);
            const double cells = median_samples(51, [&](std::uint64_t seed) {
                return laws::chi_square(Uniform{}, wrong, laws::Sequential{alpha, 10'000'000, seed});
            });
            const double mean = median_samples(51, [&](std::uint64_t seed) {
                return laws::unbiased(hits(0.5, seed), 0.5 * (1 + more), laws::Sequential{alpha, 10'000'000});
            });
            std::printf(
                "%g %%: chi_square %.0f (of a fixed size %.0f, with 4 cells %.0f), unbiased %.0f (z-test %.0f)\n",
                100 * more, cells, fixed_size(399, more, alpha), fixed_size(3, more, alpha), mean,
                fixed_size(1, more, alpha));
        }
    }
}
