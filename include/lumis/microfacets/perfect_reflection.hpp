// The one direction into which a mirror reflects wo. Local frame; a delta strategy: no density, probability 1.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"

namespace lumis::LUMIS_ISA {

template <Real T = float>
class PerfectReflection {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;  // as its glossy kin, so that a host's sampler keeps its dimensions aligned
    static constexpr bool is_delta = true;

    // wo: unit; on or below the horizon nothing is drawn.
    LUMIS_HD constexpr explicit PerfectReflection(const Direction<T>& wo) noexcept : wo_{above_horizon_or_zero(wo)} {}

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD constexpr Sample<Direction<R>, R> sample(glm::vec<2, R>) const noexcept {
        return {{-wo_.x, -wo_.y, wo_.z}, real::select(wo_.z > 0, R(scalar_of<R>(1)), 0)};
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD constexpr R pdf(const Direction<R>&) const noexcept {
        return R(scalar_of<R>(0));
    }

  private:
    Direction<T> wo_;
};

}  // namespace lumis::LUMIS_ISA
