#include "assertions.hpp"
#include "catch.hpp"
#include "instrumented.hpp"
#include "one_dimensional.hpp"
#include "z_test.hpp"
#include <lumis/combine/one_sample.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/directions/uniform_hemisphere.hpp>
#include <lumis/microfacets/perfect_reflection.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <tuple>

using lumis::choose;
using lumis::one_sample;

TEST_CASE("a step: either technique may be selected, and the estimate is right", "[one_sample]") {
    const auto both = one_sample(lumis::BalanceHeuristic{}, choose(0.5, everywhere), choose(0.5, above));
    CountingUniforms<double> uniforms;
    for (int i = 0; i < 10'000; ++i) {
        // With balance weights an estimate is f over the mixed density: 8 / 0.5 or 80 / 5.5.
        const double estimate = both.estimate(Step{}, uniforms);
        REQUIRE((std::abs(estimate - 16) <= 1e-12 || std::abs(estimate - 160 / 11.0) <= 1e-12));
    }
    const auto test = z_test<double>([&](auto& u) { return both.estimate(Step{}, u); }, Step::integral, 1);
    INFO(test.message);
    CHECK(test.passed);
}

// The integral of x^2 + 1 over [0, 1] is 4/3.
TEMPLATE_TEST_CASE("every heuristic and every selection probability is unbiased", "[one_sample]", float, double) {
    using T = TestType;
    const auto f = [](T x) { return x * x + 1; };
    constexpr std::size_t family = 2 * 7 * 5;
    std::uint64_t seed = 200;
    const auto check = [&](const auto& heuristic_for) {
        for (const double c : {0.0, 0.1, 0.5, 0.9, 1.0}) {
            const auto combined = one_sample(heuristic_for(c), choose(c, Interval<T>{0, 1}), choose(1 - c, Ramp<T>{}));
            const auto test = z_test<T>([&](auto& u) { return combined.estimate(f, u); }, 4 / 3.0, ++seed, family);
            INFO("heuristic " << (seed - 201) / 5 << " with probability " << c);
            INFO(test.message);
            CHECK(test.passed);
            CHECK(test.relative_standard_error <= 0.001);
        }
    };
    check([](double) { return lumis::BalanceHeuristic{}; });
    check([](double) { return lumis::PowerHeuristic{}; });
    check([](double) { return lumis::PowerHeuristic{3.5}; });
    check([](double) { return lumis::MaximumHeuristic{}; });
    check([](double) { return lumis::CutoffHeuristic{0.7}; });
    check([](double) { return lumis::EqualWeights{}; });
    check(
        [](double c) { return lumis::PartitionWeights{[=](T x) { return c <= 0 || (c < 1 && x > T(0.4)) ? 1 : 0; }}; });
}

TEMPLATE_TEST_CASE("effective densities carry the selection probability", "[one_sample]", float, double) {
    using T = TestType;
    const auto combined =
        one_sample(lumis::BalanceHeuristic{}, choose(T(0.25), Interval<T>{0, 1}), choose(T(0.75), Ramp<T>{}));
    CHECK(combined.densities(T(0.25)) == std::array{T(0.25), T(0.75) * T(0.75)});
    CHECK(std::abs(combined.template weight<0>(T(0.25)) - T(0.25) / T(0.8125)) <= T(1e-7));
    CHECK(std::abs(combined.template weight<1>(T(0.25)) - T(0.5625) / T(0.8125)) <= T(1e-7));
    CHECK(combined.template weight<0>(T(2)) == 0);

    // A strategy is selected as often as its probability says.
    Calls first, second;
    const auto counted = one_sample(lumis::BalanceHeuristic{}, choose(0.25, Instrumented{Interval<T>{0, 1}, &first}),
                                    choose(0.75, Instrumented{Ramp<T>{}, &second}));
    CountingUniforms<T> uniforms;
    for (int i = 0; i < 40'000; ++i) std::ignore = counted.estimate([](T x) { return x; }, uniforms);
    CHECK(first.sample + second.sample == 40'000);
    CHECK(std::abs(first.sample - 10'000) <= 450);  // five standard deviations
    // Each sample asks for the other technique's density alone.
    CHECK(first.pdf == second.sample);
    CHECK(second.pdf == first.sample);
}

TEST_CASE("a technique with probability 0 is neither sampled nor evaluated", "[one_sample]") {
    Calls used, unused;
    CountingUniforms<double> uniforms;
    const auto run = [&](const auto& combined) {
        for (int i = 0; i < 1000; ++i) {
            REQUIRE(std::abs(combined.estimate([](double) { return 1.0; }, uniforms) - 1) <= 1e-15);
        }
        std::ignore = combined.densities(0.5);
        CHECK(combined.template weight<0>(0.5) + combined.template weight<1>(0.5) == 1);
    };
    run(one_sample(lumis::BalanceHeuristic{}, choose(0, Instrumented{Ramp<double>{}, &unused}),
                   choose(1, Instrumented{everywhere, &used})));
    run(one_sample(lumis::PowerHeuristic{}, choose(1, Instrumented{everywhere, &used}),
                   choose(0, Instrumented{Ramp<double>{}, &unused})));
    CHECK(unused.sample == 0);
    CHECK(unused.pdf == 0);
    CHECK(used.sample == 2000);
    CHECK(uniforms.spent == 2000 * 2);
}

TEST_CASE("uniforms are spent on the selection and on the technique selected", "[one_sample]") {
    Calls line, normal;
    const auto combined = one_sample(lumis::BalanceHeuristic{}, choose(0.5, Instrumented{everywhere, &line}),
                                     choose(0.5, Instrumented{too_narrow, &normal}));
    CountingUniforms<double> uniforms;
    for (int i = 0; i < 1000; ++i) std::ignore = combined.estimate(TwoBumps{}, uniforms);
    CHECK(uniforms.spent == 1000 + line.sample + 2 * normal.sample);

    // Where the probabilities sum to less than 1, the rest draws nothing, as in Russian roulette.
    Calls rare;
    CountingUniforms<double> others;
    const auto roulette = one_sample(Unasked{}, choose(0.25, Instrumented{everywhere, &rare}));
    double sum = 0;
    for (int i = 0; i < 40'000; ++i) sum += roulette.estimate([](double) { return 1.0; }, others);
    CHECK(std::abs(sum - 4 * rare.sample) <= 1e-9);
    CHECK(std::abs(rare.sample - 10'000) <= 450);
    CHECK(others.spent == 40'000 + rare.sample);
}

TEST_CASE("a heuristic by point asks for no density, one technique for no weight", "[one_sample]") {
    Calls first, second, single;
    const lumis::PartitionWeights by_half{[](double x) { return x < 0.5 ? 0 : 1; }};
    const auto combined = one_sample(by_half, choose(0.5, Instrumented{everywhere, &first}),
                                     choose(0.5, Instrumented{Ramp<double>{}, &second}));
    const auto plain = one_sample(Unasked{}, choose(1, Instrumented{Ramp<double>{}, &single}));
    CountingUniforms<double> uniforms, again, selecting;
    for (int i = 0; i < 100; ++i) {
        const auto drawn = Ramp<double>{}.sample(again.next<1>());
        REQUIRE(std::abs(plain.estimate([](double x) { return x; }, uniforms) - drawn.value / drawn.pdf) <= 1e-15);
        std::ignore = combined.estimate([](double x) { return x; }, selecting);
    }
    CHECK(uniforms.spent == 100);
    CHECK(single.pdf == 0);
    CHECK(first.pdf + second.pdf == 0);
    CHECK(first.sample + second.sample == 100);
}

namespace {

// Some hosts' uniforms are rounded up to 1.
struct Ones {
    template <int N>
    glm::vec<N, float> next() {
        return glm::vec<N, float>(1.0f);
    }
};

}  // namespace

TEST_CASE("a uniform of exactly 1 is tolerated", "[one_sample]") {
    const auto combined = one_sample(lumis::BalanceHeuristic{}, choose(0.3f, lumis::CosineHemisphere{}),
                                     choose(0.7f, lumis::UniformHemisphere{}));
    const float estimate = combined.estimate([](const auto& w) -> float { return w.z; }, Ones{});
    CHECK(estimate >= 0);
    CHECK(estimate <= 10);
}

TEST_CASE("an integrand takes the sample and returns a color", "[one_sample]") {
    const auto combined = one_sample(lumis::BalanceHeuristic{}, choose(0.3f, lumis::CosineHemisphere{}),
                                     choose(0.7f, lumis::UniformHemisphere{}));
    CountingUniforms<float> uniforms, again;
    for (int i = 0; i < 100; ++i) {
        const float expected = combined.estimate([](const lumis::Direction<float>& w) { return w.z; }, uniforms);
        const glm::vec3 color = combined.estimate(
            [](const lumis::AnySample auto& s) {
                return s.value.z * glm::vec3{1, 2, 4};
            },
            again);
        REQUIRE(color == expected * glm::vec3{1, 2, 4});
    }
}

// A white mirror coat of reflectance 0.4 on a diffuse base of albedo 0.5 under a white sky reflects 0.9.
TEMPLATE_TEST_CASE("a delta strategy is weighed by its selection alone", "[one_sample][delta]", float, double) {
    using T = TestType;
    const lumis::PerfectReflection<T> mirror{lumis::Direction<T>{T(0.6), 0, T(0.8)}};
    struct Coated {
        T operator()(const lumis::Direction<T>& w) const { return T(0.5) * w.z * std::numbers::inv_pi_v<T>; }
        T operator()(const lumis::Direction<T>&, lumis::delta_t) const { return T(0.4); }
    };
    CountingUniforms<T> uniforms;
    CHECK(one_sample(Unasked{}, choose(1, mirror)).estimate(Coated{}, uniforms) == T(0.4));

    const auto with_base = one_sample(Unasked{}, choose(0.25, mirror), choose(0.75, lumis::CosineHemisphere<T>{}));
    const T tolerance = 8 * std::numeric_limits<T>::epsilon();
    for (int i = 0; i < 1000; ++i) {
        const T estimate = with_base.estimate(Coated{}, uniforms);
        REQUIRE((std::abs(estimate - T(1.6)) <= tolerance || std::abs(estimate - T(0.5) / T(0.75)) <= tolerance));
    }
    const auto lobes = z_test<T>([&](auto& u) { return with_base.estimate(Coated{}, u); }, 0.9, 8);
    INFO(lobes.message);
    CHECK(lobes.passed);

    const auto three = one_sample(lumis::PowerHeuristic{}, choose(0.4, lumis::UniformHemisphere<T>{}),
                                  choose(0.2, mirror), choose(0.4, lumis::CosineHemisphere<T>{}));
    const auto test = z_test<T>([&](auto& u) { return three.estimate(Coated{}, u); }, 0.9, 9);
    INFO(test.message);
    CHECK(test.passed);
}
