// What resampling draws, spends and tells; resample_laws_test.cpp is about its expectation.
#include "assertions.hpp"
#include "catch.hpp"
#include "instrumented.hpp"
#include "one_dimensional.hpp"
#include <lumis/combine/mixture.hpp>
#include <lumis/combine/multi_sample.hpp>
#include <lumis/combine/one_sample.hpp>
#include <lumis/combine/resample.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/directions/uniform_hemisphere.hpp>
#include <lumis/lights/area_light.hpp>
#include <lumis/lights/light_set.hpp>
#include <lumis/lights/surface_light.hpp>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using lumis::choose;
using lumis::multi_sample;
using lumis::one_sample;
using lumis::resample;
using lumis::take;

// Both spend the same numbers on the same estimates.
template <class T>
void check_same(const auto& resampled, const auto& plain, const auto& f) {
    CountingUniforms<T> uniforms, others;
    for (int i = 0; i < 1000; ++i) REQUIRE(resampled.estimate(f, uniforms) == plain.estimate(f, others));
    CHECK(uniforms.spent == others.spent);
    CHECK(resampled.uniforms_per_estimate() == plain.uniforms_per_estimate());
}

TEMPLATE_TEST_CASE("a single candidate is plain Monte Carlo, bit for bit", "[resample]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const lumis::BalanceHeuristic balance;
    const lumis::AreaLight light{lumis::Triangle<T>{V(-1, -1, 2), V(2, -1, 2), V(0, 1, 3)}, V(T(0))};
    const lumis::CosineHemisphere<T> cosine;
    const auto target = [](const V& w) { return T(0.3) + w.x * w.x; };
    const auto number = [](const V& w) { return w.z * w.y; };
    const auto color = [](const V& w) { return w * w.z; };
    const auto of_sample = [](const lumis::AnySample auto& s) { return s.distance * s.value.z; };

    check_same<T>(resample(target, take(1, light)), multi_sample(balance, take(1, light)), number);
    check_same<T>(resample(target, take(1, light)), multi_sample(balance, take(1, light)), color);
    check_same<T>(resample(target, take(1, light)), multi_sample(balance, take(1, light)), of_sample);
    check_same<T>(resample(target, take(1, light), take(0, cosine)),
                  multi_sample(balance, take(1, light), take(0, cosine)), of_sample);
    check_same<T>(resample(target, 1, choose(1, light)), one_sample(balance, choose(1, light)), number);
    check_same<T>(resample(target, 1, choose(0.3, light), choose(0.5, cosine)),
                  one_sample(balance, choose(0.3, light), choose(0.5, cosine)), of_sample);
    // The weight of a sample rounds once more: f / p against f times 1 / p.
    CountingUniforms<T> uniforms, others;
    const auto s = resample(target, take(1, light)).sample(uniforms);
    CHECK(s.contribution_weight == 1 / s.sample.pdf);
    CHECK(s.sample.value == light.sample(others.template next<2>()).value);
}

TEST_CASE("candidates and selections spend uniforms, whatever is drawn", "[resample]") {
    CountingUniforms<double> uniforms;
    const auto spent_by = [&](const auto& resampled) {
        uniforms.spent = 0;
        std::ignore = resampled.estimate(Step{}, uniforms);
        return uniforms.spent;
    };
    const auto one = [](double) { return 1; };
    const auto taken = resample(one, take(3, everywhere), take(0, too_narrow), take(2, Gaussian<double>{0.5, 1}));
    CHECK(spent_by(taken) == 3 * 1 + 2 * 2 + 4);
    CHECK(taken.uniforms_per_estimate() == 3 * 1 + 2 * 2 + 4);
    CHECK(taken.candidates() == 5);

    // A choice of what draws nothing has been made all the same.
    const auto chosen = resample(one, 6, choose(0.5, everywhere), choose(0.25, above));
    CHECK(chosen.candidates() == 6);
    CHECK(chosen.uniforms_per_estimate() == 6 * 2 + 5);
    for (int i = 0; i < 10; ++i) {
        const int spent = spent_by(chosen);
        CHECK(spent <= 6 * 2 + 5);
        CHECK(spent >= 6 + 5);
    }
    const auto none = resample(one, take(0, everywhere));
    CHECK(spent_by(none) == 0);
    CHECK(none.estimate(Step{}, uniforms) == 0);
}

TEST_CASE("balance asks all techniques at every candidate with a target", "[resample]") {
    std::array<Calls, 3> calls;
    const auto counted = [&](const auto& heuristic, const auto& target) {
        calls = {};
        CountingUniforms<double> uniforms;
        const auto resampled = resample(heuristic, target, take(2, Instrumented{everywhere, &calls[0]}),
                                        take(4, Instrumented{Ramp<double>{}, &calls[1]}),
                                        take(6, Instrumented{Interval<double>{0, 2}, &calls[2]}));
        std::ignore = resampled.estimate([](double) { return 0.0; }, uniforms);
        return std::array{calls[0].pdf, calls[1].pdf, calls[2].pdf};
    };
    const auto one = [](double) { return 1; };
    CHECK(counted(lumis::BalanceHeuristic{}, one) == std::array{4 + 6, 2 + 6, 2 + 4});
    // Pairs ask the first technique, and the first all others.
    CHECK(counted(lumis::PairwiseWeights{}, [](double x) { return x <= 1 ? 1 : 0; })[1] == 2);
    CHECK(counted(lumis::PairwiseWeights{}, [](double x) { return x <= 1 ? 1 : 0; })[2] == 2);
    CHECK(counted(lumis::BalanceHeuristic{}, [](double) { return 0; }) == std::array{0, 0, 0});
}

TEST_CASE("nothing is resampled where all targets are 0", "[resample]") {
    CountingUniforms<float> uniforms;
    const auto dark = resample([](float) { return 0.0f; }, take(5, Interval<float>{0, 1}), take(2, Ramp<float>{}));
    const auto s = dark.sample(uniforms);
    CHECK(s.contribution_weight == 0);
    CHECK(std::isfinite(s.sample.value));
    int calls = 0;
    CHECK(dark.estimate([&](float) { return ++calls, 0.0f; }, uniforms) == 0);
#ifdef NDEBUG
    CHECK(calls == 0);
#endif
}

TEST_CASE("a target that is 0 where the integrand is not fails an assertion", "[resample]") {
    CountingUniforms<double> uniforms;
    const auto upper = resample([](double x) { return x > 0.5 ? 1 : 0; }, take(8, everywhere), take(8, Ramp<double>{}));
    const auto asserted = [&](const auto& f) {
        const CaughtAssertions caught;
        for (int i = 0; i < 4; ++i) std::ignore = upper.estimate(f, uniforms);
        return caught.count();
    };
    CHECK(asserted([](double x) { return x > 0.5 ? x : 0.0; }) == 0);
    CHECK(asserted([](double) { return 1.0; }) > 0);
    CHECK(asserted([](double x) { return glm::vec2{x > 0.5 ? 1 : 0, 0}; }) == 0);
    CHECK(asserted([](double) { return glm::vec2{0, 1}; }) > 0);
    // Two that are no targets; the first also counts as missing what the integrand has.
    const CaughtAssertions caught;
    const auto zero = [](double) { return 0.0; };
    std::ignore = resample([](double) { return -1.0; }, take(1, everywhere)).estimate(zero, uniforms);
    std::ignore = resample([](double) { return std::nan(""); }, take(1, everywhere)).estimate(zero, uniforms);
    CHECK(caught.count() == 2);
}

TEMPLATE_TEST_CASE("a candidate that is next to nothing beside another is not selected by u = 0", "[resample]", float,
                   double) {
    using T = TestType;
    constexpr T tiny = 2 * (std::numeric_limits<T>::min)();
    const auto target = [](T x) { return x < T(0.5) ? 1 / tiny : tiny; };
    const auto two = resample(target, take(2, Interval<T>{0, 1}));
    const auto numbers = [i = 0]() mutable { return i++ == 1 ? T(0.75) : T(0); };
    const auto s = two.sample(lumis::uniforms_from<T>(numbers));
    CHECK(s.sample.value == 0);
    CHECK(s.contribution_weight == T(0.5));
    CHECK(two.estimate([](T x) { return x; }, lumis::uniforms_from<T>(numbers)) == 0);
}

// Resampling weights, target over density, that numbers T do not hold.
TEMPLATE_TEST_CASE("the scale of a target does not matter", "[resample]", float, double) {
    using T = TestType;
    constexpr int range = std::numeric_limits<T>::max_exponent;
    const lumis::BalanceHeuristic balance;
    for (const int exponent : {-range / 2, 0, range / 2}) {
        const Interval<T> some{0, std::ldexp(T(1), exponent)};
        const auto f = [&](T x) { return x * std::ldexp(T(1), -exponent); };
        for (const int size : {4 - range, -range / 2, range / 2, range - 4}) {
            const auto target = [=](T) { return std::ldexp(T(1), size); };
            check_same<T>(resample(target, take(1, some)), multi_sample(balance, take(1, some)), f);
            CountingUniforms<T> uniforms;
            for (int i = 0; i < 100; ++i) {
                CHECK(resample(target, take(4, some)).sample(uniforms).contribution_weight == some.high - some.low);
                CHECK(resample(target, take(2, some), take(2, some)).estimate([](T) { return T(1); }, uniforms) ==
                      some.high - some.low);
            }
        }
    }
}

// The integrand gets whole samples: the distance to the nearest light, whichever technique drew, its surface, its index.
TEST_CASE("what a light tells of a candidate reaches target and integrand", "[resample]") {
    using glm::dvec3;
    const lumis::Triangle<double> triangle{dvec3{-1, -1, 2}, dvec3{2, -1, 2}, dvec3{0, 1, 3}};
    const lumis::CosineHemisphere<double> cosine;
    CountingUniforms<double> uniforms;
    const auto near = [](const lumis::AnySample auto& s) { return std::isinf(s.distance) ? 0.0 : 1 / s.distance; };

    const lumis::SurfaceLight panel{triangle, dvec3{0}};
    const auto both = resample(near, take(2, cosine), take(2, panel));
    int met = 0;
    for (int i = 0; i < 100; ++i) {
        const auto s = both.sample(uniforms);
        static_assert(std::same_as<decltype(s.sample), lumis::SurfaceLightSample<dvec3, double>>);
        if (!(s.contribution_weight > 0)) continue;
        ++met;
        REQUIRE(glm::distance(s.sample.surface.position, s.sample.distance * s.sample.value) <= 1e-12);
        std::ignore = both.estimate(
            [](const lumis::AnySample auto& drawn) {
                REQUIRE((std::isinf(drawn.distance) || std::abs(drawn.surface.position.z - 2) <= 1));
                return std::isinf(drawn.distance) ? 0.0 : 1.0;
            },
            uniforms);
    }
    CHECK(met > 50);

    const lumis::LightSet set{std::vector{lumis::AreaLight{triangle, dvec3{0}}}, std::vector{1.0}};
    const auto alone = resample(near, take(3, set)).sample(uniforms);
    CHECK(alone.sample.index == 0);
    CHECK(alone.sample.distance >= 2);
}

struct Even {
    float operator()(const glm::vec3&) const { return 1; }
};
static_assert(
    std::is_trivially_copyable_v<decltype(resample(Even{}, take(2, std::declval<lumis::CosineHemisphere<float>>())))>);

}  // namespace
