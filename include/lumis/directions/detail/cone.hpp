// A cone of directions about an axis, drawn evenly: what UniformCone and Sun share. It is kept as a versine and a chord, for a
// cosine has no digits for small half-angles: that of the sun, 0.00465 rad, is 1 less 181 units in the last place of a float.
#pragma once

#include "lumis/core/assert.hpp"
#include "lumis/core/elementary.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/spherical.hpp"

#include <limits>
#include <numbers>

namespace lumis::LUMIS_ISA::detail {

template <Real T>
class Cone {
    using S = scalar_of<T>;

  public:
    // half_angle: in radians; beyond pi it is pi. Nothing is drawn of a cone that is not open, or not there.
    LUMIS_INLINE Cone(T half_angle, const MaskOf<T>& is_there) noexcept {
        LUMIS_ASSERT(real::all(!is_nan(half_angle)));
        const auto is_open = is_there && half_angle > 0;
        const T angle = real::select(is_open, real::lesser(T(std::numbers::pi_v<S>), half_angle), 0);
        const T sine = half_circle(T(angle * (std::numbers::inv_pi_v<S> / 4))).y;
        versine_ = real::lesser(T(2 * sine * sine), 2);
        pdf_ = density_or_zero(real::quotient_where(versine_ > 0, T(std::numbers::inv_pi_v<S> / 2), versine_));
        chord_ = real::select(pdf_ > 0, 2 * sine + 8 * std::numeric_limits<S>::epsilon(), -1);
    }

    [[nodiscard]] LUMIS_HD T solid_angle() const noexcept { return 2 * std::numbers::pi_v<S> * versine_; }
    // sin^2(half_angle) pi; of a cone wider than a hemisphere all of the hemisphere's.
    [[nodiscard]] LUMIS_HD T projected_solid_angle() const noexcept {
        const T versine = real::lesser(versine_, 1);
        return std::numbers::pi_v<S> * versine * (2 - versine);
    }
    [[nodiscard]] LUMIS_HD T pdf() const noexcept { return pdf_; }

    // About +z; u.x = 0 is the axis.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE Direction<R> sample(const glm::vec<2, R>& u) const noexcept {
        return direction_at(R(u.x * versine_), u.y);
    }

    // Whether a unit vector less the axis is that of a direction in the cone. The rim gives way by the rounding of the vector,
    // so that a direction drawn there is found in it.
    template <Real R>
    [[nodiscard]] LUMIS_HD MaskOf<R> contains(const Direction<R>& from_axis) const noexcept {
        return real::length(from_axis) <= R(chord_);
    }

    // The u.x of such a difference.
    [[nodiscard]] LUMIS_HD T invert(const Direction<T>& from_axis) const noexcept {
        return real::quotient_where(versine_ > 0, T(detail::dot(from_axis, from_axis)), T(2 * versine_));
    }

  private:
    T versine_;  // 1 - cos(half_angle)
    T pdf_;
    T chord_;  // the longest of a difference between a direction in the cone and its axis
};

}  // namespace lumis::LUMIS_ISA::detail
