// Cones that hold the normals of lights, and the smallest cone about two. Double, for building trees.
#pragma once

#include "lumis/core/frame.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/lights/light_bounds.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <numbers>

namespace lumis::LUMIS_ISA::detail {

// angle: from the axis, in [0, pi]. With both sides the cone stands for its opposite as well.
struct NormalCone {
    Direction<double> axis{0, 0, 1};
    double angle{std::numbers::pi};
    Sides sides{Sides::One};

    [[nodiscard]] bool is_all() const noexcept { return angle >= std::numbers::pi; }
};

template <std::floating_point T>
[[nodiscard]] NormalCone normal_cone(const LightBounds<T>& light) {
    const Direction<double> axis(light.axis);
    const double largest = (std::max)({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
    if (!(largest > 0)) return {};
    const Direction<double> scaled = axis / largest;
    return {scaled / real::length(scaled), std::acos(std::clamp(static_cast<double>(light.cos_cone), -1.0, 1.0)),
            light.sides};
}

// Conty Estevez and Kulla 2018, algorithm 1.
[[nodiscard]] inline NormalCone cone_about(const NormalCone& first, const NormalCone& second) {
    const NormalCone& wide = first.angle >= second.angle ? first : second;
    const NormalCone& narrow = first.angle >= second.angle ? second : first;
    NormalCone result{wide};
    if (narrow.sides == Sides::Both) result.sides = Sides::Both;
    Direction<double> other{narrow.axis};
    if (result.sides == Sides::Both && glm::dot(wide.axis, other) < 0) other = -other;
    const Direction<double> across = glm::cross(wide.axis, other);
    const double sine = real::length(across), between = std::atan2(sine, glm::dot(wide.axis, other));
    if (between + narrow.angle <= wide.angle) return result;
    result.angle = (wide.angle + between + narrow.angle) / 2;
    if (result.angle >= std::numbers::pi) return {wide.axis, std::numbers::pi, result.sides};
    // Turned by this much towards the other axis.
    const double turn = result.angle - wide.angle;
    const Direction<double> towards =
        sine > 0 ? glm::cross(across, wide.axis) / sine : Frame<double>{wide.axis}.tangent();
    result.axis = glm::normalize(std::cos(turn) * wide.axis + std::sin(turn) * towards);
    return result;
}

}  // namespace lumis::LUMIS_ISA::detail
