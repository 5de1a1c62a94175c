// Reflection of wo by a GGX surface, sampled through visible normals of a bounded cap: the same lobe as GgxReflection, but
// most of the normals that would reflect below the horizon are not drawn. Local frame, density per solid angle of wi.
// Eto and Tokuyoshi 2023, "Bounded VNDF Sampling for Smith-GGX Reflections".
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/microfacets/detail/ggx_cap.hpp"
#include "lumis/microfacets/reflected.hpp"

#include <cmath>
#include <concepts>

namespace lumis::LUMIS_ISA {

namespace detail {

// By how much the cap can fall short of the visible hemisphere: 1 - k of Eto and Tokuyoshi's listing, where
// k = (1 - a^2) s^2 / (s^2 + a^2 z^2), without the cancellation.
template <Real T>
[[nodiscard]] LUMIS_HD T bounded_cap_shortfall(const Direction<T>& wo, const glm::vec<2, T>& alpha) noexcept {
    const T a = real::lesser(real::lesser(alpha.x, alpha.y), 1);
    const T s = 1 + real::sqrt(T(wo.x * wo.x + wo.y * wo.y));
    const T a2 = a * a, s2 = s * s, z2 = wo.z * wo.z;
    return real::divide(a2 * (s2 + z2), s2 + a2 * z2);
}

// A density of the normals that reflect above the horizon; of others it knows nothing.
template <Real T>
struct GgxBoundedNormals : GgxCap<T> {
    LUMIS_INLINE GgxBoundedNormals(const Direction<T>& wo, const Ggx<T>& ggx) noexcept
        : GgxCap<T>{wo, ggx, [](const auto&... seen) { return bounded_cap_shortfall(seen...); }} {}
};

}  // namespace detail

template <Real T = float>
struct GgxBoundedReflection : Reflected<detail::GgxBoundedNormals<T>> {
    // wo: unit; on or below the horizon nothing is drawn. alpha: roughness along x and y, see ggx_min_alpha.
    LUMIS_INLINE GgxBoundedReflection(const Direction<T>& wo, glm::vec<2, T> alpha) noexcept
        : Reflected<detail::GgxBoundedNormals<T>>{wo, detail::GgxBoundedNormals<T>{wo, Ggx<T>{alpha}}} {}
    // One roughness for both axes.
    template <std::convertible_to<T> Roughness>
    LUMIS_INLINE GgxBoundedReflection(const Direction<T>& wo, Roughness alpha) noexcept
        : GgxBoundedReflection{wo, detail::on_both_axes<T>(alpha)} {}

    // The surface, for its reflectance: ggx().brdf(wo, wi).
    [[nodiscard]] LUMIS_HD const Ggx<T>& ggx() const noexcept { return this->normals().ggx(); }
};

}  // namespace lumis::LUMIS_ISA
