// Directions from two numbers and back. Angles are carried as a versine, 1 - cos(theta), and as a fraction of a turn:
// near a pole a float cosine has no digits left (1 - cos of 0.01 degree is a quarter of its last place), the versine all.
#pragma once

#include "lumis/core/elementary.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"

namespace lumis::LUMIS_ISA {

// sin(theta) from 1 - cos(theta) in [0, 2].
template <Real R>
[[nodiscard]] LUMIS_INLINE inline R sine_of_versine(R versine) noexcept {
    return real::sqrt(R(versine * (2 - versine)));
}

// 1 - cos(theta) of a unit vector about +z, with all its digits near the pole.
template <Real R>
[[nodiscard]] LUMIS_HD R versine_of(const Direction<R>& w) noexcept {
    const auto upper = w.z > 0;
    return real::select(upper, real::divide(R(w.x * w.x + w.y * w.y), real::divisor_where(upper, R(1 + w.z))), 1 - w.z);
}

// The unit vector at polar angle theta from +z, given 1 - cos(theta) in [0, 2], and at a turn in [0, 1] from +x.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline Direction<R> direction_at(R versine, std::type_identity_t<R> turn) noexcept {
    const R sin_theta = sine_of_versine(versine);
    const auto circle = unit_circle(turn);
    return {sin_theta * circle.x, sin_theta * circle.y, 1 - versine};
}

}  // namespace lumis::LUMIS_ISA
