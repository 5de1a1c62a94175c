// Shapes take their scalar from what they are made of, and every one makes a light.
#include "catch.hpp"
#include <lumis/lumis.hpp>

#include <cmath>
#include <concepts>
#include <type_traits>

namespace {

template <class Shape, class T, class... Sampling>
constexpr bool makes_lights = std::same_as<typename Shape::Scalar, T>&& std::is_trivially_copyable_v<Shape> &&
                              (lumis::Strategy<lumis::AreaLight<Shape, Sampling>> && ...) &&
                              ((lumis::AreaLight<Shape, Sampling>::dimensions == 2) && ...) &&
                              (std::is_trivially_destructible_v<lumis::AreaLight<Shape, Sampling>> && ...);

}  // namespace

TEMPLATE_TEST_CASE("shapes deduce their scalar and make lights", "[shapes]", float, double) {
    using T = TestType;
    const glm::vec<3, T> a{T(0), T(0), T(1)}, b{T(1), T(0), T(1)}, c{T(0), T(1), T(1)};
    const lumis::Triangle triangle{a, b, c};
    const lumis::Parallelogram parallelogram{a, b, c};
    const lumis::Disk disk{a, b, T(2)};
    const lumis::Sphere sphere{a, T(0.5)};
    using lumis::ByArea, lumis::BySolidAngle;
    STATIC_REQUIRE(makes_lights<std::remove_const_t<decltype(triangle)>, T, ByArea, BySolidAngle>);
    STATIC_REQUIRE(makes_lights<std::remove_const_t<decltype(parallelogram)>, T, ByArea, BySolidAngle>);
    STATIC_REQUIRE(makes_lights<std::remove_const_t<decltype(disk)>, T, ByArea>);
    STATIC_REQUIRE(makes_lights<std::remove_const_t<decltype(sphere)>, T, ByArea, BySolidAngle>);
    // By area is what one gets without asking.
    const lumis::AreaLight light{triangle, a};
    STATIC_REQUIRE(std::same_as<decltype(light), const lumis::AreaLight<lumis::Triangle<T>, ByArea>>);
    CHECK(light.area() == Approx(0.5));
    CHECK(lumis::AreaLight{parallelogram, a}.area() == Approx(std::sqrt(3.0)));
    CHECK(lumis::AreaLight{disk, a}.area() == Approx(4 * 3.14159265));
    CHECK(lumis::AreaLight{sphere, b}.area() == Approx(3.14159265));
}
