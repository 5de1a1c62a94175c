// A light at a point, seen from a reference point: the one direction to it. World space; a delta strategy. The integrand
// returns intensity / distance^2, times what the surface does with it.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"

#include <glm/geometric.hpp>

namespace lumis::LUMIS_ISA {

template <Real T = float>
class PointLight {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;  // as an area light's, so that a host's sampler keeps its dimensions aligned
    static constexpr bool is_delta = true;

    LUMIS_INLINE PointLight(const glm::vec<3, T>& position, const glm::vec<3, T>& reference_point) noexcept
        : distance_{real::length(real::rounded(position - reference_point))},
          direction_{
              real::divide(real::rounded(position - reference_point), real::divisor_where(distance_ > 0, distance_))} {
        LUMIS_ASSERT(real::all(!detail::is_nan(position) && !detail::is_nan(reference_point)));
    }

    // At distance 0, and one whose square is out of range, nothing is drawn.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE LightSample<Direction<R>, R> sample(glm::vec<2, R>) const noexcept {
        const auto is_drawn = is_squared_length(T(distance_ * distance_));
        if (!real::any(is_drawn)) return {};
        return {Direction<R>(real::select(is_drawn, direction_, Direction<T>{})), real::select(is_drawn, T(1), 0),
                real::select(is_drawn, distance_, 0)};
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>&) const noexcept {
        return T(0);
    }

  private:
    T distance_;
    Direction<T> direction_;
};

template <Real T>
PointLight(glm::vec<3, T>, glm::vec<3, T>) -> PointLight<T>;

}  // namespace lumis::LUMIS_ISA
