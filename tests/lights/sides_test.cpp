// Lights of one side: seen from in front they are what lights of both are, and from behind nothing.
#include "catch.hpp"
#include "irradiance.hpp"
#include "light_shapes.hpp"
#include <lumis/core/lanes.hpp>
#include <lumis/lumis.hpp>
#include <lumis/testing/laws.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace {

namespace laws = lumis::testing;

const glm::dvec3 middle{0.5, -1, 2};

// A point on the side of the shape's normal at its middle, and one on the other.
template <class T, class Shape>
glm::vec<3, T> beside(const Shape& shape, double height) {
    const glm::dvec2 uv{0.3, 0.3};
    return shapes::point<T>(shapes::position(shape, uv) + height * shapes::normal(shape, uv));
}

template <class Light>
void check_nothing(const Light& light, const glm::vec<3, typename Light::Scalar>& towards) {
    using T = typename Light::Scalar;
    const auto law = laws::draws_nothing(light);
    INFO(law.message);
    CHECK(law.passed);
    CHECK(light.pdf(towards) == 0);
    CHECK(light.distance_along(towards) == std::numeric_limits<T>::infinity());
    CHECK(light.pdf_from_hit(T(0.5), T(0.7)) == 0);
    CHECK(light.pdf_from_hit(T(0.5), T(-0.7)) == 0);
}

}  // namespace

TEMPLATE_TEST_CASE("behind a light of one side there is nothing", "[sides]", float, double) {
    using T = TestType;
    shapes::for_each_light<T>(middle, 1, [](const auto& shape, auto sampling) {
        using Shape = std::remove_cvref_t<decltype(shape)>;
        using Light = lumis::AreaLight<Shape, decltype(sampling)>;
        const auto front = beside<T>(shape, 0.4), back = beside<T>(shape, -0.4);
        const auto target = shapes::point<T>(shapes::position(shape, {0.3, 0.3}));
        check_nothing(Light{shape, back, lumis::Sides::One}, glm::normalize(target - back));
        check_nothing(lumis::SurfaceLight<Shape, decltype(sampling)>{shape, back, lumis::Sides::One},
                      glm::normalize(target - back));

        const Light both{shape, front}, one{shape, front, lumis::Sides::One}, said{shape, back, lumis::Sides::Both};
        CHECK(said.distance_along(glm::normalize(target - back)) == Approx(0.4));
        auto uniforms = irradiance::uniforms<T>(1);
        for (int i = 0; i < 200; ++i) {
            const auto u = uniforms.template next<2>();
            const auto expected = both.sample(u), drawn = one.sample(u);
            REQUIRE((drawn.value == expected.value && drawn.pdf == expected.pdf));
            REQUIRE(drawn.distance == expected.distance);
            if (!(drawn.pdf > 0)) continue;
            REQUIRE(one.pdf(drawn.value) == both.pdf(drawn.value));
            REQUIRE(one.distance_along(drawn.value) == both.distance_along(drawn.value));
            REQUIRE(one.pdf_from_hit(drawn.distance, T(0.3)) == both.pdf_from_hit(drawn.distance, T(0.3)));
        }
    });
}

TEMPLATE_TEST_CASE("the other order of vertices turns a light over", "[sides]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const V a{T(-1), T(0), T(1)}, b{T(1), T(0), T(1)}, c{T(0), T(1), T(1)}, origin{T(0), T(0), T(0)};
    const auto draws = [&](const auto& shape) {
        return lumis::AreaLight{shape, origin, lumis::Sides::One}.sample({T(0.5), T(0.5)}).pdf > 0;
    };
    CHECK(!draws(lumis::Triangle<T>{a, b, c}));  // its normal is +z
    CHECK(draws(lumis::Triangle<T>{a, c, b}));
    CHECK(!draws(lumis::Parallelogram<T>{a, b - a, c - a}));
    CHECK(draws(lumis::Parallelogram<T>{a, c - a, b - a}));
    CHECK(!draws(lumis::Disk<T>{a, {T(0), T(0), T(2)}, T(3)}));
    CHECK(draws(lumis::Disk<T>{a, {T(0), T(0), T(-2)}, T(3)}));
}

// Each lane has a reference point of its own, every other one behind.
TEMPLATE_TEST_CASE("lights of one side in lanes", "[sides]", float, double) {
    using T = TestType;
    using L = lumis::Lanes<T, 4>;
    const auto check = [&](const auto& shape, const auto& shape_in_lanes, auto sampling) {
        const auto front = beside<T>(shape, 0.4), back = beside<T>(shape, -0.4);
        glm::vec<3, L> from;
        for (int k = 0; k < 3; ++k) from[k] = L::of_lanes([&](auto i) { return i % 2 == 0 ? front[k] : back[k]; });
        using Lanes = lumis::AreaLight<std::remove_cvref_t<decltype(shape_in_lanes)>, decltype(sampling)>;
        using One = lumis::AreaLight<std::remove_cvref_t<decltype(shape)>, decltype(sampling)>;
        const Lanes light{shape_in_lanes, from, lumis::Sides::One};
        const One alone{shape, front, lumis::Sides::One};
        const glm::vec<2, T> u{T(0.1), T(0.3)};
        const auto drawn = light.sample(glm::vec<2, L>{L(u.x), L(u.y)});
        const auto expected = alone.sample(u);
        CHECK(drawn.pdf[0] == Approx(expected.pdf));
        CHECK(drawn.pdf[2] == Approx(expected.pdf));
        CHECK(drawn.pdf[1] == 0);
        CHECK(drawn.pdf[3] == 0);
        const auto pdf = light.pdf(drawn.value), distance = light.distance_along(drawn.value);
        CHECK(pdf[0] == Approx(expected.pdf));
        CHECK(pdf[1] == 0);
        CHECK(distance[0] == Approx(expected.distance));
        CHECK(distance[1] == std::numeric_limits<T>::infinity());
    };
    const auto& [triangle, rectangle, skew, disk, sphere] = shapes::each<T>(middle, 1);
    using V = glm::vec<3, L>;
    check(triangle, lumis::Triangle<L>{V(triangle.a), V(triangle.b), V(triangle.c)}, lumis::ByArea{});
    check(skew, lumis::Parallelogram<L>{V(skew.corner), V(skew.edge_u), V(skew.edge_v)}, lumis::ByArea{});
    check(disk, lumis::Disk<L>{V(disk.center), V(disk.normal), L(disk.radius)}, lumis::ByArea{});
    check(sphere, lumis::Sphere<L>{V(sphere.center), L(sphere.radius)}, lumis::BySolidAngle{});
}
