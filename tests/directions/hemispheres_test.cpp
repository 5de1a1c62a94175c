// The two hemispheres and the mirror.
#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/stability.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace {

namespace laws = lumis::testing;

template <class S>
void check_edges(const S& strategy) {
    using T = typename S::Scalar;
    const auto stable = laws::stays_finite(strategy);
    INFO(stable.message);
    CHECK(stable.passed);

    CHECK(strategy.pdf({T(0.6), T(0), T(-0.8)}) == 0);
    CHECK(strategy.pdf({T(1), T(0), T(0)}) == 0);
    CHECK(strategy.sample({T(1), T(0.3)}).pdf == 0);
    for (const T y : {T(0), T(0.5), T(1)}) CHECK(strategy.sample({T(0), y}).value.z == 1);
    // The last uniform below 1 still draws.
    CHECK(strategy.sample({1 - std::numeric_limits<T>::epsilon() / 2, T(0)}).pdf > 0);
}

template <class S>
void check_round_trip(const S& strategy) {
    using T = typename S::Scalar;
    lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{1}};
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto u = uniforms.template next<2>();
        const auto difference = strategy.invert(strategy.sample(u).value) - u;
        worst = std::fmax(worst, double{std::abs(difference.x)});
        worst = std::fmax(worst, std::abs(std::remainder(double{difference.y}, 1)) * double{std::sqrt(u.x)});
    }
    CHECK(worst <= 4 * double{std::numeric_limits<T>::epsilon()});
}

}  // namespace

TEMPLATE_TEST_CASE("hemispheres at their edges", "[hemisphere]", float, double) {
    check_edges(lumis::CosineHemisphere<TestType>{});
    check_edges(lumis::UniformHemisphere<TestType>{});
}

TEMPLATE_TEST_CASE("hemispheres invert", "[hemisphere]", float, double) {
    STATIC_REQUIRE(lumis::InvertibleStrategy<lumis::CosineHemisphere<TestType>>);
    STATIC_REQUIRE(lumis::InvertibleStrategy<lumis::UniformHemisphere<TestType>>);
    check_round_trip(lumis::CosineHemisphere<TestType>{});
    check_round_trip(lumis::UniformHemisphere<TestType>{});
}

TEMPLATE_TEST_CASE("hemisphere densities have their closed form", "[hemisphere]", float, double) {
    using T = TestType;
    const glm::vec<3, T> w{T(0.48), T(0.64), T(0.6)};
    CHECK(lumis::CosineHemisphere<T>{}.pdf(w) == Approx(0.6 / std::numbers::pi));
    CHECK(lumis::UniformHemisphere<T>{}.pdf(w) == Approx(0.5 / std::numbers::pi));
}

TEMPLATE_TEST_CASE("a mirror reflects in one direction, with probability 1", "[perfect_reflection]", float, double) {
    using T = TestType;
    STATIC_REQUIRE(lumis::DeltaStrategy<lumis::PerfectReflection<T>>);
    const glm::vec<3, T> wo{T(0.48), T(0.64), T(0.6)};
    const lumis::PerfectReflection<T> mirror{wo};
    const auto sample = mirror.sample({T(0.1), T(0.9)});
    CHECK(sample.value == glm::vec<3, T>{-wo.x, -wo.y, wo.z});
    CHECK(sample.pdf == 1);
    CHECK(mirror.pdf(sample.value) == 0);

    const T nan = std::numeric_limits<T>::quiet_NaN();
    for (const auto& below :
         {glm::vec<3, T>{wo.x, wo.y, -wo.z}, glm::vec<3, T>{T(1), T(0), T(0)}, glm::vec<3, T>{nan, nan, nan}}) {
        const CaughtAssertions caught;  // of NaN
        const auto law = laws::draws_nothing(lumis::PerfectReflection<T>{below});
        INFO(law.message);
        CHECK(law.passed);
    }
}
