// Directions about +z with density cos(theta) / pi per solid angle: importance sampling of a Lambertian surface.
// Local frame. Malley's method on polar coordinates of the disk (Pharr, Jakob and Humphreys 2023, section A.5.3).
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/spherical.hpp"
#include "lumis/core/strategy.hpp"

#include <concepts>
#include <numbers>

namespace lumis::LUMIS_ISA {

template <Real T = float>
struct CosineHemisphere {
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    // u.x = sin^2(theta), u.y = phi / 2 pi. z = sqrt(1 - u.x) has no cancellation; u.x == 1 draws nothing.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD Sample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        const R radius = real::sqrt(u.x);
        const auto circle = unit_circle(u.y);
        const R z = real::sqrt(R(1 - u.x));
        return {{radius * circle.x, radius * circle.y, z}, z * std::numbers::inv_pi_v<scalar_of<T>>};
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& w) const noexcept {
        return density_or_zero(R(w.z * std::numbers::inv_pi_v<scalar_of<T>>));
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& w) const noexcept {
        return {w.x * w.x + w.y * w.y, turn_of(w.x, w.y)};
    }
};

}  // namespace lumis::LUMIS_ISA
