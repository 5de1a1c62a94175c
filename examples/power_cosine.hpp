// A strategy of one's own: a cosine lobe to the power of n about +z. The tests ask every law of it.
#pragma once

#include <lumis/core/spherical.hpp>
#include <lumis/core/strategy.hpp>

#include <cmath>
#include <concepts>
#include <numbers>

// Density (n + 1) / (2 pi) cos^n(theta) per solid angle, local frame.
template <std::floating_point T = float>
struct PowerCosine {
    using Scalar = T;
    using Point = lumis::Direction<T>;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;

    T n;

    // cos(theta) = (1 - u.x)^(1 / (n + 1)), as 1 - cos(theta): near the pole, where a narrow lobe lies, the cosine itself has
    // no digits left.
    lumis::Sample<Point, T> sample(glm::vec<2, T> u) const noexcept {
        const T versine = u.x < 1 ? -std::expm1(std::log1p(-u.x) / (n + 1)) : T(1);
        const Point w = lumis::direction_at(versine, u.y);
        return {w, pdf(w)};
    }
    // 0 below the horizon, and for what is no direction: the power of a component beyond 1 may overflow.
    T pdf(const Point& w) const noexcept {
        if (!(w.z > 0)) return 0;
        return lumis::density_or_zero((n + 1) * std::numbers::inv_pi_v<T> / 2 * std::pow(w.z, n));
    }
};
template <std::floating_point T>
PowerCosine(T) -> PowerCosine<T>;
