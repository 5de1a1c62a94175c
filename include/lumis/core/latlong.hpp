// Latitude-longitude coordinates of directions: row 0 at +y, v = acos(y) / pi, u = 1/2 + atan2(z, x) / (2 pi).
#pragma once

#include "lumis/core/spherical.hpp"

#include <cmath>
#include <concepts>
#include <numbers>

namespace lumis {

// (u, v) of a direction of any length, both in [0, 1]; NaN for a NaN. acos(y) is had from both sides of its angle: near
// the poles a float y has no digits left.
template <std::floating_point T>
[[nodiscard]] glm::vec<2, T> latlong_from_direction(const Direction<T>& w) noexcept {
    const T theta = std::atan2(std::hypot(w.x, w.z), w.y);
    const T u = T(0.5) + std::atan2(w.z, w.x) * (std::numbers::inv_pi_v<T> / 2);
    return {u < 1 ? u : u - 1, theta * std::numbers::inv_pi_v<T>};
}

// The direction at u whose angle to a pole, +y or -y, has the given versine (1 - cos) in [0, 2].
template <std::floating_point T>
[[nodiscard]] Direction<T> direction_from_latlong(T u, T versine, bool from_top) noexcept {
    const T sin_theta = sine_of_versine(versine);
    const auto circle = unit_circle(u);
    return {-sin_theta * circle.x, from_top ? 1 - versine : versine - 1, -sin_theta * circle.y};
}

}  // namespace lumis
