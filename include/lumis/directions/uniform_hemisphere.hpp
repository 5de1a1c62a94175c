// Directions about +z with the constant density 1 / (2 pi) per solid angle. Local frame.
// Archimedes' map: the height is uniform (Pharr, Jakob and Humphreys 2023, section A.5.2).
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/spherical.hpp"
#include "lumis/core/strategy.hpp"

#include <concepts>
#include <numbers>

namespace lumis::LUMIS_ISA {

template <Real T = float>
struct UniformHemisphere {
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    // u.x = 1 - cos(theta), u.y = phi / 2 pi; u.x == 1 draws nothing.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD Sample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        Sample<Direction<R>, R> drawn{direction_at(u.x, u.y)};
        drawn.pdf = pdf(drawn.value);
        return drawn;
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& w) const noexcept {
        return real::select(w.z > 0, R(std::numbers::inv_pi_v<scalar_of<T>> / 2), 0);
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& w) const noexcept {
        return {versine_of(w), turn_of(w.x, w.y)};
    }
};

}  // namespace lumis::LUMIS_ISA
