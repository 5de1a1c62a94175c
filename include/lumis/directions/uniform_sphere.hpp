// All directions with the constant density 1 / (4 pi) per solid angle.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/spherical.hpp"
#include "lumis/core/strategy.hpp"

#include <concepts>
#include <numbers>

namespace lumis::LUMIS_ISA {

template <Real T = float>
struct UniformSphere {
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    // u.x = (1 - cos(theta)) / 2, u.y = phi / 2 pi.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD Sample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        return {direction_at(R(2 * u.x), u.y), std::numbers::inv_pi_v<scalar_of<T>> / 4};
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& /*w*/) const noexcept {
        return std::numbers::inv_pi_v<scalar_of<T>> / 4;
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& w) const noexcept {
        return {versine_of(w) / 2, turn_of(w.x, w.y)};
    }
};

}  // namespace lumis::LUMIS_ISA
