// Bounds of lights: boxes hold the shapes and cones the normals, so that a light tree leaves no light out that can contribute.
#include "catch.hpp"
#include "light_shapes.hpp"
#include "random_points.hpp"
#include <lumis/lights/light_bounds.hpp>
#include <lumis/lights/light_tree.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>
#include <vector>

namespace {

using lumis::LightBounds;
using lumis::LightTree;
using lumis::Sides;

TEMPLATE_TEST_CASE("the bounds of a shape hold its points and normals", "[light_bounds]", float, double) {
    using T = TestType;
    RandomPoints random{1};
    std::size_t outside = 0;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 middle = i % 2 == 0 ? random.point() : 1e4 * random.point();
        const auto check = [&](const auto& shape) {
            const LightBounds<T> bounds = light_bounds(shape, 1, Sides::One);
            for (int k = 0; k < 50; ++k) {
                glm::dvec2 uv{random.number(0, 1), random.number(0, 1)};
                if (k < 4) uv = {k % 2, k / 2};
                if constexpr (requires { shape.a; }) {
                    if (uv.x + uv.y > 1) uv = uv.x > uv.y ? glm::dvec2{1, 0} : glm::dvec2{0, 1};
                }
                const glm::dvec3 x = shapes::position(shape, uv), n = shapes::normal(shape, uv);
                for (int c = 0; c < 3; ++c)
                    outside += !(double(bounds.lower[c]) <= x[c] && x[c] <= double(bounds.upper[c]));
                outside += !(glm::dot(n, glm::dvec3(bounds.axis)) >= double(bounds.cos_cone) - 1e-6);
            }
        };
        const double size = std::pow(10, random.number(-3, 2));
        std::apply([&](const auto&... shape) { (check(shape), ...); }, shapes::each<T>(middle, size));
    }
    CHECK(outside == 0);
}

TEMPLATE_TEST_CASE("the intensity of a shape is its radiance times the largest area that it shows", "[light_bounds]",
                   float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const auto near = [](T a, double b) { return std::abs(double(a) / b - 1) <= 1e-6; };
    CHECK(near(light_bounds(lumis::Triangle<T>{V(0), V(2, 0, 0), V(0, 3, 0)}, 2).intensity, 6));
    CHECK(near(light_bounds(lumis::Parallelogram<T>{V(1), V(2, 0, 0), V(1, 3, 0)}, 2).intensity, 12));
    CHECK(near(light_bounds(lumis::Disk<T>{V(1), V(0, 0, 7), 2}, 3).intensity, 12 * std::numbers::pi));
    CHECK(near(light_bounds(lumis::Sphere<T>{V(1), 2}, 3).intensity, 12 * std::numbers::pi));
    CHECK(near(light_bounds(lumis::Triangle<T>{V(0), V(T(2e-15), 0, 0), V(0, T(3e-15), 0)}, 2).intensity, 6e-30));
    // No area.
    CHECK(light_bounds(lumis::Triangle<T>{V(0), V(1), V(2)}, 2).intensity == 0);
    CHECK(light_bounds(lumis::Disk<T>{V(1), V(0), 2}, 3).intensity == 0);
    CHECK(light_bounds(lumis::Disk<T>{V(1), V(1), 0}, 3).intensity == 0);
    CHECK(light_bounds(lumis::Sphere<T>{V(1), -1}, 3).intensity == 0);
}

TEST_CASE("a cone about two holds what either holds", "[light_bounds]") {
    using lumis::detail::NormalCone;
    RandomPoints random{2};
    const auto holds = [](const NormalCone& cone, const glm::dvec3& w) {
        const double cosine = glm::dot(cone.axis, w);
        return std::acos(std::fmin(cone.sides == Sides::Both ? std::abs(cosine) : cosine, 1)) <= cone.angle + 1e-7;
    };
    std::size_t missed = 0, narrow = 0;
    const auto check = [&](const NormalCone& a, const NormalCone& b) {
        const NormalCone about = cone_about(a, b);
        narrow += !about.is_all();
        for (int k = 0; k < 50; ++k) {
            const glm::dvec3 w = random.direction();
            missed += (holds(a, w) || holds(b, w)) && !holds(about, w);
        }
        for (const NormalCone& one : {a, b}) {
            missed += !holds(about, one.axis);
            missed += one.sides == Sides::Both && !holds(about, -one.axis);
        }
    };
    for (int i = 0; i < 400; ++i) {
        const auto cone = [&] {
            const double angle = i % 4 == 0 ? 0.0 : random.number(0, std::numbers::pi) * random.number(0, 1);
            return NormalCone{random.direction(), angle, random.number(0, 1) < 0.5 ? Sides::One : Sides::Both};
        };
        check(cone(), cone());
    }
    for (const double angle : {0.0, 0.5, 3.0}) {
        check({{0, 0, 1}, angle, Sides::One}, {{0, 0, -1}, 0, Sides::One});
        check({{0, 0, 1}, angle, Sides::One}, {{0, 0, 1}, angle, Sides::One});
    }
    CHECK(missed == 0);
    CHECK(narrow > 300);
}

// The corners of flat shapes decide: a point sees some of a flat light if it sees a corner.
template <class T>
bool contributes(const auto& shape, Sides sides, const glm::vec<3, T>& point, const glm::vec<3, T>& normal) {
    for (const double u : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        for (const double v : {0.0, 0.125, 0.25, 0.5, 0.75, 1.0}) {
            if constexpr (requires { shape.a; }) {
                if (u + v > 1) continue;
            }
            const glm::dvec3 to_light = shapes::position(shape, {u, v}) - glm::dvec3(point);
            const double cos_light = -glm::dot(shapes::normal(shape, {u, v}), to_light);
            const bool emits = sides == Sides::Both ? cos_light != 0 : cos_light > 0;
            if (emits && glm::dot(glm::dvec3(normal), to_light) > 0) return true;
        }
    }
    return false;
}

TEMPLATE_TEST_CASE("a light tree leaves no light out that can contribute", "[light_tree]", float, double) {
    using T = TestType;
    RandomPoints random{3};
    std::size_t contributing = 0, left_out = 0, missed = 0;
    for (int scene = 0; scene < 30; ++scene) {
        // Few lights or many, close together or apart, far from the origin or around it.
        const double size = std::pow(10, random.number(-3, 0));
        const glm::dvec3 middle = scene % 3 == 0 ? 1000.0 * random.point() : glm::dvec3{0};
        const auto lights = [&] {
            std::vector<decltype(shapes::each<T>(glm::dvec3{}, 1))> result;
            for (int i = 0; i < (scene % 5 + 1) * 4; ++i)
                result.push_back(shapes::each<T>(middle + random.point(), size * random.number(0.1, 1)));
            return result;
        }();
        std::vector<LightBounds<T>> bounds;
        std::vector<Sides> sides;
        for (const auto& five : lights) {
            std::apply(
                [&](const auto&... shape) {
                    const auto add = [&](const auto& one) {
                        sides.push_back(random.number(0, 1) < 0.7 ? Sides::One : Sides::Both);
                        bounds.push_back(light_bounds(one, static_cast<T>(random.number(0.1, 1)), sides.back()));
                    };
                    (add(shape), ...);
                },
                five);
        }
        const LightTree tree{bounds};
        for (int view = 0; view < 60; ++view) {
            // Anywhere, or in the middle of a light's box, where it may lie on the light.
            const auto& some = bounds[static_cast<std::size_t>(random.number(0, 1) * double(bounds.size()))];
            const glm::vec<3, T> point =
                view % 2 == 0 ? glm::vec<3, T>(middle + 1.5 * random.point()) : some.lower / T(2) + some.upper / T(2);
            const glm::vec<3, T> normal = view % 5 == 0 ? some.axis : glm::vec<3, T>(random.direction());
            const auto seen = tree.from(point, normal);
            std::size_t i = 0;
            for (const auto& five : lights) {
                std::apply(
                    [&](const auto&... shape) {
                        const auto check = [&](const auto& one) {
                            const bool may = contributes(one, sides[i], point, normal), drawn = seen.pdf(i) > 0;
                            contributing += may;
                            left_out += !drawn;
                            missed += may && !drawn;
                            ++i;
                        };
                        (check(shape), ...);
                    },
                    five);
            }
        }
    }
    CHECK(missed == 0);
    CHECK(contributing > 10'000);
    CHECK(left_out > 5'000);
}

}  // namespace
