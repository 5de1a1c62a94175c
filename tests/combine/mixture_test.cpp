#include "assertions.hpp"
#include "catch.hpp"
#include "instrumented.hpp"
#include "one_dimensional.hpp"
#include "z_test.hpp"
#include <lumis/combine/mixture.hpp>
#include <lumis/combine/multi_sample.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/directions/uniform_hemisphere.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

using lumis::choose;
using lumis::Mixture;

TEMPLATE_TEST_CASE("a mixture reports the density of its value, whichever part drew it", "[mixture]", float, double) {
    using T = TestType;
    const Mixture mixture{choose(0.25, lumis::CosineHemisphere<T>{}), choose(0.75, lumis::UniformHemisphere<T>{})};
    static_assert(lumis::Strategy<decltype(mixture)>);
    static_assert(mixture.dimensions == 3);
    static_assert(std::is_same_v<typename decltype(mixture)::Measure, lumis::measure::SolidAngle>);
    CountingUniforms<T> uniforms;
    const T one_part = std::numbers::inv_pi_v<T>;
    for (int i = 0; i < 10'000; ++i) {
        const auto s = mixture.sample(uniforms.template next<3>());
        REQUIRE(s.pdf == mixture.pdf(s.value));
        const T expected = T(0.25) * s.value.z * one_part + T(0.375) * one_part;
        REQUIRE(std::abs(s.pdf - expected) <= 4 * std::numeric_limits<T>::epsilon() * expected);
    }
    CHECK(mixture.pdf({0, 0, -1}) == 0);
}

TEST_CASE("a mixture's density is that of its parts, times the probability of each", "[mixture]") {
    const Mixture mixture{choose(0.25, everywhere), choose(0.75, Ramp<double>{})};
    static_assert(std::is_same_v<decltype(mixture.strategy<1>()), const Ramp<double>&>);
    CHECK(mixture.probability<0>() == 0.25);
    CHECK(mixture.probability<1>() == 0.75);
    CHECK(mixture.pdf(0.3) == 0.25 * mixture.strategy<0>().pdf(0.3) + 0.75 * mixture.strategy<1>().pdf(0.3));
}

TEST_CASE("a mixture's samples follow its density", "[mixture]") {
    const Mixture mixture{choose(0.3, everywhere), choose(0.7, Ramp<double>{})};
    // E[x] = 0.3 / 2 + 0.7 (1/4 + 1/3).
    const auto mean =
        z_test<double>([&](auto& u) { return mixture.sample(u.template next<2>()).value; }, 0.15 + 0.7 * 7 / 12, 1);
    INFO(mean.message);
    CHECK(mean.passed);
    const auto plain = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, mixture));
    const auto integral =
        z_test<double>([&](auto& u) { return plain.estimate([](double x) { return x * x; }, u); }, 1 / 3.0, 2);
    INFO(integral.message);
    CHECK(integral.passed);
}

TEST_CASE("a part with probability 0 is left out", "[mixture]") {
    Calls used, unused;
    const Instrumented left_out{Ramp<double>{}, &unused};
    const Instrumented kept{everywhere, &used};
    const Mixture first{choose(0, left_out), choose(1, kept)};
    const Mixture last{choose(1, kept), choose(0, left_out)};
    for (const double u : {0.0, 0.5, 1 - 0x1p-53, 1.0}) {
        const auto a = first.sample({u, 0.25}), b = last.sample({u, 0.25});
        CHECK(a.pdf == (u < 1 ? 1 : 0));
        CHECK(b.pdf == (u < 1 ? 1 : 0));
        CHECK(first.pdf(0.5) == 1);
    }
    CHECK(unused.sample == 0);
    CHECK(unused.pdf == 0);
    CHECK(used.sample == 6);
}

TEST_CASE("where probabilities sum to less than 1 the rest draws nothing", "[mixture]") {
    const Mixture mixture{choose(0.25, everywhere), choose(0.5, everywhere)};
    CHECK(mixture.sample({0.0, 0.5}).pdf == 0.75);
    CHECK(mixture.sample({0.74, 0.5}).pdf == 0.75);
    CHECK(mixture.sample({0.75, 0.5}).pdf == 0);
    CHECK(mixture.sample({1.0, 0.5}).pdf == 0);
    CHECK(mixture.pdf(0.5) == 0.75);

    // As Russian roulette: the density carries the chance of drawing at all, and so no bias arises.
    const auto plain = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, mixture));
    const auto test =
        z_test<double>([&](auto& u) { return plain.estimate([](double x) { return 3 * x * x; }, u); }, 1, 3);
    INFO(test.message);
    CHECK(test.passed);
}

TEST_CASE("a mixture without density has none and draws nothing", "[mixture]") {
    const Mixture empty{choose(0, everywhere), choose(0, Ramp<double>{})};
    CHECK(empty.pdf(0.5) == 0);
    CHECK(empty.sample({0.0, 0.5}).pdf == 0);
    const Mixture off_support{choose(0.5, everywhere), choose(0.5, above)};
    CHECK(off_support.pdf(2.0) == 0);
    // A part that draws nothing leaves the mixture with nothing.
    const Mixture degenerate{choose(1, Interval<double>{0, std::numeric_limits<double>::infinity()})};
    CHECK(degenerate.sample({0.5, 0.5}).pdf == 0);
}

TEMPLATE_TEST_CASE("mixtures nest", "[mixture]", float, double) {
    using T = TestType;
    const Interval<T> line{0, 1};
    const Ramp<T> ramp;
    const Gaussian<T> bump{T(0.5), T(0.1)};
    const Mixture inner{choose(0.5, line), choose(0.5, ramp)};
    const Mixture outer{choose(0.25, bump), choose(0.75, inner)};
    static_assert(inner.dimensions == 2);
    static_assert(outer.dimensions == 3);
    CountingUniforms<T> uniforms;
    for (int i = 0; i < 1000; ++i) {
        const auto s = outer.sample(uniforms.template next<3>());
        REQUIRE(s.pdf == outer.pdf(s.value));
        const T expected = T(0.25) * bump.pdf(s.value) + T(0.375) * (line.pdf(s.value) + ramp.pdf(s.value));
        REQUIRE(std::abs(s.pdf - expected) <= 4 * std::numeric_limits<T>::epsilon() * expected);
    }
    const Mixture single{choose(1, line)};
    static_assert(single.dimensions == 2);
    CHECK(single.sample({T(0.5), T(0.25)}).value == T(0.25));
}

TEST_CASE("a thousand defensive samples beat a hundred thousand of a bad Gaussian", "[mixture]") {
    const Mixture defensive{choose(0.5, too_narrow), choose(0.5, everywhere)};
    const auto bad = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, too_narrow));
    const auto safe = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, defensive));
    const auto both =
        lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, too_narrow), lumis::take(1, everywhere));
    const auto mean_squared_error = [](const auto& estimator, std::int64_t samples) {
        lumis::RunningMoments<> squares;
        for (std::uint64_t seed = 1; seed <= 16; ++seed) {
            const auto moments =
                moments_of<double>([&](auto& u) { return estimator.estimate(TwoBumps{}, u); }, samples, seed);
            squares.add(std::pow(moments.mean() - TwoBumps::integral(), 2));
        }
        return squares.mean();
    };
    const double bad_error = mean_squared_error(bad, 100'000);
    CHECK(9 * mean_squared_error(safe, 1'000) <= bad_error);
    CHECK(9 * mean_squared_error(both, 500) <= bad_error);
    const auto test = z_test<double>([&](auto& u) { return safe.estimate(TwoBumps{}, u); }, TwoBumps::integral(), 4);
    INFO(test.message);
    CHECK(test.passed);
}
