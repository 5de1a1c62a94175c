// Glass, rough and polished, both sides of it. A path carries radiance: it comes from the camera. See materials.hpp.
#pragma once

#include "scattering.hpp"
#include <lumis/lumis.hpp>

#include <glm/vec3.hpp>

namespace tracer {

// Ground glass: microfacets of GGX, each a boundary between dielectrics.
template <lumis::Real R>
struct RoughGlass {
    R alpha;
    R index;  // inside, to that outside

    using Scalar = R;
    template <lumis::Real S>
    using In = RoughGlass<S>;
    static constexpr bool is_delta = false, transmits = true;

    [[nodiscard]] LUMIS_INLINE auto strategy(const glm::vec<3, R>& wo) const {
        return lumis::GgxDielectric<R>{wo, alpha, index};
    }
    [[nodiscard]] LUMIS_INLINE Scattering<R> evaluate(const glm::vec<3, R>& wo, const glm::vec<3, R>& wi) const {
        const auto boundary = strategy(wo);
        const R pdf = boundary.pdf(wi);
        return {glm::vec<3, R>{lumis::density_or_zero(R(boundary.weight(wi) * pdf))}, pdf};
    }
    [[nodiscard]] LUMIS_INLINE static auto albedo_seen(const glm::vec<3, R>& /*wo*/) { return glm::vec<3, R>{R(1.0f)}; }
};

// Polished glass: it mirrors, or refracts.
template <lumis::Real R>
struct SmoothGlass {
    R index;  // inside, to that outside

    using Scalar = R;
    template <lumis::Real S>
    using In = SmoothGlass<S>;
    static constexpr bool is_delta = true, transmits = true;

    [[nodiscard]] LUMIS_INLINE auto strategy(const glm::vec<3, R>& wo) const {
        return lumis::SmoothDielectric<R>{wo, index};
    }
    [[nodiscard]] LUMIS_INLINE auto coefficient(const glm::vec<3, R>& wo, const glm::vec<3, R>& wi) const {
        return glm::vec<3, R>{lumis::density_or_zero(strategy(wo).coefficient(wi))};
    }
    [[nodiscard]] LUMIS_INLINE static auto albedo_seen(const glm::vec<3, R>& /*wo*/) { return glm::vec<3, R>{R(1.0f)}; }
};

}  // namespace tracer
