// Triangles by solid angle against long double: how large they look, and that every uniform falls where its share of the
// solid angle says, from 1e-8 sr to nearly a hemisphere.
#include "catch.hpp"
#include "polygons.hpp"
#include <lumis/lumis.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace {

using polygons::V;

template <class T>
using Light = lumis::AreaLight<lumis::Triangle<T>, lumis::BySolidAngle>;

template <class T>
constexpr glm::vec<3, T> origin{T(0), T(0), T(0)};

// The longest edge over the least height: by so much a sliver magnifies the rounding of its edges.
double thinness(const V& a, const V& b, const V& c) {
    const long double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    return static_cast<double>(longest * longest / glm::length(glm::cross(b - a, c - a)));
}

// Calls visit(triangle, width): random triangles about as wide as told, in radians, at any distance.
template <class T, class Visit>
void for_each_triangle(Visit visit) {
    polygons::Random random{1};
    for (const double width : {1e-4, 1e-3, 1e-2, 0.1, 0.5, 1.0, 2.0, 5.0, 30.0}) {
        for (int i = 0; i < 12; ++i) {
            const double distance = std::pow(10, 3 * random());
            const glm::dvec3 middle = random.direction();
            const auto vertex = [&] { return glm::vec<3, T>(distance * (middle + width / 2 * random.vector())); };
            const lumis::Triangle<T> triangle{vertex(), vertex(), vertex()};
            const V a{triangle.a}, b{triangle.b}, c{triangle.c};
            // Slivers and planes through the eye have tests of their own.
            const V normal = glm::normalize(glm::cross(b - a, c - a));
            const auto nearest = std::min({glm::length(a), glm::length(b), glm::length(c)});
            if (thinness(a, b, c) > 20 || std::abs(glm::dot(normal, a)) < 0.1L * nearest) continue;
            visit(triangle, std::min(width, 1.0));
        }
    }
}

}  // namespace

TEMPLATE_TEST_CASE("the solid angle of triangles of any size", "[spherical_triangle]", float, double) {
    using T = TestType;
    const double tolerance = std::is_same_v<T, float> ? 1e-5 : 1e-13;
    double smallest = 10, largest = 0, worst = 0;
    int number = 0;
    for_each_triangle<T>([&](const lumis::Triangle<T>& triangle, double) {
        const Light<T> light{triangle, origin<T>};
        const long double exact = polygons::solid_angle(V{triangle.a}, V{triangle.b}, V{triangle.c});
        worst = std::fmax(worst, static_cast<double>(std::abs(light.solid_angle() / exact - 1)));
        worst = std::fmax(worst, static_cast<double>(std::abs(light.sample({T(0.5), T(0.5)}).pdf * exact - 1)));
        smallest = std::fmin(smallest, static_cast<double>(exact));
        largest = std::fmax(largest, static_cast<double>(exact));
        ++number;
    });
    INFO("worst " << worst);
    CHECK(worst <= tolerance);
    CHECK(number >= 30);
    CHECK(smallest <= 1e-8);
    CHECK(largest >= 2);
}

// All that is wider than a hemisphere is seen from beside the plane: a big triangle a little above the eye.
TEMPLATE_TEST_CASE("the solid angle of triangles up to the hemisphere", "[spherical_triangle]", float, double) {
    using T = TestType;
    const double tolerance = std::is_same_v<T, float> ? 1e-5 : 1e-13;
    for (double height = 1; height >= 1e-3; height /= 2) {
        const T h = static_cast<T>(height);
        const lumis::Triangle<T> triangle{{T(-2), T(-1), h}, {T(2), T(-1.25), h}, {T(0.25), T(2), h}};
        const Light<T> light{triangle, origin<T>};
        const long double exact = polygons::solid_angle(V{triangle.a}, V{triangle.b}, V{triangle.c});
        INFO("height " << height << ", " << static_cast<double>(exact) << " sr");
        CHECK(static_cast<double>(std::abs(light.solid_angle() / exact - 1)) <= tolerance);
        const T x = T(0.3), y = T(0.6);
        CHECK(static_cast<double>(std::abs(light.sample({x, y}).pdf * exact - 1)) <= tolerance);
    }
    const lumis::Triangle<T> octant{{T(1), T(0), T(0)}, {T(0), T(1), T(0)}, {T(0), T(0), T(1)}};
    CHECK(std::abs(double{Light<T>{octant, origin<T>}.solid_angle()} / std::acos(0.0) - 1) <= tolerance);
    const lumis::Triangle<T> gold{{T(0), T(0), T(1)}, {T(1), T(0), T(1)}, {T(0), T(1), T(1)}};
    CHECK(std::abs(double{Light<T>{gold, origin<T>}.solid_angle()} / 0.339836909454 - 1) <= std::max(tolerance, 1e-11));
    // 6.28 sr and beyond.
    const lumis::Triangle<T> all{{T(-4e3), T(-2e3), T(1)}, {T(4e3), T(-2e3), T(1)}, {T(0), T(4e3), T(1)}};
    const long double exact = polygons::solid_angle(V{all.a}, V{all.b}, V{all.c});
    CHECK(exact > 6.28L);
    CHECK(static_cast<double>(std::abs(Light<T>{all, origin<T>}.solid_angle() / exact - 1)) <= tolerance);
}

TEMPLATE_TEST_CASE("the solid angle of slivers and of tiny triangles far from the origin", "[spherical_triangle]",
                   float, double) {
    using T = TestType;
    const double epsilon = std::numeric_limits<T>::epsilon();
    const auto check = [&](const lumis::Triangle<T>& triangle, const glm::vec<3, T>& reference) {
        const Light<T> light{triangle, reference};
        const V eye{reference}, a = V{triangle.a} - eye, b = V{triangle.b} - eye, c = V{triangle.c} - eye;
        const long double exact = polygons::solid_angle(a, b, c);
        const double error = static_cast<double>(std::abs(light.solid_angle() / exact - 1));
        INFO("solid angle " << static_cast<double>(exact) << ", thinness " << thinness(a, b, c) << ", error " << error);
        CHECK(error <= 40 * epsilon * thinness(a, b, c));
        const T quarter = T(0.25);
        CHECK(static_cast<double>(std::abs(light.sample({quarter, quarter}).pdf * exact - 1)) <=
              40 * epsilon * thinness(a, b, c));
    };
    for (double width = 1; width > 1e3 * epsilon; width /= 4) {
        const T w = static_cast<T>(width);
        check({{T(-1), T(0.5), T(2)}, {T(1), T(0.25), T(2)}, {T(1), T(0.25) + w, T(2)}}, origin<T>);
        check({{T(-1), T(0.5), T(2)}, {T(1), T(0.25), T(2)}, {T(0.1), T(0.3625) + w, T(2)}}, origin<T>);
        check({{T(-100), T(0.5), T(2)}, {T(100), T(0.25), T(2)}, {T(90), T(0.25) + w, T(3)}}, origin<T>);
    }
    // Coordinates of 1e6 keep 1/16 in float; the eye is as far out.
    for (const T size : {T(1), T(4), T(64)}) {
        const glm::vec<3, T> far{T(1e6), T(-1e6), T(1e6)};
        check({far + glm::vec<3, T>{T(0), T(0), T(64)}, far + glm::vec<3, T>{size, T(0), T(64)},
               far + glm::vec<3, T>{T(0), size, T(65)}},
              far);
    }
    // Vertices at 1e6, the eye at the origin.
    check({{T(1e6), T(0), T(1e6)}, {T(1e6), T(1e6), T(1e6)}, {T(-1e6), T(1e6), T(2e6)}}, origin<T>);
    check({{T(1e6), T(0), T(1)}, {T(-1e6), T(1e6), T(1)}, {T(-1e6), T(-1e6), T(1)}}, origin<T>);
    check({{T(1e6), T(0), T(1e6)}, {T(1000100), T(0), T(1e6)}, {T(1e6), T(100), T(1e6)}}, origin<T>);
}

// The map's two rules: the arc through the sample cuts off the share u.x of the solid angle, and along it u.y is a share
// of 1 - cos. Together they are evenness over the solid angle.
TEMPLATE_TEST_CASE("a uniform cuts its share off a triangle", "[spherical_triangle]", float, double) {
    using T = TestType;
    const double epsilon = std::numeric_limits<T>::epsilon();
    double worst_share = 0, worst_height = 0, worst_inside = 0, worst_return = 0;
    int off_the_light = 0;
    for_each_triangle<T>([&](const lumis::Triangle<T>& triangle, double width) {
        const Light<T> light{triangle, origin<T>};
        const V a = glm::normalize(V{triangle.a}), b = glm::normalize(V{triangle.b}), c = glm::normalize(V{triangle.c});
        const long double all = polygons::solid_angle(a, b, c);
        const V inward = glm::cross(a, b) * (glm::dot(glm::cross(a, b), c) > 0 ? 1.0L : -1.0L);
        const V normal = glm::normalize(glm::cross(V{triangle.b} - V{triangle.a}, V{triangle.c} - V{triangle.a}));
        lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{2}};
        for (int i = 0; i < 100; ++i) {
            const auto u = uniforms.template next<2>();
            const auto sample = light.sample(u);
            const V w = glm::normalize(V{sample.value});
            // Inside, by the planes of the three edges.
            const V edges[] = {inward, glm::cross(b, c) * (glm::dot(glm::cross(b, c), a) > 0 ? 1.0L : -1.0L),
                               glm::cross(c, a) * (glm::dot(glm::cross(c, a), b) > 0 ? 1.0L : -1.0L)};
            for (const V& edge : edges) {
                worst_inside = std::fmax(worst_inside, static_cast<double>(-glm::dot(w, glm::normalize(edge))));
            }
            // At the distance told it lies in the triangle's plane.
            const V hit = V{sample.value} * static_cast<long double>(sample.distance);
            const auto off = glm::dot(hit - V{triangle.a}, normal) / sample.distance;
            off_the_light += !(light.pdf(sample.value) > 0 && sample.distance > 0 && std::abs(off) <= 8 * epsilon);
            // The point q in which the arc from a through w leaves the triangle.
            const V out = glm::cross(glm::cross(a, w - a), glm::cross(b, c - b));
            const V q = glm::normalize(glm::dot(out, b + c) > 0 ? out : -out);
            const double share = static_cast<double>(polygons::solid_angle(a, b, q) / all);
            const double height = static_cast<double>(glm::dot(w - a, w - a) / glm::dot(q - a, q - a));
            // Next to a the arc's direction drowns in w's rounding.
            const double blur = epsilon / width / std::sqrt(double{u.y} + epsilon);
            worst_share = std::fmax(worst_share, std::abs(share - double{u.x}) / blur);
            worst_height = std::fmax(worst_height, std::abs(height - double{u.y}) / (epsilon / width));
            const auto again = light.invert(sample.value);
            worst_return = std::fmax(worst_return, std::abs(double{again.x} - double{u.x}) / blur);
            worst_return = std::fmax(worst_return, std::abs(double{again.y} - double{u.y}) / (epsilon / width));
        }
    });
    INFO("share " << worst_share << ", height " << worst_height << ", inside " << worst_inside / epsilon << ", return "
                  << worst_return << ", all in units of epsilon");
    CHECK(worst_share <= 100);
    CHECK(worst_height <= 100);
    CHECK(worst_return <= 100);
    CHECK(worst_inside <= 4 * epsilon);
    CHECK(off_the_light == 0);
}

// Corners of the unit square, 1 included, are corners of the triangle.
TEMPLATE_TEST_CASE("the ends of the uniforms are the corners of a triangle", "[spherical_triangle]", float, double) {
    using T = TestType;
    const double epsilon = std::numeric_limits<T>::epsilon();
    for_each_triangle<T>([&](const lumis::Triangle<T>& triangle, double width) {
        const Light<T> light{triangle, origin<T>};
        const auto at = [&](double x, double y, const glm::vec<3, T>& vertex) {
            const auto sample = light.sample({static_cast<T>(x), static_cast<T>(y)});
            const V error = V{sample.value} - glm::normalize(V{vertex});
            INFO("u " << x << ", " << y << ", " << double{light.solid_angle()} << " sr");
            // A wide triangle's corner moves by much for a small share of its solid angle.
            CHECK(static_cast<double>(glm::length(error)) <= 1000 * epsilon / width);
            CHECK(sample.pdf > 0);
        };
        for (const double x : {0.0, 0.5, 1.0}) at(x, 0, triangle.a);
        at(0, 1, triangle.b);
        at(1, 1, triangle.c);
    });
}

// Rounded across an edge, a direction still leads back to that edge's end of the uniforms.
TEMPLATE_TEST_CASE("directions on the edges of a triangle lead back to the ends of the uniforms",
                   "[spherical_triangle]", float, double) {
    using T = TestType;
    const double epsilon = std::numeric_limits<T>::epsilon();
    double worst = 0;
    for_each_triangle<T>([&](const lumis::Triangle<T>& triangle, double width) {
        const Light<T> light{triangle, origin<T>};
        for (const T x : {T(0), T(1)}) {
            for (const T y : {T(0.1), T(0.5), T(0.77), T(1)}) {
                const auto u = light.invert(light.sample({x, y}).value);
                worst = std::fmax(worst, std::abs(double{u.x} - double{x}) * width / epsilon);
                worst = std::fmax(worst, std::abs(double{u.y} - double{y}) * width / epsilon);
                if (!(u.x >= 0)) worst = 1e9;
            }
        }
    });
    INFO(worst << " epsilon");
    CHECK(worst <= 400);
}

// The arc from a vertex to its opposite point is half a turn long, and rounding must not make it longer.
TEMPLATE_TEST_CASE("a triangle that reaches to the opposite of its vertex", "[spherical_triangle]", float, double) {
    using T = TestType;
    polygons::Random random{8};
    int ill = 0;
    for (int i = 0; i < 2000; ++i) {
        const T height = static_cast<T>(std::pow(10.0, -8 + 8 * random()));
        const glm::vec<3, T> a{static_cast<T>(-2 - random()), static_cast<T>(random()), height};
        const glm::vec<3, T> far = T(-0.8) * a, along{-a.y, a.x, T(0)};
        const glm::vec<3, T> b{far.x + along.x, far.y + along.y, height}, c{far.x - along.x, far.y - along.y, height};
        const lumis::detail::SphericalTriangle<T> seen{a, b, c, b - a, c - a};
        for (const T x : {T(0), T(0.25), T(0.5), T(0.75), T(1)}) {
            for (const T y : {T(0), T(0.5), 1 - std::numeric_limits<T>::epsilon() / 2, T(1)}) {
                const double length = glm::length(glm::dvec3{seen.sample({x, y})});
                ill += !(std::abs(length - 1) <= 8 * double{std::numeric_limits<T>::epsilon()});
            }
        }
    }
    CHECK(ill == 0);
}
