// GGX normals as seen from wo: density G1(wo) max(0, wo.wm) D(wm) / wo.z per solid angle of wm. Local frame.
// Heitz 2018, "Sampling the GGX Distribution of Visible Normals"; drawn by spherical caps, Dupuy and Benyoub 2023.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/microfacets/detail/ggx_cap.hpp"

#include <concepts>

namespace lumis::LUMIS_ISA {

template <Real T = float>
struct GgxVndf : detail::GgxCap<T> {
    // wo: unit; on or below the horizon nothing is drawn. alpha: roughness along x and y, see ggx_min_alpha.
    LUMIS_INLINE GgxVndf(const Direction<T>& wo, glm::vec<2, T> alpha) noexcept
        : detail::GgxCap<T>{wo, Ggx<T>{alpha}, [](const auto&, const auto&) { return T(0); }} {}
    // One roughness for both axes.
    template <std::convertible_to<T> Roughness>
    LUMIS_INLINE GgxVndf(const Direction<T>& wo, Roughness alpha) noexcept
        : GgxVndf{wo, detail::on_both_axes<T>(alpha)} {}
};

}  // namespace lumis::LUMIS_ISA
