// The GGX (Trowbridge-Reitz) distribution of microfacet normals, anisotropic, with Smith shadowing: height-correlated
// unless separable is asked for.
// Local frame, +z the shading normal. Walter et al. 2007; Heitz 2014, "Understanding the Masking-Shadowing Function".
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/sample.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <type_traits>

namespace lumis::LUMIS_ISA {

// Roughness is raised to this, each axis alone: below it a float direction cannot resolve the lobe (at 1e-4 its last
// place moves the density by 0.1 %). For a smoother surface use PerfectReflection.
inline constexpr float ggx_min_alpha = 1e-4f;
// Beyond this a roughness is out of range, as are negative and NaN ones: D, G1 and every density built on them are 0.
inline constexpr float ggx_max_alpha = 1e4f;

namespace detail {

// One roughness for both axes, any number of which is converted.
template <Real T, std::convertible_to<T> Roughness>
[[nodiscard]] LUMIS_HD glm::vec<2, T> on_both_axes(Roughness alpha) noexcept {
    if constexpr (std::is_arithmetic_v<Roughness>) {
        return glm::vec<2, T>{T(static_cast<scalar_of<T>>(alpha))};
    } else {
        return glm::vec<2, T>{T(alpha)};
    }
}

}  // namespace detail

template <Real T = float>
class Ggx {
  public:
    // Roughness along x and y.
    LUMIS_INLINE explicit Ggx(glm::vec<2, T> alpha) noexcept : alpha_{in_range(alpha.x), in_range(alpha.y)} {
        LUMIS_ASSERT(real::all(!detail::is_nan(alpha)));
        const auto valid = alpha_.x * alpha_.y > 0;
        if (real::all(!valid)) {
            alpha_ = {T(0), T(0)};
            return;
        }
        inverse_alpha_ = {real::select(valid, real::divide(T(1), alpha_.x), 0),
                          real::select(valid, real::divide(T(1), alpha_.y), 0)};
        alpha_ = {real::select(valid, alpha_.x, 0), real::select(valid, alpha_.y, 0)};
    }

    // One roughness for both axes.
    LUMIS_INLINE explicit Ggx(T alpha) noexcept : Ggx{glm::vec<2, T>{alpha}} {}

    // After raising; (0, 0) if out of range.
    [[nodiscard]] LUMIS_HD const glm::vec<2, T>& alpha() const noexcept { return alpha_; }

    // Density of normals per unit of projected area and solid angle: integral of D(wm) wm.z is 1. Heitz 2014, eq. 85.
    // wm may have any length, which cancels: a half vector need not be normalised.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R D(const Direction<R>& wm) const noexcept {
        const R x = wm.x * inverse_alpha_.x, y = wm.y * inverse_alpha_.y;
        const R stretched = x * x + y * y + wm.z * wm.z;
        const R shrinkage = real::divide(R(glm::dot(wm, wm)), real::divisor_where(stretched > 0, stretched));
        const T peak = std::numbers::inv_pi_v<scalar_of<T>> * inverse_alpha_.x * inverse_alpha_.y;
        return real::select(wm.z > 0, peak * shrinkage * shrinkage, 0);
    }

    // Length of w stretched by the roughness: (alpha.x w.x, alpha.y w.y, w.z). All of Smith's terms follow from it.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R stretched_length(const Direction<R>& w) const noexcept {
        const R x = alpha_.x * w.x, y = alpha_.y * w.y;
        return real::sqrt(R(x * x + y * y + w.z * w.z));
    }

    // Smith's Lambda, of |w.z|; infinite at grazing. The textbook (-1 + sqrt(1 + a^2 tan^2)) / 2 loses all digits for
    // a tan(theta) < 2e-4 in float.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R lambda(const Direction<R>& w) const noexcept {
        const R x = alpha_.x * w.x, y = alpha_.y * w.y, z = real::abs(w.z);
        const R slope = x * x + y * y, divisor = 2 * z * (z + real::sqrt(R(slope + z * z)));
        const R quotient = real::divide(slope, real::divisor_where(divisor > 0, divisor));
        const R grazing{std::numeric_limits<T>::infinity()};
        return real::select(slope > 0, real::select(divisor > 0, quotient, grazing), 0);
    }

    // Fraction of a microfacet's area visible from w, 1 / (1 + Lambda); 0 from below. Heitz 2014, eq. 43.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R G1(const Direction<R>& w) const noexcept {
        return real::quotient_where(w.z > 0 && valid(), R(2 * w.z), R(w.z + stretched_length(w)));
    }

    // 1 / (1 + Lambda(wo) + Lambda(wi)), height-correlated; 0 from below. Heitz 2014, eq. 99.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R G2(const Direction<T>& wo, const Direction<R>& wi) const noexcept {
        return 4 * wo.z * wi.z * visibility(wo, wi);
    }

    // Reflected radiance per unit of irradiance, D G2 / (4 cos cos), with Fresnel reflectance 1; 0 from below.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R brdf(const Direction<T>& wo, const Direction<R>& wi) const noexcept {
        return D<R>(Direction<R>(wo) + wi) * visibility(wo, wi);
    }

    // The same with separable shadowing, G1(wo) G1(wi), for hosts whose pictures are made with it. It takes masking and
    // shadowing for independent, and so is a little darker. Walter et al. 2007, eq. 23; Heitz 2014, eq. 98.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R G2_separable(const Direction<T>& wo, const Direction<R>& wi) const noexcept {
        return G1(wo) * G1<R>(wi);
    }
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R brdf_separable(const Direction<T>& wo, const Direction<R>& wi) const noexcept {
        return D<R>(Direction<R>(wo) + wi) * visibility_separable(wo, wi);
    }

    // The G2 of either kind over 4 cos cos, with the cosines cancelled by hand so that grazing directions divide nothing by
    // 0; 0 from below.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R visibility(const Direction<T>& wo, const Direction<R>& wi) const noexcept {
        const auto seen = wo.z > 0 && valid();
        if (real::all(!seen)) return 0;
        const R divisor = wo.z * stretched_length(wi) + wi.z * stretched_length(wo);
        return real::quotient_where(seen && wi.z > 0 && divisor > 0, R(scalar_of<R>(0.5)), divisor);
    }
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R visibility_separable(const Direction<T>& wo, const Direction<R>& wi) const noexcept {
        const R divisor = (wo.z + stretched_length(wo)) * (wi.z + stretched_length(wi));
        return real::quotient_where(wo.z > 0 && valid() && wi.z > 0, R(scalar_of<R>(1)), divisor);
    }

  private:
    LUMIS_HD static T in_range(T alpha) noexcept {
        using Number = scalar_of<T>;
        return real::select(alpha >= 0 && alpha <= Number(ggx_max_alpha), real::greater(alpha, Number(ggx_min_alpha)),
                            0);
    }
    [[nodiscard]] LUMIS_HD MaskOf<T> valid() const noexcept { return alpha_.x > 0; }

    glm::vec<2, T> alpha_;
    glm::vec<2, T> inverse_alpha_{};  // 0 if out of range
};

}  // namespace lumis::LUMIS_ISA
