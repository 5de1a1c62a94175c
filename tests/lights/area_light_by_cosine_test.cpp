// Lights by solid angle and cosine as a whole: irradiance by Lambert's formula with next to no variance, horizons that cut
// them, and lights of which nothing is drawn.
#include "assertions.hpp"
#include "catch.hpp"
#include "irradiance.hpp"
#include "polygons.hpp"
#include <lumis/lights/area_light_by_cosine.hpp>
#include <lumis/lumis.hpp>
#include <lumis/testing/stability.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace {

namespace laws = lumis::testing;
using polygons::V;

template <class Shape>
auto light(const Shape& shape, const lumis::Direction<typename Shape::Scalar>& normal,
           const glm::vec<3, typename Shape::Scalar>& reference = {}, lumis::Sides sides = lumis::Sides::Both) {
    return lumis::AreaLight<Shape, lumis::ByCosine>{shape, reference, normal, sides};
}

template <class T>
constexpr lumis::Direction<T> up{T(0), T(0), T(1)};

// Irradiance, normal +z, by n x n midpoints of the uniforms: mean, and variance over the squared mean.
struct Estimated {
    double mean, relative_variance;
};
template <class Light>
Estimated estimated(const Light& light, int n) {
    using T = typename Light::Scalar;
    double sum = 0, squares = 0;
    for (int i = 0; i < n * n; ++i) {
        const T x = (static_cast<T>(i % n) + T(0.5)) / static_cast<T>(n);
        const T y = (static_cast<T>(i / n) + T(0.5)) / static_cast<T>(n);
        const auto drawn = light.sample({x, y});
        const double f = drawn.pdf > 0 ? std::max(double{drawn.value.z}, 0.0) / double{drawn.pdf} : 0;
        sum += f;
        squares += f * f;
    }
    const double mean = sum / n / n;
    return {mean, squares / n / n / (mean * mean) - 1};
}

template <class T>
glm::vec<3, T> at(double x, double y, double z) {
    return glm::vec<3, T>(glm::dvec3{x, y, z});
}

}  // namespace

TEMPLATE_TEST_CASE("irradiance from random polygons by cosine is Lambert's, and hardly varies",
                   "[area_light_by_cosine]", float, double) {
    using T = TestType;
    polygons::Random random{1};
    int cut = 0;
    for (int i = 0; i < 150; ++i) {
        // Every third around the horizon, every fourth close by.
        const double size = i % 4 == 0 ? 5 : 1;
        const glm::dvec3 corner = glm::dvec3{random(), random(), i % 3 == 0 ? 0.1 : 0.8} + 0.3 * random.vector();
        const glm::dvec3 u = size * random.vector(), v = size * random.vector();
        const glm::dvec3 across = glm::cross(u, v);
        if (!(glm::length(across) > 0.1 && std::abs(glm::dot(glm::normalize(across), corner)) > 0.05)) continue;
        const lumis::Triangle<T> triangle{glm::vec<3, T>(corner), glm::vec<3, T>(corner + u),
                                          glm::vec<3, T>(corner + v)};
        const lumis::Parallelogram<T> shape{glm::vec<3, T>(corner), glm::vec<3, T>(u), glm::vec<3, T>(v)};
        const V a{triangle.a}, b{triangle.b}, c{triangle.c}, p{shape.corner}, pu{shape.edge_u}, pv{shape.edge_v};
        const auto check = [&](const char* name, const auto& strategy, const std::vector<V>& polygon) {
            cut += std::ranges::any_of(polygon, [](const V& x) { return x.z < 0; });
            const double answer = polygons::irradiance(polygon);
            if (!(answer > 1e-3)) return;
            INFO(name << ' ' << i << ", irradiance " << answer);
            const auto [mean, relative_variance] = estimated(strategy, 64);
            CHECK(std::abs(mean / answer - 1) <= 1e-3);
            CHECK(relative_variance <= 0.03);
        };
        check("triangle", light(triangle, up<T>), {a, b, c});
        check("parallelogram", light(shape, up<T>), {p, p + pu, p + pu + pv, p + pv});
    }
    CHECK(cut >= 40);
}

// The squares of the kind that are met: walls that stand on the floor, near and far, a strip, and what the horizon cuts.
TEMPLATE_TEST_CASE("irradiance from walls, strips and ceilings hardly varies", "[area_light_by_cosine]", float,
                   double) {
    using T = TestType;
    const auto check = [](const char* name, const V& corner, const V& u, const V& v, double most) {
        const lumis::Parallelogram<T> shape{glm::vec<3, T>(corner), glm::vec<3, T>(u), glm::vec<3, T>(v)};
        const double answer = polygons::irradiance({corner, corner + u, corner + u + v, corner + v});
        const auto [mean, relative_variance] = estimated(light(shape, up<T>), 128);
        INFO(name << ": " << relative_variance);
        CHECK(std::abs(mean / answer - 1) <= 4e-4);  // the midpoint rule's own
        CHECK(relative_variance <= most);
    };
    check("wall", {1, -1, 0}, {0, 2, 0}, {0, 0, 2}, 0.001);
    check("wall close by", {0.1L, -1, 0}, {0, 2, 0}, {0, 0, 2}, 0.0005);
    check("strip", {2, -1, 0.5}, {4, 0, 0}, {0, 2, 0}, 0.0017);
    check("wall across the horizon", {1, -1, -1}, {0, 2, 0}, {0, 0, 2}, 0.004);
    check("wall, its first edge upright", {1, -1, 0}, {0, 0, 2}, {0, 2, 0}, 0.001);
    check("leaning wall across the horizon", {1, -1, -1}, {0, 2, 0.3}, {0.3, 0, 2}, 0.015);
    check("ceiling", {-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, 0.0025);
    check("ceiling close by", {-1, -1, 0.2L}, {2, 0, 0}, {0, 2, 0}, 0.0025);
    check("above an edge close by", {-0.9L, 0.1L, 0.01L}, {1.9L, 0, 0}, {0, 1.9L, 0}, 0.01);
}

TEMPLATE_TEST_CASE("nothing below the horizon is drawn, and all above it can be", "[area_light_by_cosine]", float,
                   double) {
    using T = TestType;
    // Heights of the horizon on a wall of height 2, to 1e-6 of either end.
    for (const double below : {1e-6, 1e-3, 0.5, 1.0, 1.5, 1.999, 1.999999}) {
        for (const double lean : {0.0, 0.3}) {
            INFO(below << " below, leaning by " << lean);
            const lumis::Parallelogram<T> wall{at<T>(1, -1, -below), at<T>(0, 2, lean), at<T>(lean, 0, 2)};
            const lumis::Triangle<T> part{wall.corner, wall.corner + wall.edge_u, wall.corner + wall.edge_v};
            const auto check = [&](const auto& strategy, const std::vector<V>& polygon) {
                double lowest = 1;
                for (int i = 0; i < 400; ++i) {
                    const auto drawn = strategy.sample({T(i % 20) / 19, T(i / 20) / 19});
                    if (!(drawn.pdf > 0)) continue;
                    lowest = std::fmin(lowest, double{drawn.value.z});
                    auto under = drawn.value;
                    under.z = -under.z;
                    if (strategy.pdf(drawn.value) == 0 || strategy.pdf(under) != 0) lowest = -1;
                }
                CHECK(lowest > 0);
                const double answer = polygons::irradiance(polygon);
                const double mean = estimated(strategy, 64).mean;
                // A float direction has no digits left of what is 1e-6 high.
                CHECK(std::abs(mean - answer) <= 2e-3 * answer + 1e-13);
            };
            const V p{wall.corner}, u{wall.edge_u}, v{wall.edge_v};
            check(light(wall, up<T>), {p, p + u, p + u + v, p + v});
            check(light(part, up<T>), {V{part.a}, V{part.b}, V{part.c}});
        }
    }
}

TEMPLATE_TEST_CASE("lights by cosine that are not seen", "[area_light_by_cosine]", float, double) {
    using T = TestType;
    using P = glm::vec<3, T>;
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    const P a{T(0), T(0), T(1)}, b{T(1), T(0), T(1)}, c{T(0), T(1), T(1)}, zero{T(0), T(0), T(0)};
    const auto nothing = [](const char* name, const P& p, const P& q, const P& r, const P& reference, const P& normal,
                            lumis::Sides sides = lumis::Sides::Both) {
        const CaughtAssertions caught;  // of NaN
        const auto triangle = light(lumis::Triangle<T>{p, q, r}, normal, reference, sides);
        const auto shape = light(lumis::Parallelogram<T>{p, q - p, r - p}, normal, reference, sides);
        for (const auto& law : {laws::draws_nothing(triangle), laws::draws_nothing(shape)}) {
            INFO(name << ": " << law.message);
            CHECK(law.passed);
        }
    };
    nothing("the normal faces away", a, b, c, zero, -up<T>);
    nothing("an edge on the horizon, the rest below", a, b, c, zero, {T(0), T(-1), T(0)});
    nothing("the normal is NaN", a, b, c, zero, {nan, T(0), T(1)});
    nothing("the normal is none", a, b, c, zero, zero);
    nothing("the normal is infinite", a, b, c, zero, {T(0), inf, T(0)});
    nothing("of one side, from behind", a, b, c, zero, up<T>, lumis::Sides::One);
    nothing("eye in the plane", a, b, c, {T(3), T(4), T(1)}, up<T>);
    nothing("eye at a vertex", a, b, c, a, up<T>);
    nothing("eye on an edge", a, b, c, {T(0.5), T(0), T(1)}, up<T>);
    nothing("all vertices the same", a, a, a, zero, up<T>);
    nothing("on a line", a, b, b + (b - a), zero, up<T>);
    nothing("NaN vertex", a, b, {nan, T(0), T(1)}, zero, up<T>);
    nothing("infinite vertex", a, b, {T(0), inf, T(1)}, zero, up<T>);
}

// Next to the horizon's plane the signs of heights are those of their rounding.
TEMPLATE_TEST_CASE("lights by cosine that lie on the horizon", "[area_light_by_cosine]", float, double) {
    using T = TestType;
    polygons::Random random{5};
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 normal = random.direction();
        const lumis::Frame<double> frame{normal};
        const auto level = [&] { return frame.to_world(glm::dvec3{random(), random(), 1e-16 * random()}); };
        const lumis::Parallelogram<T> shape{glm::vec<3, T>(level()), glm::vec<3, T>(level()), glm::vec<3, T>(level())};
        const lumis::Triangle<T> triangle{shape.corner, shape.corner + shape.edge_u, shape.corner + shape.edge_v};
        const lumis::Direction<T> unit(normal);
        const auto check = [&](const auto& strategy) {
            const auto law = laws::stays_finite(strategy, 1);
            INFO(i << ": " << law.message);
            CHECK(law.passed);
        };
        check(light(shape, unit));
        check(light(triangle, unit));
    }
}

TEMPLATE_TEST_CASE("lights by cosine stay finite at any scale", "[area_light_by_cosine]", float, double) {
    using T = TestType;
    const int decades = std::numeric_limits<T>::max_exponent10;
    const lumis::Direction<T> normals[] = {up<T>, at<T>(0.6, 0, 0.8), at<T>(0, -1, 0), at<T>(0.8, 0.6, 0)};
    for (int exponent = -decades; exponent <= decades; exponent += decades / 9) {
        const T scale = static_cast<T>(std::pow(10.0, exponent));
        for (const T height : {T(1e-20), T(1e-6), T(1), T(1e6), T(1e20)}) {
            for (const T thickness : {T(1), T(1e-7), T(1e-20)}) {
                for (const T aside : {T(0), T(-0.25)}) {
                    INFO("scale 1e" << exponent << ", height " << height << ", thickness " << thickness);
                    const glm::vec<3, T> u{scale, T(0), T(0)}, v{T(0.5) * scale, thickness * scale, T(0)};
                    const glm::vec<3, T> corner = glm::vec<3, T>{T(0), T(0), height * scale} + aside * (u + v);
                    for (const auto& normal : normals) {
                        const auto triangle =
                            laws::stays_finite(light(lumis::Triangle<T>{corner, corner + u, corner + v}, normal), 5);
                        const auto shape = laws::stays_finite(light(lumis::Parallelogram<T>{corner, u, v}, normal), 5);
                        INFO(triangle.message << shape.message);
                        CHECK(triangle.passed);
                        CHECK(shape.passed);
                    }
                }
            }
        }
    }
}

// A corner that touches the horizon is one vertex of what is seen: two make a triangle of rounding alone beside a huge light.
TEMPLATE_TEST_CASE("huge lights that touch the horizon with a corner are drawn", "[area_light_by_cosine]", float,
                   double) {
    using T = TestType;
    for (const double size : {1.0, 1e5, 1e9}) {
        const glm::vec<3, T> corner = at<T>(0.6, -0.8, 0);
        const glm::vec<3, T> u = at<T>(0.3 * size, -0.9 * size, 0.2 * size),
                             v = at<T>(0.7 * size, 0.5 * size, 0.4 * size);
        INFO("size " << size);
        const auto all = [](const auto& shape) {
            int drawn = 0;
            for (int i = 0; i < 400; ++i) {
                const T x = (static_cast<T>(i % 20) + T(0.5)) / 20, y = (static_cast<T>(i / 20) + T(0.5)) / 20;
                drawn += shape.sample({x, y}).pdf > 0 ? 1 : 0;
            }
            return drawn == 400;
        };
        CHECK(all(light(lumis::Triangle<T>{corner, corner + u, corner + v}, up<T>)));
        CHECK(all(light(lumis::Parallelogram<T>{corner, u, v}, up<T>)));
    }
}

// Beside a light in its own plane, a floor's, rounding alone says which of its corners are above the horizon.
TEMPLATE_TEST_CASE("lights in the receiver's plane have no more vertices than fit", "[area_light_by_cosine]", float,
                   double) {
    using T = TestType;
    using Polygon = lumis::detail::HorizonPolygon<lumis::Parallelogram<T>>;
    using W = lumis::detail::Wide<T>;
    int most = 0;
    for (int i = 0; i < 2000; ++i) {
        const double a = 0.37 * i;
        const lumis::Frame<T> floor{glm::normalize(at<T>(std::cos(a), std::sin(1.3 * a), 0.5 + std::cos(0.7 * a)))};
        const auto in_plane = [&](double angle, double length) {
            return floor.to_world(at<T>(length * std::cos(angle), length * std::sin(angle), 0));
        };
        const lumis::Parallelogram<T> shape{in_plane(2 * a, 3), in_plane(3 * a, 1), in_plane(5 * a, 2)};
        const lumis::detail::FlatShape<lumis::Parallelogram<T>> flat{shape, glm::vec<3, T>{T(0)}};
        most = std::max(most, Polygon{flat, glm::vec<3, W>{floor.normal()}}.size());
    }
    CHECK(most <= Polygon::most_vertices);
}

// Rounding makes directions to the far corners of huge lights parallel to them: a ray along one meets nothing.
TEMPLATE_TEST_CASE("what is drawn of huge flat lights is somewhere", "[area_light_by_cosine]", float, double) {
    using T = TestType;
    const T size = 4 / std::numeric_limits<T>::epsilon();
    const auto is_somewhere = [](const auto& light) {
        for (const T x : {T(0), T(0.5), T(1)}) {
            for (const T y : {T(0), T(0.5), T(1)}) {
                const auto drawn = light.sample({x, y});
                if (drawn.pdf > 0 && !(drawn.distance > 0)) return false;
            }
        }
        return true;
    };
    for (int i = 0; i < 100; ++i) {
        const double angle = 0.02 * i;
        const glm::vec<3, T> u = at<T>(std::cos(angle), 0.3, std::sin(angle)), v = at<T>(0.2, 1, -0.1);
        const glm::vec<3, T> normal = glm::normalize(glm::cross(u, v));
        const glm::vec<3, T> corner = at<T>(0.3, 0.2, 0) + normal * T(0.02);
        const lumis::Triangle<T> triangle{corner, corner + size * u, corner + size * v};
        const lumis::Parallelogram<T> shape{corner, size * u, size * v};
        INFO("angle " << angle);
        CHECK(is_somewhere(light(triangle, normal)));
        CHECK(is_somewhere(light(shape, normal)));
        CHECK(is_somewhere(lumis::AreaLight<lumis::Triangle<T>, lumis::BySolidAngle>{triangle, {}}));
        CHECK(is_somewhere(lumis::AreaLight<lumis::Parallelogram<T>, lumis::BySolidAngle>{shape, {}}));
    }
}

TEMPLATE_TEST_CASE("lights by cosine beside other techniques", "[area_light_by_cosine]", float, double) {
    using T = TestType;
    const lumis::Parallelogram<T> wall{at<T>(1, -1, -0.5), at<T>(0, 2, 0.2), at<T>(0.1, 0, 2)};
    const V p{wall.corner}, u{wall.edge_u}, v{wall.edge_v};
    const double answer = polygons::irradiance({p, p + u, p + u + v, p + v});
    const auto by_cosine = light(wall, up<T>);
    const auto cosine_of_light = [&](const lumis::Direction<T>& w) {
        return w.z > 0 && by_cosine.distance_along(w) < std::numeric_limits<T>::infinity() ? w.z : T(0);
    };
    const auto direct = lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, lumis::CosineHemisphere<T>{}),
                                            lumis::take(1, by_cosine));
    irradiance::check_unbiased<T>(
        "beside the BSDF", [&](auto& uniforms) { return direct.estimate(cosine_of_light, uniforms); }, answer);

    const lumis::Parallelogram<T> other{at<T>(-2, -1, 1), at<T>(0, 2, 0), at<T>(0, 0, 1)};
    const V q{other.corner}, s{other.edge_u}, t{other.edge_v};
    const lumis::LightSet set{std::vector{by_cosine, light(other, up<T>)}, std::vector<T>{T(1), T(2)}};
    const auto both = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, set));
    irradiance::check_unbiased<T>(
        "in a set",
        [&](auto& uniforms) {
            return both.estimate([](const lumis::Direction<T>& w) { return std::max(w.z, T(0)); }, uniforms);
        },
        answer + polygons::irradiance({q, q + s, q + s + t, q + t}));
}

TEMPLATE_TEST_CASE("lights by cosine tell their surface and their hits' density", "[area_light_by_cosine]", float,
                   double) {
    using T = TestType;
    const double tolerance = 64 * double{std::numeric_limits<T>::epsilon()};
    const glm::vec<3, T> from = at<T>(0.3, -0.2, 0.1);
    const lumis::Parallelogram<T> wall{at<T>(1, -1, -0.5), at<T>(0, 2, 0.2), at<T>(0.1, 0, 2)};
    const lumis::SurfaceLight<lumis::Parallelogram<T>, lumis::ByCosine> surface{wall, from, up<T>};
    const auto plain = light(wall, up<T>, from);
    for (int i = 0; i < 100; ++i) {
        const glm::vec<2, T> u{(T(i % 10) + T(0.5)) / 10, (T(i / 10) + T(0.5)) / 10};
        const auto s = surface.sample(u);
        const auto expected = plain.sample(u);
        REQUIRE((s.value == expected.value && s.pdf == expected.pdf && s.distance == expected.distance));
        REQUIRE(surface.pdf(s.value) == surface.pdf_from_hit(s.value));
        const glm::dvec3 met = glm::dvec3{from} + double{s.distance} * glm::dvec3{s.value};
        CHECK(glm::length(glm::dvec3{s.surface.position} - met) <= tolerance);
        const auto hit = surface.hit_along(s.value);
        CHECK(glm::length(glm::dvec3{hit.surface.position} - met) <= tolerance);
    }
    CHECK(surface.pdf_from_hit({T(0.8), T(0), T(-0.6)}) == 0);
}
