// Directions within an angle of +z with the constant density 1 / (2 pi (1 - cos(half_angle))) per solid angle. Local frame.
// Archimedes' map on a cap (Pharr, Jakob and Humphreys 2023, section A.5.4), by the cap's height 2 sin^2(half_angle / 2): the
// textbook's 1 - cos(half_angle) is wrong by 0.2 % for the sun in float, and 0 below 0.00024 rad.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/directions/detail/cone.hpp"

namespace lumis::LUMIS_ISA {

template <Real T = float>
class UniformCone {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    // half_angle: in radians, in (0, pi]; a larger one is pi. One that is not positive draws nothing, nor does one so small
    // that the density is out of range.
    LUMIS_INLINE explicit UniformCone(T half_angle) noexcept : cone_{half_angle, MaskOf<T>(true)} {}

    // u.x = 1 - cos(theta) over its largest, u.y = phi / 2 pi.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE Sample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        return {cone_.sample(u), cone_.pdf()};
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& w) const noexcept {
        return real::select(cone_.contains(from_axis(w)), R(cone_.pdf()), 0);
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& w) const noexcept {
        return {cone_.invert(from_axis(w)), turn_of(w.x, w.y)};
    }

    [[nodiscard]] LUMIS_HD T solid_angle() const noexcept { return cone_.solid_angle(); }

  private:
    template <Real R>
    [[nodiscard]] LUMIS_HD static Direction<R> from_axis(const Direction<R>& w) noexcept {
        return {w.x, w.y, real::rounded(R(w.z - 1))};
    }

    detail::Cone<T> cone_;
};

}  // namespace lumis::LUMIS_ISA
