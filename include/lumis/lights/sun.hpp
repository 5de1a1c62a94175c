// A disk of light infinitely far away, as sun and moon are: a cone of directions, drawn evenly. World space, density per solid
// angle. Shadows get the sun's soft edges; where those do not matter, DirectionalLight is the same light without them.
//
//     const Sun sun{direction, 0.00465f};                  // the half-angle of ours, in radians
//     const float radiance = irradiance / sun.projected_solid_angle();
#pragma once

#include "lumis/core/frame.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/directions/detail/cone.hpp"

#include <limits>
#include <type_traits>

namespace lumis::LUMIS_ISA {

template <Real T = float>
class Sun {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    // direction: unit, towards the centre; of one that is none nothing is drawn. half_angle: as UniformCone's.
    LUMIS_INLINE Sun(const Direction<T>& direction, std::type_identity_t<T> half_angle) noexcept
        : Sun{detail::unit_or(direction, 0), half_angle, detail::is_unit(detail::unit_or(direction, 0))} {
        LUMIS_ASSERT(real::all(detail::is_unit(direction)));
    }

    // u.x = 0 is the centre, u.y the turn about it. The distance is infinite.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE LightSample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        return {frame_.to_world(cone_.sample(u)), cone_.pdf(), infinity};
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& w) const noexcept {
        return real::select(cone_.contains(from_axis(w)), R(cone_.pdf()), 0);
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R distance_along(const Direction<R>& /*w*/) const noexcept {
        return infinity;
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& w) const noexcept {
        const Direction<T> local = frame_.to_local(w);
        return {cone_.invert(from_axis(w)), turn_of(local.x, local.y)};
    }

    [[nodiscard]] LUMIS_HD T solid_angle() const noexcept { return cone_.solid_angle(); }

    // The irradiance that radiance 1 makes on a plane which faces the sun: pi sin^2(half_angle), for at most half of all
    // directions.
    [[nodiscard]] LUMIS_HD T projected_solid_angle() const noexcept { return cone_.projected_solid_angle(); }

  private:
    static constexpr scalar_of<T> infinity = std::numeric_limits<scalar_of<T>>::infinity();

    LUMIS_INLINE Sun(const Direction<T>& direction, T half_angle, const MaskOf<T>& has_direction) noexcept
        : frame_{real::select(has_direction, direction, Direction<T>{T(0), T(0), T(1)})},
          cone_{half_angle, has_direction} {}

    // The cosine between w and the axis has no digits left of a small angle; their difference has.
    template <Real R>
    [[nodiscard]] LUMIS_HD Direction<R> from_axis(const Direction<R>& w) const noexcept {
        return real::rounded(w - Direction<R>(frame_.normal()));
    }

    Frame<T> frame_;
    detail::Cone<T> cone_;
};

}  // namespace lumis::LUMIS_ISA
