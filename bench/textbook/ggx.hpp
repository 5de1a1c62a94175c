// Reflection by a GGX surface as books have it: D with its squares (Walter et al. 2007), Lambda from the tangent (Heitz
// 2014), visible normals by the published listing of Dupuy and Benyoub 2023, the quickest that is published, and
// sample, density and reflectance as three functions that each start from their directions.
#pragma once

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
class GgxReflection {
  public:
    GgxReflection(const Direction<T>& wo, const glm::vec<2, T>& alpha) noexcept : wo_{wo}, alpha_{alpha} {}

    [[nodiscard]] Sample<Direction<T>, T> sample(glm::vec<2, T> u) const noexcept {
        const Direction<T> wm = visible_normal(u);
        const Direction<T> wi = 2 * glm::dot(wo_, wm) * wm - wo_;
        if (wi.z <= 0) return {};
        return {wi, reflected_density(wm)};
    }

    [[nodiscard]] T pdf(const Direction<T>& wi) const noexcept {
        if (wi.z <= 0) return 0;
        return reflected_density(glm::normalize(wo_ + wi));
    }

    // D G2 / (4 cos cos).
    [[nodiscard]] T brdf(const Direction<T>& wi) const noexcept {
        if (wi.z <= 0) return 0;
        const Direction<T> wm = glm::normalize(wo_ + wi);
        return D(wm) / (1 + lambda(wo_) + lambda(wi)) / (4 * wo_.z * wi.z);
    }

  protected:
    [[nodiscard]] T D(const Direction<T>& wm) const noexcept {
        const T x = wm.x / alpha_.x, y = wm.y / alpha_.y, s = x * x + y * y + wm.z * wm.z;
        return 1 / (std::numbers::pi_v<T> * alpha_.x * alpha_.y * s * s);
    }

    // a^2 tan^2 is (alpha.x^2 x^2 + alpha.y^2 y^2) / z^2: no angle is needed.
    [[nodiscard]] T lambda(const Direction<T>& w) const noexcept {
        const T x = alpha_.x * w.x, y = alpha_.y * w.y;
        return (std::sqrt(1 + (x * x + y * y) / (w.z * w.z)) - 1) / 2;
    }

    // The density of wi: that of the visible normal, G1 D |wo.wm| / cos, over 4 |wo.wm|.
    [[nodiscard]] T reflected_density(const Direction<T>& wm) const noexcept {
        return D(wm) / ((1 + lambda(wo_)) * 4 * wo_.z);
    }

    [[nodiscard]] Direction<T> visible_normal(glm::vec<2, T> u) const noexcept {
        const Direction<T> wo_std = glm::normalize(Direction<T>{alpha_.x * wo_.x, alpha_.y * wo_.y, wo_.z});
        const T phi = 2 * std::numbers::pi_v<T> * u.y;
        const T z = (1 - u.x) * (1 + wo_std.z) - wo_std.z;
        const T sin_theta = std::sqrt(std::clamp(1 - z * z, T(0), T(1)));
        const Direction<T> half = Direction<T>{sin_theta * std::cos(phi), sin_theta * std::sin(phi), z} + wo_std;
        return glm::normalize(Direction<T>{alpha_.x * half.x, alpha_.y * half.y, half.z});
    }

    Direction<T> wo_;
    glm::vec<2, T> alpha_;
};

}  // namespace textbook
