// Directions from two numbers and back. Angles are carried as a versine, 1 - cos(theta), and as a fraction of a turn:
// near a pole a float cosine has no digits left (1 - cos of 0.01 degree is a quarter of its last place), the versine all.
#pragma once

#include "lumis/core/sample.hpp"

#include <cmath>
#include <concepts>
#include <numbers>

namespace lumis {

// (cos, sin) of 2 pi turn.
template <std::floating_point T>
[[nodiscard]] glm::vec<2, T> unit_circle(T turn) noexcept {
    const T phi = 2 * std::numbers::pi_v<T> * turn;
    return {std::cos(phi), std::sin(phi)};
}

// The fraction of a turn, in [0, 1), at which (x, y) lies: the inverse of unit_circle. (0, 0) gives 0.
template <std::floating_point T>
[[nodiscard]] T turn_of(T x, T y) noexcept {
    const T turn = std::atan2(y, x) * (std::numbers::inv_pi_v<T> / 2);
    const T wrapped = turn < 0 ? turn + 1 : turn;
    return wrapped < 1 ? wrapped : T(0);
}

// sin(theta) from 1 - cos(theta) in [0, 2].
template <std::floating_point T>
[[nodiscard]] T sine_of_versine(T versine) noexcept {
    return std::sqrt(versine * (2 - versine));
}

// 1 - cos(theta) of a unit vector about +z, with all its digits near the pole.
template <std::floating_point T>
[[nodiscard]] T versine_of(const Direction<T>& w) noexcept {
    return w.z > 0 ? (w.x * w.x + w.y * w.y) / (1 + w.z) : 1 - w.z;
}

// The unit vector at polar angle theta from +z, given 1 - cos(theta) in [0, 2], and at a fraction of a turn from +x.
template <std::floating_point T>
[[nodiscard]] Direction<T> direction_at(T versine, T turn) noexcept {
    const T sin_theta = sine_of_versine(versine);
    const auto circle = unit_circle(turn);
    return {sin_theta * circle.x, sin_theta * circle.y, 1 - versine};
}

}  // namespace lumis
