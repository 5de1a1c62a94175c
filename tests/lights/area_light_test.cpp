// Area lights: lights that are none, the sphere's cone from tiny to a hemisphere, and the conversion of measure.
#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/stability.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <type_traits>

namespace {

namespace laws = lumis::testing;

template <class T>
using Point = glm::vec<3, T>;

template <class T, class Sampling = lumis::ByArea, class Shape>
auto light(const Shape& shape, const Point<T>& reference = Point<T>{T(0), T(0), T(0)}) {
    return lumis::AreaLight<Shape, Sampling>{shape, reference};
}

template <class Law>
void check(const std::string& label, const Law& law) {
    INFO(label << ": " << law.message);
    CHECK(law.passed);
}

// Calls visit(sphere by area), visit(sphere by solid angle).
template <class T, class Visit>
void for_both(const Point<T>& center, T radius, Visit visit) {
    const lumis::Sphere<T> sphere{center, radius};
    visit(light<T>(sphere));
    visit(light<T, lumis::BySolidAngle>(sphere));
}

// Half-angles from 0.01 degree to 89.99, in radians.
template <class Visit>
void for_each_half_angle(Visit visit) {
    for (const double degrees : {0.01, 0.02, 0.05, 0.1, 0.5, 1.0, 5.0, 20.0, 45.0, 60.0, 80.0, 89.0, 89.9, 89.99}) {
        visit(degrees * std::numbers::pi / 180);
    }
}

// The solid angle of a sphere as its numbers say, in long double.
template <class T>
long double solid_angle(const lumis::Sphere<T>& sphere) {
    const auto& c = sphere.center;
    const long double d2 =
        static_cast<long double>(c.x) * c.x + static_cast<long double>(c.y) * c.y + static_cast<long double>(c.z) * c.z;
    const long double sine2 = static_cast<long double>(sphere.radius) * sphere.radius / d2;
    return 2 * std::numbers::pi_v<long double> * sine2 / (1 + std::sqrt(1 - std::min(sine2, 1.0L)));
}

}  // namespace

TEMPLATE_TEST_CASE("flat lights without area or seen edge-on draw nothing", "[area_light]", float, double) {
    using T = TestType;
    using P = Point<T>;
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    const P a{T(0), T(0), T(1)}, b{T(1), T(0), T(1)}, c{T(0), T(1), T(1)}, zero{T(0), T(0), T(0)};
    const auto nothing = [](const std::string& name, const P& p, const P& q, const P& r, const P& reference) {
        const CaughtAssertions caught;  // of NaN
        check("triangle, " + name, laws::draws_nothing(light(lumis::Triangle<T>{p, q, r}, reference)));
        check("parallelogram, " + name,
              laws::draws_nothing(light(lumis::Parallelogram<T>{p, q - p, r - p}, reference)));
    };
    nothing("all vertices the same", a, a, a, zero);
    nothing("two vertices the same", a, b, b, zero);
    nothing("on a line", a, b, b + (b - a), zero);
    nothing("receiver in the plane, outside", a, b, c, {T(3), T(4), T(1)});
    nothing("receiver in the plane, inside", a, b, c, {T(0.25), T(0.25), T(1)});
    nothing("receiver at a vertex", a, b, c, a);
    nothing("receiver on an edge", a, b, c, {T(0.5), T(0), T(1)});
    nothing("NaN vertex", a, b, {nan, T(0), T(1)}, zero);
    nothing("infinite vertex", a, b, {T(0), inf, T(1)}, zero);
    nothing("NaN receiver", a, b, c, {nan, nan, nan});
    nothing("infinitely far receiver", a, b, c, {T(0), T(0), inf});
}

TEMPLATE_TEST_CASE("flat lights stay finite at any scale", "[area_light]", float, double) {
    using T = TestType;
    const int decades = std::numeric_limits<T>::max_exponent10;
    for (int exponent = -decades; exponent <= decades; exponent += 2) {
        const T scale = static_cast<T>(std::pow(10.0, exponent));
        for (const T height : {T(1e-20), T(1e-6), T(1), T(1e6), T(1e20)}) {
            for (const T thickness : {T(1), T(1e-7), T(1e-20)}) {
                const Point<T> a{T(0), T(0), height * scale}, u{scale, T(0), T(0)},
                    v{T(0.5) * scale, thickness * scale, T(0)};
                const std::string label = "scale 1e" + std::to_string(exponent) + ", height " +
                                          laws::detail::text(height) + ", thickness " + laws::detail::text(thickness);
                check("triangle, " + label, laws::stays_finite(light<T>(lumis::Triangle<T>{a, a + u, a + v}), 20));
                check("parallelogram, " + label, laws::stays_finite(light<T>(lumis::Parallelogram<T>{a, u, v}), 20));
            }
        }
    }
}

TEMPLATE_TEST_CASE("spheres that are none draw nothing", "[area_light]", float, double) {
    using T = TestType;
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    const Point<T> center{T(0), T(0), T(2)}, zero{T(0), T(0), T(0)};
    const auto nothing = [](const Point<T>& c, T radius) {
        const CaughtAssertions caught;  // of NaN
        for_both(c, radius,
                 [&](const auto& s) { check(laws::detail::text("radius ", radius), laws::draws_nothing(s)); });
    };
    for (const T radius : {T(0), T(-1), nan, inf}) nothing(center, radius);
    nothing(zero, T(0));
    nothing({nan, nan, nan}, T(1));
    nothing({inf, T(0), T(0)}, T(1));
}

TEMPLATE_TEST_CASE("spheres stay finite from far away to deep inside", "[area_light]", float, double) {
    using T = TestType;
    const T just_outside = 1 + std::numeric_limits<T>::epsilon(), just_inside = 1 - std::numeric_limits<T>::epsilon();
    const Point<T> axis{T(0.48), T(0.64), T(0.6)};
    for (const T distance :
         {T(0), T(1e-30), T(1e-6), T(0.5), just_inside, T(1), just_outside, T(2), T(1e6), T(1e18), T(1e30)}) {
        for (const T radius : {T(1e-18), T(1e-6), T(1), T(1e6), T(1e18)}) {
            const std::string label = laws::detail::text("distance ", distance, " radii of ", radius);
            for_both<T>(distance * radius * axis, radius,
                        [&](const auto& s) { check(label, laws::stays_finite(s, 200)); });
        }
    }
}

TEMPLATE_TEST_CASE("inside a sphere every direction meets it", "[area_light]", float, double) {
    using T = TestType;
    for (const T distance : {T(0), T(0.3), T(0.99)}) {
        for_both<T>({distance, T(0), T(0)}, T(1), [](const auto& s) {
            for (const auto& w :
                 {Point<T>{T(0), T(0), T(1)}, Point<T>{T(-1), T(0), T(0)}, Point<T>{T(0.6), T(0.8), T(0)}}) {
                CHECK(s.pdf(w) > 0);
            }
        });
        const auto s = light<T, lumis::BySolidAngle>(lumis::Sphere<T>{{distance, T(0), T(0)}, T(1)});
        CHECK(s.pdf({T(0), T(1), T(0)}) == Approx(0.25 / std::numbers::pi));
    }
}

TEMPLATE_TEST_CASE("a sphere's density times its solid angle is 1", "[area_light]", float, double) {
    using T = TestType;
    const double tolerance = std::is_same_v<T, float> ? 1e-5 : 1e-12;
    const auto check_sphere = [&](const lumis::Sphere<T>& sphere) {
        if (glm::length(glm::dvec3{sphere.center}) == double{sphere.radius})
            return;  // 89.99 degrees in float: touching
        const auto s = light<T, lumis::BySolidAngle>(sphere);
        const long double product = solid_angle(sphere) * s.sample({T(0.5), T(0.5)}).pdf;
        INFO("center " << sphere.center.x << ", " << sphere.center.y << ", " << sphere.center.z << ", radius "
                       << sphere.radius);
        CHECK(static_cast<double>(std::abs(product - 1)) <= tolerance);
    };
    for_each_half_angle([&](double half_angle) {
        for (const double distance : {1e-3, 1.0, 1e3}) {
            check_sphere({{T(0), T(0), static_cast<T>(distance)}, static_cast<T>(distance * std::sin(half_angle))});
        }
        check_sphere({{T(3), T(-4), T(12)}, static_cast<T>(13 * std::sin(half_angle))});
    });
    for (double radii = 1; radii <= 1e6; radii *= 10) check_sphere({{T(0), static_cast<T>(2 * radii), T(0)}, T(1)});
    check_sphere({{T(3e6), T(-4e6), T(12e6)}, T(1)});
}

TEMPLATE_TEST_CASE("what is drawn of a sphere lies on it, at the distance told", "[area_light]", float, double) {
    using T = TestType;
    const double epsilon = std::numeric_limits<T>::epsilon();
    for_each_half_angle([&](double half_angle) {
        const Point<T> center{T(3), T(-4), T(12)};
        const T radius = static_cast<T>(13 * std::sin(half_angle));
        for_both(center, radius, [&](const auto& s) {
            lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{1}};
            double worst = 0;
            for (int i = 0; i < 1000; ++i) {
                const auto sample = s.sample(uniforms.template next<2>());
                if (!(sample.pdf > 0)) continue;
                const glm::dvec3 hit = double{sample.distance} * glm::dvec3{sample.value};
                worst = std::fmax(worst, std::abs(glm::length(hit - glm::dvec3{center}) - double{radius}));
            }
            INFO("half-angle " << half_angle);
            CHECK(worst <= 13 * 8 * epsilon);
        });
    });
}

TEMPLATE_TEST_CASE("outside the cone a sphere has no density", "[area_light]", float, double) {
    using T = TestType;
    for_each_half_angle([](double half_angle) {
        const T radius = static_cast<T>(std::sin(half_angle));
        if (radius == 1) return;  // in float 89.99 degrees are 90, and the receiver lies on the sphere
        for_both<T>({T(0), T(0), T(1)}, radius, [&](const auto& s) {
            const double inside = half_angle * 0.99, outside = half_angle * 1.02;
            INFO("half-angle " << half_angle);
            CHECK(s.pdf({static_cast<T>(std::sin(inside)), T(0), static_cast<T>(std::cos(inside))}) > 0);
            CHECK(s.pdf({static_cast<T>(std::sin(outside)), T(0), static_cast<T>(std::cos(outside))}) == 0);
            CHECK(s.pdf({T(0), T(0), T(-1)}) == 0);
        });
    });
}

// Strata of u are patches of the shape: u.x runs along edge_u, u.y along edge_v; in a triangle away from a, and from b
// to c.
TEMPLATE_TEST_CASE("where on a flat light a uniform falls", "[area_light]", float, double) {
    using T = TestType;
    const glm::dvec3 corner{0.2, -0.3, 0.8}, u{1.5, 0.2, 0.3}, v{-0.4, 0.7, 0.1};
    const auto expect = [](const auto& sample, const glm::dvec3& point) {
        CHECK(sample.distance == Approx(glm::length(point)));
        CHECK(glm::length(glm::dvec3{sample.value} - glm::normalize(point)) <= 1e-6);
    };
    const auto parallelogram = light<T>(lumis::Parallelogram<T>{Point<T>(corner), Point<T>(u), Point<T>(v)});
    expect(parallelogram.sample({T(0.25), T(0.75)}), corner + 0.25 * u + 0.75 * v);
    const auto triangle = light<T>(lumis::Triangle<T>{Point<T>(corner), Point<T>(corner + u), Point<T>(corner + v)});
    expect(triangle.sample({T(0), T(0.3)}), corner);
    expect(triangle.sample({T(0.25), T(0)}), corner + 0.5 * u);
    expect(triangle.sample({T(0.25), T(0.75)}), corner + 0.125 * u + 0.375 * v);
}

TEMPLATE_TEST_CASE("a small square seen from straight below", "[area_light]", float, double) {
    using T = TestType;
    // Straight below a small square: solid angle area cos / distance^2.
    const T side = T(1e-3);
    const auto s =
        light<T>(lumis::Parallelogram<T>{{-side / 2, -side / 2, T(2)}, {side, T(0), T(0)}, {T(0), side, T(0)}});
    CHECK(s.pdf({T(0), T(0), T(1)}) == Approx(4e6));
    CHECK(s.pdf_from_hit(T(2), T(1)) == Approx(4e6));
    CHECK(s.pdf_from_hit(T(2), T(-0.5)) == Approx(8e6));
    CHECK(s.pdf_from_hit(T(2), T(0)) == 0);
    CHECK(s.pdf_from_hit(T(0), T(1)) == 0);
    const auto sample = s.sample({T(0.5), T(0.5)});
    CHECK(sample.distance == Approx(2));
    CHECK(sample.pdf == Approx(4e6));
    CHECK(s.pdf({T(0), T(0), T(-1)}) == 0);
}

TEMPLATE_TEST_CASE("disks that are none draw nothing", "[area_light]", float, double) {
    using T = TestType;
    using P = Point<T>;
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    const P center{T(0), T(0), T(2)}, up{T(0), T(0), T(1)}, zero{T(0), T(0), T(0)};
    const auto nothing = [](const std::string& name, const P& c, const P& normal, T radius, const P& reference) {
        const CaughtAssertions caught;  // of NaN
        check(name, laws::draws_nothing(light(lumis::Disk<T>{c, normal, radius}, reference)));
    };
    for (const T radius : {T(0), T(-1), nan, inf})
        nothing(laws::detail::text("radius ", radius), center, up, radius, zero);
    for (const P& normal : {zero, P{nan, T(0), T(1)}, P{T(0), inf, T(0)}}) {
        nothing(laws::detail::text("normal ", normal), center, normal, T(1), zero);
    }
    nothing("edge-on", center, {T(1), T(0), T(0)}, T(1), zero);
    nothing("receiver at its centre", center, up, T(1), center);
    nothing("receiver on it", center, up, T(1), center + P{T(0.5), T(0.25), T(0)});
    nothing("receiver beside it", center, up, T(1), center + P{T(5), T(0), T(0)});
    nothing("NaN centre", {nan, T(0), T(1)}, up, T(1), zero);
    nothing("NaN receiver", center, up, T(1), {nan, nan, nan});
    nothing("infinitely far receiver", center, up, T(1), {inf, T(0), T(0)});
}

TEMPLATE_TEST_CASE("disks whatever the length of their normal and their scale", "[area_light]", float, double) {
    using T = TestType;
    const Point<T> center{T(0.5), T(-1), T(2)}, normal{T(0.48), T(0.64), T(-0.6)};
    const auto unit = light<T>(lumis::Disk<T>{center, normal, T(0.75)});
    CHECK(unit.area() == Approx(std::numbers::pi * 0.75 * 0.75));
    for (const T length : {T(1e-12), T(1e-3), T(-1), T(7), T(1e12)}) {
        const auto other = light<T>(lumis::Disk<T>{center, length * normal, T(0.75)});
        lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{1}};
        for (int i = 0; i < 100; ++i) {
            const auto w = unit.sample(uniforms.template next<2>()).value;
            CHECK(other.pdf(w) == Approx(unit.pdf(w)).epsilon(1e-5));
        }
    }
    for (double scale = 1e-12; scale <= 1e12; scale *= 100) {
        const T s = static_cast<T>(scale);
        const auto scaled = light<T>(lumis::Disk<T>{s * center, normal, s * T(0.75)});
        const glm::vec<2, T> u{T(0.3), T(0.6)};
        INFO("scale " << scale);
        CHECK(scaled.sample(u).pdf == Approx(unit.sample(u).pdf).epsilon(1e-5));
        CHECK(scaled.sample(u).distance / s == Approx(unit.sample(u).distance).epsilon(1e-5));
        check("finite", laws::stays_finite(scaled, 100));
    }
}

// u.x is the share of the area within a radius, u.y a fraction of a turn about the centre.
TEMPLATE_TEST_CASE("where on a disk a uniform falls", "[area_light]", float, double) {
    using T = TestType;
    const glm::dvec3 center{0.5, -1, 2}, normal = glm::normalize(glm::dvec3{0.3, 0.2, -1});
    const auto disk = light<T>(lumis::Disk<T>{Point<T>(center), Point<T>(normal), T(0.75)});
    const auto place = [&](double x, double y) {
        const auto sample = disk.sample({static_cast<T>(x), static_cast<T>(y)});
        CHECK(sample.pdf > 0);
        CHECK(disk.pdf(sample.value) > 0);
        const auto back = disk.invert(sample.value);
        CHECK(std::abs(double{back.x} - x) <= 1e-5);
        return glm::dvec3{sample.value} * double{sample.distance} - center;
    };
    for (const double x : {0.0, 0.1, 0.25, 0.81, 1.0}) {
        for (const double y : {0.0, 0.2, 0.7, 1.0}) {
            const glm::dvec3 p = place(x, y);
            CHECK(std::abs(glm::length(p) - 0.75 * std::sqrt(x)) <= 1e-6);
            CHECK(std::abs(glm::dot(p, normal)) <= 1e-6);
            // A quarter turn on.
            if (y < 0.75) CHECK(std::abs(glm::dot(p, place(x, y + 0.25))) <= 1e-6);
        }
    }
}
