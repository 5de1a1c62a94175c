// Glass, rough and polished, from both sides. A path comes from the camera, and so carries radiance. See materials.hpp.
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

    struct Bsdf : lumis::GgxDielectric<R> {
        [[nodiscard]] LUMIS_INLINE Scattering<R> evaluate(const glm::vec<3, R>& wi) const {
            const R pdf = this->pdf(wi);
            return {glm::vec<3, R>{lumis::density_or_zero(R(this->weight(wi) * pdf))}, pdf};
        }
    };
    [[nodiscard]] LUMIS_INLINE Bsdf strategy(const glm::vec<3, R>& wo) const { return {{wo, alpha, index}}; }
    [[nodiscard]] LUMIS_INLINE glm::vec<3, R> albedo_seen(const glm::vec<3, R>& /*wo*/) const {
        return glm::vec<3, R>{R(1.0f)};
    }
};

// Polished glass: it mirrors, or refracts.
template <lumis::Real R>
struct SmoothGlass {
    R index;  // inside, to that outside

    using Scalar = R;
    template <lumis::Real S>
    using In = SmoothGlass<S>;
    static constexpr bool is_delta = true, transmits = true;

    struct Bsdf : lumis::SmoothDielectric<R> {
        [[nodiscard]] LUMIS_INLINE glm::vec<3, R> coefficient(const glm::vec<3, R>& wi) const {
            return glm::vec<3, R>{lumis::SmoothDielectric<R>::coefficient(wi)};
        }
    };
    [[nodiscard]] LUMIS_INLINE Bsdf strategy(const glm::vec<3, R>& wo) const { return {{wo, index}}; }
    [[nodiscard]] LUMIS_INLINE glm::vec<3, R> albedo_seen(const glm::vec<3, R>& /*wo*/) const {
        return glm::vec<3, R>{R(1.0f)};
    }
};

}  // namespace tracer
