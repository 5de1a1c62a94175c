// Lights by solid angle as a whole: irradiance from random emitters by Lambert's formula, emitters that are none, and the
// same scene in other units and elsewhere.
#include "assertions.hpp"
#include "catch.hpp"
#include "polygons.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/stability.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

namespace {

namespace laws = lumis::testing;
using polygons::V;

template <class Shape>
auto light(const Shape& shape, const glm::vec<3, typename Shape::Scalar>& reference = {}) {
    return lumis::AreaLight<Shape, lumis::BySolidAngle>{shape, reference};
}

template <class T>
glm::vec<3, T> narrow(const glm::dvec3& v) {
    return glm::vec<3, T>(v);
}

}  // namespace

TEMPLATE_TEST_CASE("irradiance from random polygons by solid angle is Lambert's", "[area_light_by_solid_angle]", float,
                   double) {
    using T = TestType;
    polygons::Random random{1};
    int below = 0;
    for (int i = 0; i < 60; ++i) {
        // Every third dips below the horizon.
        const glm::dvec3 middle{2 * random(), 2 * random(), i % 3 == 0 ? 0.3 : 1.5};
        const glm::dvec3 u = random.vector(), v = random.vector();
        if (glm::length(glm::cross(u, v)) < 0.1) continue;
        if (std::abs(glm::dot(glm::normalize(glm::cross(u, v)), middle)) < 0.1) continue;
        const lumis::Triangle<T> triangle{narrow<T>(middle), narrow<T>(middle + u), narrow<T>(middle + v)};
        const lumis::Parallelogram<T> shape{narrow<T>(middle), narrow<T>(u), narrow<T>(v)};
        const V a{triangle.a}, b{triangle.b}, c{triangle.c}, corner{shape.corner}, eu{shape.edge_u}, ev{shape.edge_v};
        below += a.z < 0 || b.z < 0 || c.z < 0;
        const auto check = [&](const auto& strategy, const std::vector<V>& polygon) {
            const double answer = polygons::irradiance(polygon);
            INFO("triangle or parallelogram " << i << ", " << double{strategy.solid_angle()} << " sr");
            // The midpoint rule's own error, which the horizon's edge makes larger.
            CHECK(std::abs(polygons::estimated_irradiance(strategy, 256) - answer) <=
                  1e-4 * double{strategy.solid_angle()} + 1e-4 * answer);
        };
        check(light(triangle), {a, b, c});
        check(light(shape), {corner, corner + eu, corner + eu + ev, corner + ev});
    }
    CHECK(below >= 5);
}

TEMPLATE_TEST_CASE("flat lights by solid angle that subtend nothing", "[area_light_by_solid_angle]", float, double) {
    using T = TestType;
    using P = glm::vec<3, T>;
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    const P a{T(0), T(0), T(1)}, b{T(1), T(0), T(1)}, c{T(0), T(1), T(1)}, zero{T(0), T(0), T(0)};
    const auto nothing = [](const std::string& name, const P& p, const P& q, const P& r, const P& reference) {
        const CaughtAssertions caught;  // of NaN
        const auto triangle = light(lumis::Triangle<T>{p, q, r}, reference);
        const auto shape = light(lumis::Parallelogram<T>{p, q - p, r - p}, reference);
        for (const auto& law : {laws::draws_nothing(triangle), laws::draws_nothing(shape)}) {
            INFO(name << ": " << law.message);
            CHECK(law.passed);
        }
    };
    nothing("all vertices the same", a, a, a, zero);
    nothing("two vertices the same", a, b, b, zero);
    nothing("on a line", a, b, b + (b - a), zero);
    nothing("eye in the plane outside", a, b, c, {T(3), T(4), T(1)});
    nothing("eye in the plane inside", a, b, c, {T(0.25), T(0.25), T(1)});
    nothing("eye in line with an edge", a, b, c, {T(-3), T(0), T(1)});
    nothing("eye at a vertex", a, b, c, a);
    nothing("eye at another vertex", a, b, c, b);
    nothing("eye at the third vertex", a, b, c, c);
    nothing("eye on an edge", a, b, c, {T(0.5), T(0), T(1)});
    nothing("NaN vertex", a, b, {nan, T(0), T(1)}, zero);
    nothing("infinite vertex", a, b, {T(0), inf, T(1)}, zero);
    nothing("NaN eye", a, b, c, {nan, nan, nan});
    nothing("eye infinitely far away", a, b, c, {T(0), T(0), inf});
    // Parallelograms alone: on the diagonal, at the corner opposite, on the far edges.
    for (const P& eye : {P{T(0.5), T(0.5), T(1)}, P{T(1), T(1), T(1)}, P{T(1), T(0.5), T(1)}}) {
        CHECK(laws::draws_nothing(light(lumis::Parallelogram<T>{a, b - a, c - a}, eye)).passed);
    }
}

TEMPLATE_TEST_CASE("flat lights by solid angle stay finite at any scale", "[area_light_by_solid_angle]", float,
                   double) {
    using T = TestType;
    const int decades = std::numeric_limits<T>::max_exponent10;
    for (int exponent = -decades; exponent <= decades; exponent += std::is_same_v<T, float> ? 4 : 28) {
        const T scale = static_cast<T>(std::pow(10.0, exponent));
        for (const T height : {T(1e-20), T(1e-6), T(1), T(1e6), T(1e20)}) {
            for (const T thickness : {T(1), T(1e-7), T(1e-20)}) {
                for (const T skew : {T(0), T(0.5)}) {
                    const glm::vec<3, T> a{T(0), T(0), height * scale}, u{scale, T(0), T(0)},
                        v{skew * scale, thickness * scale, T(0)};
                    INFO("scale 1e" << exponent << ", height " << height << ", thickness " << thickness);
                    for (const T aside : {T(0), T(-0.25)}) {
                        const auto corner = a + aside * (u + v);
                        const auto triangle =
                            laws::stays_finite(light(lumis::Triangle<T>{corner, corner + u, corner + v}), 20);
                        INFO(triangle.message);
                        CHECK(triangle.passed);
                        const auto shape = laws::stays_finite(light(lumis::Parallelogram<T>{corner, u, v}), 20);
                        INFO(shape.message);
                        CHECK(shape.passed);
                    }
                }
            }
        }
    }
}

TEMPLATE_TEST_CASE("lights by solid angle in other units are the same lights", "[area_light_by_solid_angle]", float,
                   double) {
    using T = TestType;
    const double epsilon = std::numeric_limits<T>::epsilon();
    const auto same = [](const auto& one, const auto& other, double tolerance) {
        CHECK(std::abs(double{one.solid_angle()} / double{other.solid_angle()} - 1) <= tolerance);
        double worst = 0;
        auto uniforms = lumis::Uniforms<std::mt19937_64, T>{std::mt19937_64{1}};
        for (int i = 0; i < 200; ++i) {
            const auto u = uniforms.template next<2>();
            const auto p = one.sample(u), q = other.sample(u);
            if (!(p.pdf > 0 && q.pdf > 0)) worst = 1;
            worst = std::fmax(worst, glm::length(glm::dvec3{p.value} - glm::dvec3{q.value}));
        }
        CHECK(worst <= 10 * tolerance);
    };
    const auto triangle_at = [](double scale, const glm::dvec3& o) {
        const lumis::Triangle<T> shape{narrow<T>(o + scale * glm::dvec3{0.5, 0, 1}),
                                       narrow<T>(o + scale * glm::dvec3{1, 0.25, 1.5}),
                                       narrow<T>(o + scale * glm::dvec3{0, 1, 1})};
        return light(shape, narrow<T>(o));
    };
    const auto shape_at = [](double scale, double skew, const glm::dvec3& o) {
        const lumis::Parallelogram<T> shape{narrow<T>(o + scale * glm::dvec3{-1, 0.5, 1}),
                                            narrow<T>(scale * glm::dvec3{2, 0, 0}),
                                            narrow<T>(scale * glm::dvec3{skew, 1, 0})};
        return light(shape, narrow<T>(o));
    };
    const glm::dvec3 here{0};
    for (int exponent = -12; exponent <= 12; ++exponent) {
        INFO("scale 1e" << exponent);
        const double scale = std::pow(10.0, exponent);
        same(triangle_at(scale, here), triangle_at(1, here), 50 * epsilon);
        same(shape_at(scale, 0, here), shape_at(1, 0, here), 50 * epsilon);
        same(shape_at(scale, 0.5, here), shape_at(1, 0.5, here), 50 * epsilon);
    }
    // Elsewhere, coordinates are multiples of 1/4 and stay exact; in double anything is.
    for (const auto& there : {glm::dvec3{1e6, -1e6, 1e6}, {-4096, 0.25, 65536}}) {
        INFO("at " << there.x);
        same(triangle_at(4, there), triangle_at(4, here), 50 * epsilon);
        same(shape_at(4, 0, there), shape_at(4, 0, here), 50 * epsilon);
        same(shape_at(4, 1, there), shape_at(4, 1, here), 50 * epsilon);
        if (std::is_same_v<T, double>) {
            same(triangle_at(1e-3, there), triangle_at(1e-3, here), 1e-6);
            same(shape_at(0.3, 0.1, there), shape_at(0.3, 0.1, here), 1e-9);
        }
    }
}
