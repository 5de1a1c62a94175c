// Henyey and Greenstein's phase function (1941) about +z: a narrow peak on a broad base, which no chart suits well.
#pragma once

#include <lumis/core/spherical.hpp>
#include <lumis/core/strategy.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <numbers>

template <std::floating_point T>
struct HenyeyGreensteinLobe {
    using Scalar = T;
    using Point = lumis::Direction<T>;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;

    T g;  // the mean cosine, in (0, 1)

    lumis::Sample<Point, T> sample(glm::vec<2, T> u) const noexcept {
        const T a = (1 - g) * (1 + g) / (1 - g + 2 * g * u.x);
        const T versine = (a - (1 - g)) * (a + (1 - g)) / (2 * g);
        const Point w = lumis::direction_at(std::clamp(versine, T(0), T(2)), u.y);
        return {w, pdf(w)};
    }
    T pdf(const Point& w) const noexcept {
        const T d = (1 - g) * (1 - g) + 2 * g * lumis::versine_of(w);
        return lumis::density_or_zero((1 - g) * (1 + g) / (4 * std::numbers::pi_v<T> * d * std::sqrt(d)));
    }
};
