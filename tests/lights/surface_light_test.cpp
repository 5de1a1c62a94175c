// What lights tell of their surface: position, normal and coordinates, against what the documented coordinates mean; far away
// and small; along directions that others drew; through sets, mixtures and estimators.
#include "catch.hpp"
#include "irradiance.hpp"
#include "light_shapes.hpp"
#include <lumis/core/lanes.hpp>
#include <lumis/lumis.hpp>
#include <lumis/testing/unbiased.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>
#include <typeinfo>
#include <vector>

namespace {

namespace laws = lumis::testing;
using V = glm::dvec3;

template <class Shape, class Sampling>
using Light = lumis::SurfaceLight<Shape, Sampling>;

// How far a sample's surface is from what it should be, in units in the last place: of positions relative to the shape's
// largest coordinate, of normals, and of the ray to the position relative to the coordinates of both ends.
struct Errors {
    double position = 0, normal = 0, ray = 0;
};

template <class Shape, class Sampling, class T>
Errors errors(const Shape& shape, Sampling, const glm::vec<3, T>& from) {
    const double epsilon = std::numeric_limits<T>::epsilon();
    const Light<Shape, Sampling> light{shape, from};
    const lumis::AreaLight<Shape, Sampling> plain{shape, from};
    auto uniforms = irradiance::uniforms<T>(1);
    const double largest = shapes::largest_coordinate(shape);
    Errors worst;
    for (int i = 0; i < 500; ++i) {
        const auto u = uniforms.template next<2>();
        const auto s = light.sample(u);
        const auto expected = plain.sample(u);
        REQUIRE((s.value == expected.value && s.pdf == expected.pdf && s.distance == expected.distance));
        if (!(s.pdf > 0)) continue;
        const auto& [position, normal, uv] = s.surface;
        REQUIRE((uv.x >= 0 && uv.y >= 0 && uv.x <= 1 && uv.y <= 1));
        if (uv.x > T(0.99)) continue;  // next to 1 a coordinate of the sphere has few digits
        worst.position =
            std::fmax(worst.position, glm::length(V{position} - shapes::position(shape, glm::dvec2{uv})) / largest);
        const V along = V{from} + double{s.distance} * V{s.value};
        worst.ray = std::fmax(worst.ray, glm::length(along - V{position}) / (largest + double{s.distance}));
        worst.normal = std::fmax(worst.normal, glm::length(V{normal} - shapes::normal(shape, glm::dvec2{uv})));
    }
    return {worst.position / epsilon, worst.normal / epsilon, worst.ray / epsilon};
}

}  // namespace

TEMPLATE_TEST_CASE("surface coordinates mean what is documented", "[surface_light]", float, double) {
    using T = TestType;
    // Near by; small and far away, at home and where coordinates are large.
    struct Case {
        V middle;
        double size;
        V from;
    };
    const Case cases[] = {{{0.5, -1, 2}, 1, {0.3, 0.2, -0.5}},
                          {{0, 0, 0}, 1e-3, {100, -300, 200}},
                          {{300, 200, -500}, 1, {0, 0, 0}},
                          {{1e-3, 0, 2e-3}, 1e-4, {1e-3, 1e-3, 0}}};
    for (const Case& c : cases) {
        shapes::for_each_light<T>(c.middle, c.size, [&](const auto& shape, auto sampling) {
            const auto [position, normal, ray] = errors(shape, sampling, shapes::point<T>(c.from));
            INFO("size " << c.size << ", " << typeid(shape).name() << ", " << typeid(sampling).name());
            constexpr bool is_round = std::same_as<std::remove_cvref_t<decltype(shape)>, lumis::Sphere<T>>;
            CHECK(position <= (is_round ? 6 : 3));
            CHECK(normal <= 8);
            CHECK(ray <= 16);
        });
    }
}

// Along w a light's surface is that which a sample in this direction has, as exactly as w tells it.
TEMPLATE_TEST_CASE("the surface along a direction", "[surface_light]", float, double) {
    using T = TestType;
    const double tolerance = 400 * double{std::numeric_limits<T>::epsilon()};
    const glm::vec<3, T> from{T(0.3), T(0.2), T(-0.5)};
    shapes::for_each_light<T>({0.5, -1, 2}, 1, [&](const auto& shape, auto sampling) {
        const Light<std::remove_cvref_t<decltype(shape)>, decltype(sampling)> light{shape, from};
        auto uniforms = irradiance::uniforms<T>(2);
        for (int i = 0; i < 300; ++i) {
            const auto s = light.sample(uniforms.template next<2>());
            // The rim of a sphere is a blur.
            if (!(s.pdf > 0) || std::abs(glm::dot(s.value, s.surface.normal)) < T(0.1)) continue;
            const auto hit = light.hit_along(s.value);
            REQUIRE(hit.distance == light.distance_along(s.value));
            REQUIRE(std::abs(double{hit.distance} - double{s.distance}) <= tolerance);
            REQUIRE(glm::length(V{hit.surface.position} - V{s.surface.position}) <= tolerance);
            REQUIRE(glm::length(V{hit.surface.normal} - V{s.surface.normal}) <= tolerance);
            const V expected = shapes::position(shape, glm::dvec2{hit.surface.uv});
            REQUIRE(glm::length(V{hit.surface.position} - expected) <= tolerance);
        }
        const auto missed = light.hit_along({T(0), T(0), T(-1)});
        CHECK(missed.distance == std::numeric_limits<T>::infinity());
        CHECK(lumis::all_finite(missed.surface.position));
    });
}

TEMPLATE_TEST_CASE("the surface in lanes", "[surface_light]", float, double) {
    using T = TestType;
    using L = lumis::Lanes<T, 4>;
    const glm::vec<3, T> from{T(0.3), T(0.2), T(-0.5)};
    const double tolerance = 2000 * double{std::numeric_limits<T>::epsilon()};
    shapes::for_each_light<T>({0.5, -1, 2}, 1, [&](const auto& shape, auto sampling) {
        const Light<std::remove_cvref_t<decltype(shape)>, decltype(sampling)> light{shape, from};
        auto uniforms = irradiance::uniforms<T>(3);
        glm::vec<2, T> u[4];
        for (auto& one : u) one = T(0.4) * uniforms.template next<2>();
        const auto lane = [&](int k) { return L::of_lanes([&](auto i) { return u[i][k]; }); };
        const auto drawn = lumis::detail::sample_in<L>(light, glm::vec<2, L>{lane(0), lane(1)});
        const auto met = lumis::detail::hit_in<L>(light, drawn.value);
        for (std::size_t i = 0; i < 4; ++i) {
            const auto expected = light.sample(u[i]);
            if (!(expected.pdf > 0)) continue;
            for (const auto& surface :
                 {lumis::detail::lane_of_sample(drawn, i).surface, lumis::detail::lane_of(met.surface, i)}) {
                CHECK(glm::length(V{surface.position} - V{expected.surface.position}) <= tolerance);
                CHECK(glm::length(V{surface.normal} - V{expected.surface.normal}) <= tolerance);
                CHECK(glm::length(glm::dvec2{surface.uv} - glm::dvec2{expected.surface.uv}) <= tolerance);
            }
        }
    });
}

// A picture on each of two triangles, one of which stands before a part of the other. What an integrand is told must not
// depend on who drew the direction.
TEMPLATE_TEST_CASE("irradiance from textured lights by every combination", "[surface_light]", float, double) {
    using T = TestType;
    using P = glm::vec<3, T>;
    const P origin{T(0), T(0), T(0)};
    const lumis::Triangle<T> distant{{T(-2), T(-1), T(2)}, {T(-1), T(2), T(2.5)}, {T(2), T(-1), T(2)}};
    const lumis::Triangle<T> close{{T(-0.5), T(-0.5), T(1)}, {T(-0.2), T(1), T(1)}, {T(0.8), T(0), T(1.2)}};
    const auto radiance = [](const lumis::AnySample auto& s) {
        if (!(s.distance < std::numeric_limits<T>::infinity()) || s.value.z <= 0) return T(0);
        // Bright at b, and with the height of the point; seen from in front alone.
        const T facing = -glm::dot(s.surface.normal, s.value);
        return facing > 0 ? s.value.z * s.surface.uv.x * s.surface.position.z : T(0);
    };
    // A midpoint rule over the hemisphere's projection, without the library.
    double answer = 0;
    constexpr int cells = 1000;
    for (int i = 0; i < cells * cells; ++i) {
        const double x = (i % cells + 0.5) * 2 / cells - 1, y = (i / cells + 0.5) * 2 / cells - 1;
        if (x * x + y * y >= 1) continue;
        const V w{x, y, std::sqrt(1 - x * x - y * y)};
        double nearest = 1e30, value = 0;
        for (const auto& shape : {distant, close}) {
            const V a{shape.a}, b = V{shape.b} - a, c = V{shape.c} - a, n = glm::cross(b, c);
            const double det = glm::dot(w, n), t = glm::dot(a, n) / det;
            const double u = glm::dot(a, glm::cross(w, c)) / det, v = glm::dot(a, glm::cross(b, w)) / det;
            if (!(t > 0 && u >= 0 && v >= 0 && u + v <= 1) || t > nearest) continue;
            nearest = t;
            value = det < 0 ? u * (a.z + u * b.z + v * c.z) : 0;
        }
        answer += value * 4 / (cells * cells);
    }
    REQUIRE(answer > 0.01);

    using lumis::choose, lumis::take;
    const lumis::SurfaceLight first{distant, origin};
    const lumis::SurfaceLight<lumis::Triangle<T>, lumis::BySolidAngle> second{close, origin};
    const lumis::CosineHemisphere<T> cosine;
    const lumis::BalanceHeuristic balance;
    const auto run = [&](const char* how, const auto& combination) {
        auto uniforms = irradiance::uniforms<T>(4);
        laws::UnbiasedOptions options;
        options.samples = 20'000;
        options.significance = irradiance::significance;
        options.answer_error = 1e-3 * answer;  // the midpoint rule's, at edges
        const auto law = laws::unbiased([&] { return combination.estimate(radiance, uniforms); }, answer, options);
        INFO(how << ": " << law.message);
        CHECK(law.passed);
        CHECK(law.relative_standard_error <= 0.02);
    };
    run("multi-sample", lumis::multi_sample(balance, take(1, cosine), take(1, first), take(1, second)));
    run("BSDF alone", lumis::multi_sample(balance, take(1, cosine), take(0, first), take(0, second)));
    run("one-sample", lumis::one_sample(balance, choose(0.2, cosine), choose(0.4, first), choose(0.4, second)));
    const lumis::LightSet set{std::vector{first, lumis::SurfaceLight{close, origin}}, std::vector<T>{T(2), T(1)}};
    static_assert(lumis::SurfaceStrategy<std::remove_const_t<decltype(set)>>);
    run("set", lumis::multi_sample(balance, take(1, set)));
    const lumis::Mixture mixture{choose(0.3, cosine), choose(0.4, first), choose(0.3, second)};
    static_assert(lumis::SurfaceStrategy<std::remove_const_t<decltype(mixture)>>);
    run("mixture", lumis::multi_sample(balance, take(1, mixture)));
    run("mixture and set", lumis::multi_sample(balance, take(1, mixture), take(1, set)));
}
