// A light infinitely far away in one direction, as the sun nearly is. World space; a delta strategy. The integrand returns
// the irradiance on a surface that faces the light, times what the surface does with it.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"

#include <limits>

namespace lumis::LUMIS_ISA {

template <Real T = float>
class DirectionalLight {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions =
        2;  // as an environment map's, so that a host's sampler keeps its dimensions aligned
    static constexpr bool is_delta = true;

    // direction: unit, towards the light.
    LUMIS_INLINE constexpr explicit DirectionalLight(const Direction<T>& direction) noexcept
        : direction_{detail::unit_or(direction, 0)} {
        LUMIS_ASSERT(real::all(detail::is_unit(direction)));
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE constexpr LightSample<Direction<R>, R> sample(glm::vec<2, R>) const noexcept {
        const auto is_drawn = detail::is_unit(direction_);
        return {Direction<R>(direction_), real::select(is_drawn, T(1), 0),
                std::numeric_limits<scalar_of<T>>::infinity()};
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD constexpr R pdf(const Direction<R>&) const noexcept {
        return T(0);
    }

  private:
    Direction<T> direction_;
};

}  // namespace lumis::LUMIS_ISA
