// A rough boundary between dielectrics as books have it: Snell and Fresnel with their differences, the half vector
// normalised, the Jacobian with the square of a sum of cosines of either sign (Walter et al. 2007; Pharr, Jakob and
// Humphreys 2023, section 9.7). wo is above the surface; eta is the index below over the one above.
#pragma once

#include "ggx.hpp"
#include <lumis/core/sample.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>

namespace textbook {

template <std::floating_point T>
[[nodiscard]] std::optional<Direction<T>> refracted(const Direction<T>& wo, const Direction<T>& wm, T eta) noexcept {
    const T cos_o = glm::dot(wo, wm), sin2_i = std::max(T(0), 1 - cos_o * cos_o) / (eta * eta);
    if (sin2_i >= 1) return {};
    return (cos_o / eta - std::sqrt(1 - sin2_i)) * wm - wo / eta;
}

template <std::floating_point T>
[[nodiscard]] T fresnel(T cos_o, T eta) noexcept {
    const T sin2_i = (1 - cos_o * cos_o) / (eta * eta);
    if (sin2_i >= 1) return 1;
    const T cos_i = std::sqrt(1 - sin2_i);
    const T s = (cos_o - eta * cos_i) / (cos_o + eta * cos_i), p = (eta * cos_o - cos_i) / (eta * cos_o + cos_i);
    return (s * s + p * p) / 2;
}

template <std::floating_point T>
class GgxDielectric : GgxReflection<T> {
    using Ggx = GgxReflection<T>;

  public:
    GgxDielectric(const Direction<T>& wo, const glm::vec<2, T>& alpha, T eta) noexcept : Ggx{wo, alpha}, eta_{eta} {}

    [[nodiscard]] Sample<Direction<T>, T> sample(glm::vec<3, T> u) const noexcept {
        const Direction<T>& wo = Ggx::wo_;
        const Direction<T> wm = Ggx::visible_normal({u.x, u.y});
        const T cos_o = glm::dot(wo, wm), reflectance = fresnel(cos_o, eta_);
        if (u.z < reflectance) {
            const Direction<T> wi = 2 * cos_o * wm - wo;
            if (wi.z <= 0) return {};
            return {wi, reflectance * visible(wm) / (4 * cos_o)};
        }
        const auto wi = refracted(wo, wm, eta_);
        if (!wi || wi->z >= 0) return {};
        return {*wi, (1 - reflectance) * visible(wm) * jacobian(*wi, wm)};
    }

    [[nodiscard]] T pdf(const Direction<T>& wi) const noexcept {
        const auto wm = normal(wi);
        if (!wm) return 0;
        const T reflectance = fresnel(glm::dot(Ggx::wo_, *wm), eta_);
        if (wi.z > 0) return reflectance * visible(*wm) / (4 * glm::dot(Ggx::wo_, *wm));
        return (1 - reflectance) * visible(*wm) * jacobian(wi, *wm);
    }

    // Scattered radiance per unit of irradiance.
    [[nodiscard]] T bsdf(const Direction<T>& wi) const noexcept {
        const auto wm = normal(wi);
        if (!wm) return 0;
        const Direction<T>& wo = Ggx::wo_;
        const T reflectance = fresnel(glm::dot(wo, *wm), eta_), lo = Ggx::lambda(wo), li = Ggx::lambda(wi);
        if (wi.z > 0) return reflectance * Ggx::D(*wm) / (1 + lo + li) / (4 * wo.z * wi.z);
        return (1 - reflectance) * Ggx::D(*wm) / ((1 + lo) * (1 + li)) * jacobian(wi, *wm) * glm::dot(wo, *wm) /
               std::abs(wo.z * wi.z) / (eta_ * eta_);
    }

  private:
    // The normal that mirrors or refracts wo into wi, if there is one.
    [[nodiscard]] std::optional<Direction<T>> normal(const Direction<T>& wi) const noexcept {
        const Direction<T>& wo = Ggx::wo_;
        Direction<T> wm = glm::normalize(wi.z > 0 ? wo + wi : wo + eta_ * wi);
        if (wm.z < 0) wm = -wm;
        if (glm::dot(wo, wm) <= 0 || glm::dot(wi, wm) * wi.z <= 0) return {};
        return wm;
    }

    [[nodiscard]] T visible(const Direction<T>& wm) const noexcept {
        const Direction<T>& wo = Ggx::wo_;
        return Ggx::D(wm) * glm::dot(wo, wm) / ((1 + Ggx::lambda(wo)) * wo.z);
    }

    [[nodiscard]] T jacobian(const Direction<T>& wi, const Direction<T>& wm) const noexcept {
        const T sum = glm::dot(wi, wm) + glm::dot(Ggx::wo_, wm) / eta_;
        return std::abs(glm::dot(wi, wm)) / (sum * sum);
    }

    T eta_;
};

}  // namespace textbook
