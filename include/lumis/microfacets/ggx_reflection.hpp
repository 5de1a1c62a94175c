// Reflection of wo by a GGX surface, sampled through its visible normals. Local frame, density per solid angle of wi:
// D(wm) / (2 (wo.z + stretched length of wo)). What is drawn falls below the horizon with a probability that grows with
// roughness, alpha^2 / (1 + alpha^2) at normal incidence; nothing is drawn then.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/microfacets/ggx_vndf.hpp"
#include "lumis/microfacets/reflected.hpp"

#include <concepts>

namespace lumis::LUMIS_ISA {

template <Real T = float>
struct GgxReflection : Reflected<GgxVndf<T>> {
    LUMIS_INLINE GgxReflection(const Direction<T>& wo, glm::vec<2, T> alpha) noexcept
        : Reflected<GgxVndf<T>>{wo, GgxVndf<T>{wo, alpha}} {}
    // One roughness for both axes.
    template <std::convertible_to<T> Roughness>
    LUMIS_INLINE GgxReflection(const Direction<T>& wo, Roughness alpha) noexcept
        : GgxReflection{wo, detail::on_both_axes<T>(alpha)} {}

    // The surface, for its reflectance: ggx().brdf(wo, wi).
    [[nodiscard]] LUMIS_HD const Ggx<T>& ggx() const noexcept { return this->normals().ggx(); }
};

}  // namespace lumis::LUMIS_ISA
