// A shape of one's own as a light: a flat ring about +z that shines downwards and upwards, and the laws that try it.
#include "catch.hpp"
#include "z_test.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/laws.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace {

// The points of a horizontal plane between two radii, evenly by area, as directions from a reference point.
class RingLight {
  public:
    using Scalar = float;
    using Point = lumis::Direction<float>;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;

    RingLight(const glm::vec3& center, float inner, float outer, const glm::vec3& reference_point)
        : center_{center - reference_point}, inner_squared_{inner * inner}, outer_squared_{outer * outer} {}

    lumis::LightSample<Point, float> sample(glm::vec2 u) const noexcept {
        const float radius = std::sqrt(inner_squared_ + u.x * (outer_squared_ - inner_squared_));
        const glm::vec2 circle = lumis::unit_circle(u.y);
        const glm::vec3 to_point = center_ + radius * glm::vec3{circle.x, circle.y, 0};
        const float distance = glm::length(to_point);
        if (!(distance > 0)) return {};
        const Point w = to_point / distance;
        return {w, pdf(w), distance};
    }

    float pdf(const Point& w) const noexcept {
        const float distance = distance_along(w);
        if (!(distance < std::numeric_limits<float>::infinity())) return 0;
        const float area = std::numbers::pi_v<float> * (outer_squared_ - inner_squared_);
        return lumis::area_to_solid_angle(1 / area, distance, w.z);
    }

    // To the ring; infinity where w misses it.
    float distance_along(const Point& w) const noexcept {
        const float distance = center_.z / w.z;
        const glm::vec2 from_center = distance * glm::vec2{w} - glm::vec2{center_};
        const float squared = glm::dot(from_center, from_center);
        const bool hit = distance > 0 && squared >= inner_squared_ && squared <= outer_squared_;
        return hit ? distance : std::numeric_limits<float>::infinity();
    }

  private:
    glm::vec3 center_;  // relative to the reference point
    float inner_squared_, outer_squared_;
};
static_assert(lumis::LightStrategy<RingLight>);

TEST_CASE("a shape of one's own keeps the laws") {
    const RingLight ring{{0.5f, 0, 1}, 0.5f, 1, glm::vec3{0}};
    const auto is_lit = [](const glm::dvec3& w) {  // where the ring shines
        const double from_center = glm::length(glm::dvec2{w} / w.z - glm::dvec2{0.5, 0});
        return w.z > 0 && from_center > 0.5 && from_center < 1;
    };

    const auto chart = lumis::testing::lobe_chart(glm::dvec3{0.5, 0, 1}, 1);  // most of it within about a radian
    CHECK(lumis::testing::agreement(ring));
    CHECK(lumis::testing::integrates(ring, chart));
    CHECK(lumis::testing::chi_square(ring, chart));
    CHECK(lumis::testing::covers(ring, is_lit, chart));
    CHECK(lumis::testing::jacobian(ring));
    CHECK(lumis::testing::stays_finite(ring));
}

TEST_CASE("a shape of one's own gives the light that it should") {
    // A disk of radius r overhead gives pi r^2 / (h^2 + r^2); a ring is a disk less a disk.
    const double answer = std::numbers::pi * (1.0 / 2 - 0.25 / 1.25);
    const RingLight ring{{0, 0, 1}, 0.5f, 1, glm::vec3{0}};
    const auto direct =
        multi_sample(lumis::PowerHeuristic{}, lumis::take(1, lumis::CosineHemisphere<float>{}), lumis::take(1, ring));
    const auto cosine = [&](const glm::vec3& w) { return w.z > 0 && ring.pdf(w) > 0 ? w.z : 0.0f; };
    const auto law = z_test<float>([&](auto& uniforms) { return direct.estimate(cosine, uniforms); }, answer, 1);
    INFO(law.message);
    CHECK(law.passed);
}

}  // namespace
