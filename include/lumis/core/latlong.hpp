// Latitude-longitude coordinates of directions: row 0 at +y, v = acos(y) / pi, u = 1/2 + atan2(z, x) / (2 pi).
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/spherical.hpp"

#include <concepts>

namespace lumis::LUMIS_ISA {

// (u, v) of a direction, of any length whose square is in range; both in [0, 1], and NaN for a NaN. The angle to +y is the
// arc tangent of sqrt(x^2 + z^2) over y, not acos(y): near the poles a float y has no digits left.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline glm::vec<2, R> latlong_from_direction(const Direction<R>& w) noexcept {
    const R u = real::rounded(scalar_of<R>(0.5) + signed_turn_of(w.x, w.z));
    const R v = 2 * signed_turn_of(w.y, real::sqrt(R(w.x * w.x + w.z * w.z)));
    return {real::select(u < 1, u, u - 1), v};
}

// The direction at u in [0, 1] whose angle to a pole has the given versine (1 - cos) in [0, 2]. pole: 1 for +y, -1 for -y.
template <Real R>
[[nodiscard]] LUMIS_HD Direction<R> direction_from_latlong(R u, std::type_identity_t<R> versine,
                                                           std::type_identity_t<R> pole) noexcept {
    const R sin_theta = sine_of_versine(versine);
    const auto circle = unit_circle(u);
    return {-sin_theta * circle.x, pole * (1 - versine), -sin_theta * circle.y};
}

}  // namespace lumis::LUMIS_ISA
