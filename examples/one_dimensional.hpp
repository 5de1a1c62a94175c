// Strategies and problems on the line, small enough to know everything about in closed form.
#pragma once

#include <lumis/core/strategy.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

// Evenly over [low, high].
template <std::floating_point T = double>
struct Interval {
    using Scalar = T;
    using Point = T;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    T low, high;

    [[nodiscard]] lumis::Sample<T, T> sample(glm::vec<1, T> u) const noexcept {
        const T x = std::min(low + u.x * (high - low), high);
        return {x, pdf(x)};
    }
    [[nodiscard]] T pdf(T x) const noexcept { return x >= low && x <= high ? 1 / (high - low) : T(0); }
};

// Density 1/2 + x over [0, 1].
template <std::floating_point T = double>
struct Ramp {
    using Scalar = T;
    using Point = T;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    [[nodiscard]] lumis::Sample<T, T> sample(glm::vec<1, T> u) const noexcept {
        const T x = std::min(4 * u.x / (1 + std::sqrt(1 + 8 * u.x)), T(1));
        return {x, pdf(x)};
    }
    [[nodiscard]] T pdf(T x) const noexcept { return x >= 0 && x <= 1 ? T(0.5) + x : T(0); }
};

// The normal distribution (Box and Muller 1958).
template <std::floating_point T = double>
struct Gaussian {
    using Scalar = T;
    using Point = T;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 2;

    T mean, deviation;

    [[nodiscard]] lumis::Sample<T, T> sample(glm::vec<2, T> u) const noexcept {
        const T radius = std::sqrt(-2 * std::log(std::max(1 - u.x, std::numeric_limits<T>::min())));
        const T x = mean + deviation * radius * std::cos(2 * std::numbers::pi_v<T> * u.y);
        return {x, pdf(x)};
    }
    [[nodiscard]] T pdf(T x) const noexcept {
        const T z = (x - mean) / deviation;
        const T scale = std::numbers::inv_sqrtpi_v<T> / (deviation * std::numbers::sqrt2_v<T>);
        return lumis::density_or_zero(std::exp(-z * z / 2) * scale);
    }
};

// 8 below 0.9, 80 above; a technique that only knows [0.9, 1] is blind to nine tenths of it.
struct Step {
    static constexpr double integral = 15.2;
    static constexpr double integral_above = 8;

    template <std::floating_point T>
    T operator()(T x) const noexcept {
        return x < T(0.9) ? T(8) : T(80);
    }
};
inline constexpr Interval<double> everywhere{0, 1};
inline constexpr Interval<double> above{0.9, 1};

// A broad and a narrow bump on [0, 1]. A Gaussian that fits the narrow one alone almost never meets the other.
struct TwoBumps {
    static double bump(double x, double center, double width) noexcept {
        const double z = (x - center) / width;
        return std::exp(-z * z);
    }
    static double bump_integral(double center, double width) noexcept {
        return width / (2 * std::numbers::inv_sqrtpi) * (std::erf((1 - center) / width) + std::erf(center / width));
    }

    double operator()(double x) const noexcept {
        return x >= 0 && x <= 1 ? bump(x, 0.3, 0.25) + 3 * bump(x, 0.7, 0.05) : 0.0;
    }
    static double integral() noexcept { return bump_integral(0.3, 0.25) + 3 * bump_integral(0.7, 0.05); }
};
inline constexpr Gaussian<double> too_narrow{0.7, 0.1};
