// The GGX (Trowbridge-Reitz) distribution of microfacet normals, anisotropic, with height-correlated Smith shadowing.
// Local frame, +z the shading normal. Walter et al. 2007; Heitz 2014, "Understanding the Masking-Shadowing Function".
#pragma once

#include "lumis/core/sample.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

namespace lumis {

// Roughness is raised to this, each axis alone: below it a float direction cannot resolve the lobe (at 1e-4 its last
// place moves the density by 0.1 %). For a smoother surface use PerfectReflection.
inline constexpr float ggx_min_alpha = 1e-4f;
// Beyond this a roughness is out of range, as are negative and NaN ones: D, G1 and every density built on them are 0.
inline constexpr float ggx_max_alpha = 1e4f;

template <std::floating_point T = float>
class Ggx {
  public:
    // Roughness along x and y.
    explicit Ggx(glm::vec<2, T> alpha) noexcept : alpha_{in_range(alpha.x), in_range(alpha.y)} {
        if (!(alpha_.x * alpha_.y > 0)) alpha_ = {T(0), T(0)};
    }

    // After raising; (0, 0) if out of range.
    [[nodiscard]] const glm::vec<2, T>& alpha() const noexcept { return alpha_; }

    // Density of normals per unit of projected area and solid angle: integral of D(wm) wm.z is 1. Heitz 2014, eq. 85.
    [[nodiscard]] T D(const Direction<T>& wm) const noexcept {
        const T x = wm.x / alpha_.x, y = wm.y / alpha_.y;
        const T s = x * x + y * y + wm.z * wm.z;
        const T d = std::numbers::inv_pi_v<T> / (alpha_.x * alpha_.y * s * s);
        return wm.z > 0 ? density_or_zero(d) : T(0);
    }

    // Length of w stretched by the roughness: (alpha.x w.x, alpha.y w.y, w.z). All of Smith's terms follow from it.
    [[nodiscard]] T stretched_length(const Direction<T>& w) const noexcept {
        const T x = alpha_.x * w.x, y = alpha_.y * w.y;
        return std::sqrt(x * x + y * y + w.z * w.z);
    }

    // Smith's Lambda, of |w.z|; infinite at grazing. The textbook (-1 + sqrt(1 + a^2 tan^2)) / 2 loses all digits for
    // a tan(theta) < 2e-4 in float.
    [[nodiscard]] T lambda(const Direction<T>& w) const noexcept {
        const T x = alpha_.x * w.x, y = alpha_.y * w.y, z = std::abs(w.z);
        const T slope = x * x + y * y;
        return slope > 0 ? slope / (2 * z * (z + std::sqrt(slope + z * z))) : T(0);
    }

    // Fraction of a microfacet's area visible from w, 1 / (1 + Lambda); 0 from below. Heitz 2014, eq. 43.
    [[nodiscard]] T G1(const Direction<T>& w) const noexcept {
        return w.z > 0 && valid() ? 2 * w.z / (w.z + stretched_length(w)) : T(0);
    }

    // 1 / (1 + Lambda(wo) + Lambda(wi)), height-correlated; 0 from below. Heitz 2014, eq. 99.
    [[nodiscard]] T G2(const Direction<T>& wo, const Direction<T>& wi) const noexcept {
        return 4 * wo.z * wi.z * visibility(wo, wi);
    }

    // Reflected radiance per unit of irradiance, D G2 / (4 cos cos), with Fresnel reflectance 1; 0 from below.
    [[nodiscard]] T brdf(const Direction<T>& wo, const Direction<T>& wi) const noexcept {
        const Direction<T> half = wo + wi;
        return D(half / glm::length(half)) * visibility(wo, wi);
    }

  private:
    static T in_range(T alpha) noexcept {
        return alpha >= 0 && alpha <= T(ggx_max_alpha) ? std::max(alpha, T(ggx_min_alpha)) : T(0);
    }
    [[nodiscard]] bool valid() const noexcept { return alpha_.x > 0; }

    // G2 / (4 wo.z wi.z), with the cosines cancelled by hand so that grazing directions divide nothing by 0.
    [[nodiscard]] T visibility(const Direction<T>& wo, const Direction<T>& wi) const noexcept {
        if (!(wo.z > 0 && wi.z > 0 && valid())) return T(0);
        return T(1) / (2 * (wo.z * stretched_length(wi) + wi.z * stretched_length(wo)));
    }

    glm::vec<2, T> alpha_;
};

}  // namespace lumis
