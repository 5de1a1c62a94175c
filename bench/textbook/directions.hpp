// Directions as books have them: sine and cosine of 2 pi u by the standard library, 1 - cos as a difference.
// Pharr, Jakob and Humphreys 2023, "Physically Based Rendering", sections A.5 and A.5.3. Same uniforms, same directions
// as the strategies of Lumis, so that only the arithmetic differs.
#pragma once

#include <lumis/core/frame.hpp>
#include <lumis/core/sample.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <numbers>

namespace textbook {

using lumis::Direction;
using lumis::Sample;

template <std::floating_point T>
[[nodiscard]] Direction<T> from_spherical(T cos_theta, T sin_theta, T phi) noexcept {
    return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
}

// Malley's method on polar coordinates of the disk. Shirley and Chiu's concentric map, below, is the slower of the two.
template <std::floating_point T>
struct CosineHemisphere {
    [[nodiscard]] Sample<Direction<T>, T> sample(glm::vec<2, T> u) const noexcept {
        const T radius = std::sqrt(u.x), phi = 2 * std::numbers::pi_v<T> * u.y;
        const T x = radius * std::cos(phi), y = radius * std::sin(phi);
        const T z = std::sqrt(std::max(T(0), 1 - x * x - y * y));
        return {{x, y, z}, z * std::numbers::inv_pi_v<T>};
    }
    [[nodiscard]] T pdf(const Direction<T>& w) const noexcept {
        return std::max(w.z, T(0)) * std::numbers::inv_pi_v<T>;
    }
};

template <std::floating_point T>
struct ConcentricCosineHemisphere : CosineHemisphere<T> {
    [[nodiscard]] Sample<Direction<T>, T> sample(glm::vec<2, T> u) const noexcept {
        const T a = 2 * u.x - 1, b = 2 * u.y - 1;
        constexpr T pi = std::numbers::pi_v<T>;
        T radius = 0, phi = 0;
        if (std::abs(a) > std::abs(b)) {
            radius = a, phi = pi / 4 * (b / a);
        } else if (b != 0) {
            radius = b, phi = pi / 2 - pi / 4 * (a / b);
        }
        const T x = radius * std::cos(phi), y = radius * std::sin(phi);
        const T z = std::sqrt(std::max(T(0), 1 - x * x - y * y));
        return {{x, y, z}, z * std::numbers::inv_pi_v<T>};
    }
};

template <std::floating_point T>
struct UniformHemisphere {
    [[nodiscard]] Sample<Direction<T>, T> sample(glm::vec<2, T> u) const noexcept {
        const T z = 1 - u.x;
        return {from_spherical(z, std::sqrt(std::max(T(0), 1 - z * z)), 2 * std::numbers::pi_v<T> * u.y), density};
    }
    [[nodiscard]] T pdf(const Direction<T>& w) const noexcept { return w.z > 0 ? density : T(0); }

    static constexpr T density = std::numbers::inv_pi_v<T> / 2;
};

template <std::floating_point T>
struct UniformSphere {
    [[nodiscard]] Sample<Direction<T>, T> sample(glm::vec<2, T> u) const noexcept {
        const T z = 1 - 2 * u.x;
        return {from_spherical(z, std::sqrt(std::max(T(0), 1 - z * z)), 2 * std::numbers::pi_v<T> * u.y), density};
    }
    [[nodiscard]] T pdf(const Direction<T>&) const noexcept { return density; }

    static constexpr T density = std::numbers::inv_pi_v<T> / 4;
};

// Section A.5.4.
template <std::floating_point T>
struct UniformCone {
    T cos_theta_max;

    [[nodiscard]] Sample<Direction<T>, T> sample(glm::vec<2, T> u) const noexcept {
        const T z = (1 - u.x) + u.x * cos_theta_max;
        return {from_spherical(z, std::sqrt(std::max(T(0), 1 - z * z)), 2 * std::numbers::pi_v<T> * u.y), density()};
    }
    [[nodiscard]] T pdf(const Direction<T>& w) const noexcept { return w.z >= cos_theta_max ? density() : T(0); }

    [[nodiscard]] T density() const noexcept { return 1 / (2 * std::numbers::pi_v<T> * (1 - cos_theta_max)); }
};

// Pharr, Jakob and Humphreys 2023, section 11.3.1: the cosine as a difference over 2 g, and evenly for small g. wo points away
// from the point.
template <std::floating_point T>
struct HenyeyGreenstein {
    Direction<T> wo;
    T g;

    [[nodiscard]] Sample<Direction<T>, T> sample(glm::vec<2, T> u) const noexcept {
        T cos_theta = 1 - 2 * u.x;
        if (std::abs(g) >= T(1e-3)) {
            const T root = (1 - g * g) / (1 + g - 2 * g * u.x);
            cos_theta = -1 / (2 * g) * (1 + g * g - root * root);
        }
        const T sin_theta = std::sqrt(std::max(T(0), 1 - cos_theta * cos_theta));
        const Direction<T> local = from_spherical(cos_theta, sin_theta, 2 * std::numbers::pi_v<T> * u.y);
        return {lumis::Frame<T>{wo}.to_world(local), density(cos_theta)};
    }
    [[nodiscard]] T pdf(const Direction<T>& wi) const noexcept { return density(glm::dot(wo, wi)); }

    // cos_theta: between wo and wi, both away from the point.
    [[nodiscard]] T density(T cos_theta) const noexcept {
        const T d = 1 + g * g + 2 * g * cos_theta;
        return std::numbers::inv_pi_v<T> / 4 * (1 - g * g) / (d * std::sqrt(std::max(T(0), d)));
    }
};

}  // namespace textbook
