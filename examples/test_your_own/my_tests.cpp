#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#include <catch2/catch.hpp>
#endif
#include "moon.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/laws.hpp>

#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>

namespace laws = lumis::testing;

TEST_CASE("the moon is a strategy") {
    for (const float z : {1.0f, 0.5f, 0.1f}) {
        const Moon moon{{std::sqrt(1 - z * z), 0, z}, 0.9f, 1.5f};
        CHECK(laws::agreement(moon));
        CHECK(laws::stays_finite(moon));
        CHECK(laws::integrates(moon));
        CHECK(laws::chi_square(moon, laws::sphere_chart(), laws::Sequential{.false_alarm = 0.001, .at_most = 100'000}));
        CHECK(laws::covers(moon, [&](glm::dvec3 wi) { return moon.f(moon.wo, wi) * wi.z; }));
    }
}

TEST_CASE("the moon is a material") {
    for (const float z : {1.0f, 0.5f, 0.1f}) {
        const Moon moon{{std::sqrt(1 - z * z), 0, z}, 0.9f, 1.5f};
        const auto f = [&](const glm::vec3& wo, const glm::vec3& wi) { return moon.f(wo, wi); };
        CHECK(laws::weighs(moon, [&](const glm::vec3& wi) { return f(moon.wo, wi) * wi.z; }));
        CHECK(laws::is_reciprocal(f));
        CHECK(laws::conserves_energy(f, moon.wo));
    }
}

// A square of side 2, parallel to the ground, as seen from the origin.
struct Panel {
    using Scalar = float;
    using Point = glm::vec3;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;
    glm::vec3 center;

    lumis::LightSample<glm::vec3, float> sample(glm::vec2 u) const noexcept {
        const glm::vec3 to_point = center + glm::vec3{2 * u.x - 1, 2 * u.y - 1, 0};
        const float distance = glm::length(to_point);
        return {to_point / distance, pdf(to_point / distance), distance};
    }
    float pdf(const glm::vec3& w) const noexcept {
        const float distance = distance_along(w);
        return std::isinf(distance) ? 0.0f : lumis::area_to_solid_angle(0.25f, distance, w.z);
    }
    float distance_along(const glm::vec3& w) const noexcept {
        const float distance = center.z / w.z;
        const glm::vec3 at = distance * w - center;
        const bool hit = distance > 0 && std::abs(at.x) <= 1 && std::abs(at.y) <= 1;
        return hit ? distance : std::numeric_limits<float>::infinity();
    }
};
static_assert(lumis::LightStrategy<Panel>);

TEST_CASE("the panel is a light") {
    const Panel panel{{0.5f, 0, 1}};
    const auto chart = laws::lobe_chart(glm::dvec3{0.5, 0, 1}, 1);  // most of it within about a radian
    CHECK(laws::agreement(panel));
    CHECK(laws::stays_finite(panel));
    CHECK(laws::integrates(panel, chart));
    CHECK(laws::chi_square(panel, chart, laws::Sequential{.false_alarm = 0.001, .at_most = 100'000}));
    CHECK(laws::jacobian(panel));
}

TEST_CASE("the panel lights the ground as it should") {
    const Panel panel{{0, 0, 1}};
    const lumis::CosineHemisphere<float> ground;
    const auto cosine = [&](const glm::vec3& w) { return panel.pdf(w) > 0 ? w.z : 0.0f; };
    lumis::Uniforms uniforms{std::mt19937{1}};
    const auto both = multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, ground), lumis::take(1, panel));
    const auto alone = multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, ground));
    // f / pdf of the ground's strategy is pi or 0. The balance heuristic makes no sample larger than that.
    constexpr float pi = std::numbers::pi_v<float>;
    const laws::Bounded estimate{0, 2 * pi, [&] { return both.estimate(cosine, uniforms); }};
    const laws::Bounded reference{0, pi, [&] { return alone.estimate(cosine, uniforms); }};
    const laws::Sequential sequential{.false_alarm = 0.001, .at_most = 100'000};
    CHECK(laws::unbiased(estimate, 1.740839502734, sequential));
    CHECK(laws::agreement(estimate, reference, sequential));
}

TEST_CASE("what failing laws print", "[.]") {
    const Moon moon{{0.6f, 0, 0.8f}, 1.02f, 1}, darker{moon.wo, 1, 1}, narrower{moon.wo, 1, 1.1f},
        narrow{moon.wo, 1, 1e5f};
    const auto f = [&](const glm::vec3& wo, const glm::vec3& wi) { return moon.f(wo, wi); };
    const auto expected = laws::expectation(laws::density_of(narrower), laws::sphere_chart());
    std::cout << laws::weighs(darker, [&](const glm::vec3& wi) { return f(moon.wo, wi) * wi.z; }) << "\n\n"
              << laws::conserves_energy(f, moon.wo) << "\n\n"
              << laws::chi_square(moon, expected, laws::Sequential{.false_alarm = 0.001}) << "\n\n"
              << laws::chi_square(narrow, laws::sphere_chart()) << '\n';
}
