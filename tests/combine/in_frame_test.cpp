#include "assertions.hpp"
#include "catch.hpp"
#include "instrumented.hpp"
#include "one_dimensional.hpp"
#include "z_test.hpp"
#include <lumis/combine/in_frame.hpp>
#include <lumis/combine/multi_sample.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/directions/uniform_hemisphere.hpp>
#include <lumis/lights/environment_map.hpp>
#include <lumis/microfacets/perfect_reflection.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

using lumis::Direction;
using lumis::Frame;
using lumis::in_frame;

TEMPLATE_TEST_CASE("a local strategy is carried to the world with its density", "[in_frame]", float, double) {
    using T = TestType;
    const T epsilon = std::numeric_limits<T>::epsilon();
    const Direction<T> normal = glm::normalize(Direction<T>{1, -2, T(0.5)});
    const Frame<T> frame{normal};
    const lumis::CosineHemisphere<T> local;
    const auto world = in_frame(frame, local);
    static_assert(lumis::InvertibleStrategy<decltype(world)>);
    static_assert(world.dimensions == 2);
    CountingUniforms<T> uniforms;
    for (int i = 0; i < 1000; ++i) {
        const auto u = uniforms.template next<2>();
        const auto s = world.sample(u), original = local.sample(u);
        REQUIRE(s.pdf == original.pdf);
        REQUIRE(std::abs(world.pdf(s.value) - s.pdf) <= 4 * epsilon);
        REQUIRE(std::abs(glm::dot(s.value, normal) - original.value.z) <= 4 * epsilon);
        REQUIRE(glm::length(world.invert(s.value) - u) <= 64 * epsilon);
    }
    CHECK(world.pdf(-normal) == 0);
    CHECK(std::abs(world.pdf(normal) - std::numbers::inv_pi_v<T>) <= 4 * epsilon);

    // The cosine about the normal integrates to pi, with no variance.
    const auto plain = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, world));
    const T integral = plain.estimate([&](const Direction<T>& w) { return glm::dot(w, normal); }, uniforms);
    CHECK(std::abs(integral - std::numbers::pi_v<T>) <= 200 * epsilon);
}

TEMPLATE_TEST_CASE("a mirror in a frame reflects about the normal and stays a delta", "[in_frame]", float, double) {
    using T = TestType;
    const Direction<T> normal = glm::normalize(Direction<T>{T(0.1), 1, T(0.3)});
    const Direction<T> wo = glm::normalize(Direction<T>{T(0.7), T(0.6), T(-0.2)});
    const Frame<T> frame{normal};
    const auto mirror = in_frame(frame, lumis::PerfectReflection<T>{frame.to_local(wo)});
    static_assert(lumis::DeltaStrategy<decltype(mirror)>);
    static_assert(!lumis::DeltaStrategy<decltype(in_frame(frame, lumis::UniformHemisphere<T>{}))>);
    const auto s = mirror.sample({T(0.5), T(0.5)});
    CHECK(s.pdf == 1);
    const Direction<T> expected = 2 * glm::dot(wo, normal) * normal - wo;
    CHECK(glm::length(s.value - expected) <= 8 * std::numeric_limits<T>::epsilon());
    CHECK(mirror.pdf(s.value) == 0);
}

TEST_CASE("the kind of sample is kept", "[in_frame]") {
    const float luminance[] = {1, 2, 3, 4};
    const lumis::EnvironmentMap map{2, 2, luminance};
    const auto turned = in_frame(Frame<float>{{1, 0, 0}}, map);
    const auto s = turned.sample({0.4f, 0.7f});
    CHECK(s.pdf > 0);
    CHECK(std::isinf(s.distance));
    CHECK(turned.pdf(s.value) == s.pdf);
}

TEST_CASE("a strategy that owns memory is not copied", "[in_frame]") {
    using Table = Owning<lumis::CosineHemisphere<float>>;
    Table::Log log;
    const Table table{lumis::CosineHemisphere<float>{}, log};
    const Frame<float> frame{{0, 0, 1}};
    const auto by_reference = in_frame(frame, table);
    CHECK(by_reference.pdf({0, 0, 1}) > 0);
    CHECK(log.copies + log.moves == 0);
    const auto by_value = in_frame(frame, Table{lumis::CosineHemisphere<float>{}, log});
    CHECK(by_value.pdf({0, 0, 1}) > 0);
    CHECK(log.copies == 0);
    CHECK(log.moves > 0);
}

TEST_CASE("a combination in the world mixes local and world strategies", "[in_frame]") {
    const Direction<double> normal = glm::normalize(Direction<double>{1, 1, 1});
    const Frame<double> frame{normal};
    const auto combined =
        lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, in_frame(frame, lumis::CosineHemisphere<double>{})),
                            lumis::take(1, in_frame(frame, lumis::UniformHemisphere<double>{})));
    const auto squared_cosine = [&](const Direction<double>& w) {
        const double cosine = glm::dot(w, normal);
        return cosine * cosine;
    };
    const auto test =
        z_test<double>([&](auto& u) { return combined.estimate(squared_cosine, u); }, 2 * std::numbers::pi / 3, 1);
    INFO(test.message);
    CHECK(test.passed);
}
