// The laws of sample as a map, over every strategy: what it does to areas, that it can be undone, that rounding does not
// carry it away.
#include "catch.hpp"
#include "strategies.hpp"
#include <lumis/testing/laws.hpp>

#include <concepts>
#include <vector>

namespace {

namespace laws = lumis::testing;

// Over all instances of a list's strategy in T: a law about each subject.
template <class T, class List, class Law>
void check_all(Law ask) {
    for (const auto& subject : List::template make<T>()) {
        const auto law = ask(subject);
        INFO(subject.label << ": " << law.message);
        CHECK(law.passed);
    }
}

template <class List>
using StrategyOf = decltype(List::template make<double>().front().strategy);

}  // namespace

TEMPLATE_LIST_TEST_CASE("the density is the reciprocal of the Jacobian", "[laws]", Strategies) {
    // An alias row draws a texel by several runs of uniforms.
    constexpr bool one_to_one = !std::same_as<TestType, subjects::AliasEnvironmentMap>;
    if constexpr (laws::MapsUniforms<StrategyOf<TestType>> && one_to_one) {
        check_all<double, TestType>([](const auto& subject) { return laws::jacobian(subject.strategy); });
    }
}

TEMPLATE_LIST_TEST_CASE("invert undoes sample", "[laws]", Strategies) {
    const auto ask = [](const auto& subject) { return laws::round_trip(subject.strategy, subject.round_trip); };
    if constexpr (lumis::InvertibleStrategy<StrategyOf<TestType>>) {
        check_all<float, TestType>(ask);
        check_all<double, TestType>(ask);
    }
}

TEMPLATE_LIST_TEST_CASE("whatever is asked, the answer is finite", "[laws]", Strategies) {
    const auto ask = [](const auto& subject) { return laws::stays_finite(subject.strategy); };
    check_all<float, TestType>(ask);
    check_all<double, TestType>(ask);
}

namespace {

// Strategies of one parameter, in float and in double.
constexpr auto sphere_light = []<class T>(double radius) {
    const lumis::Sphere<T> sphere{{T(1), T(-2), T(2)}, static_cast<T>(radius)};
    return lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle>{sphere, glm::vec<3, T>(T(0))};
};
constexpr auto triangle_light = []<class T>(double edge) {
    using V = glm::vec<3, T>;
    const lumis::Triangle<T> triangle{V(0, 0, 2), V(static_cast<T>(edge), T(0), T(2)),
                                      V(T(0), static_cast<T>(edge), T(2))};
    return lumis::AreaLight<lumis::Triangle<T>, lumis::BySolidAngle>{triangle, V(T(1), T(0.5), T(0))};
};
constexpr auto ggx_reflection = []<class T>(double alpha) {
    return lumis::GgxReflection<T>{{T(0.6), T(0), T(0.8)}, glm::vec<2, T>(static_cast<T>(alpha))};
};
constexpr auto ggx_bounded_reflection = []<class T>(double alpha) {
    return lumis::GgxBoundedReflection<T>{{T(0.6), T(0), T(0.8)}, glm::vec<2, T>(static_cast<T>(alpha))};
};

}  // namespace

// Sweeps over decades, of parameters that float holds exactly.
TEST_CASE("float draws nearly what double draws", "[laws]") {
    const auto check = [](const laws::LawResult& law) {
        INFO(law.message);
        CHECK(law.passed);
    };
    // By the tangent's point, where the root of the remaining height has half of float's digits.
    check(laws::stability(std::vector{0x1p-14, 0x1p-10, 0x1p-5, 0.5, 1.0, 2.5, 2.984375, 4.0}, sphere_light,
                          {.value = 1e-6, .pdf = 1e-5}));
    check(laws::stability(std::vector{0x1p-14, 0x1p-10, 0x1p-5, 0.5, 1.0, 32.0, 1024.0}, triangle_light,
                          {.value = 1e-4, .pdf = 1e-4}));
    // The lobe's far tail, and the horizon, at the last uniforms below 1.
    check(laws::stability(std::vector{0x1p-6, 0x1p-4, 0.25, 0.5, 1.0}, ggx_reflection,
                          {.value = 1e-4, .pdf = 1e-3, .undecided = 0.02}));
    check(laws::stability(std::vector{0x1p-6, 0x1p-4, 0.25, 0.5, 1.0}, ggx_bounded_reflection,
                          {.value = 1e-4, .pdf = 1e-3, .undecided = 0.02}));
}

TEST_CASE("a delta strategy has no density", "[laws]") {
    const auto check = [](const auto& strategy) {
        const auto law = laws::draws_deltas(strategy);
        INFO(law.message);
        CHECK(law.passed);
    };
    const auto check_in = [&]<class T>(T) {
        using V = glm::vec<3, T>;
        for (const V& wo : {V(T(0.48), T(0.64), T(0.6)), V(0, 0, 1), V(1, 0, 0), V(0, 0, -1)}) {
            check(lumis::PerfectReflection<T>{wo});
            check(lumis::in_frame(lumis::Frame<T>{V(T(0.6), T(0), T(-0.8))}, lumis::PerfectReflection<T>{wo}));
            check(lumis::SmoothDielectric<T>{wo, 1.5});
            check(lumis::SmoothDielectric<T>{wo, 1 / 2.4});
            check(lumis::DirectionalLight<T>{wo});
            check(lumis::PointLight{wo, V(T(0.1), T(2), T(-1))});
            check(lumis::PointLight{wo, wo});
        }
    };
    check_in(1.0f);
    check_in(1.0);
}
