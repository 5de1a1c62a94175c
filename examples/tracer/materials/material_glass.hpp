// Glass, rough and polished, from both sides. A path comes from the camera, and so carries radiance. See materials.hpp.
#pragma once

#include "materials/scattering.hpp"
#include "paths/packet.hpp"
#include <lumis/lumis.hpp>

#include <glm/vec3.hpp>

#include <cmath>

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

    using Lobes = lumis::GgxDielectric<R>;
    struct Bsdf : Lobes {
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

    using Lobes = lumis::SmoothDielectric<R>;
    struct Bsdf : Lobes {
        [[nodiscard]] LUMIS_INLINE glm::vec<3, R> coefficient(const glm::vec<3, R>& wi) const {
            return glm::vec<3, R>{Lobes::coefficient(wi)};
        }
    };
    [[nodiscard]] LUMIS_INLINE Bsdf strategy(const glm::vec<3, R>& wo) const { return {{wo, index}}; }
    [[nodiscard]] LUMIS_INLINE glm::vec<3, R> albedo_seen(const glm::vec<3, R>& /*wo*/) const {
        return glm::vec<3, R>{R(1.0f)};
    }
};

// The share of light that is left after a way through what absorbs it (Beer and Lambert). Nothing is absorbed in the open,
// however far away the sky is.
template <lumis::Real R>
[[nodiscard]] inline glm::vec<3, R> left_after(const R& distance, const glm::vec<3, R>& absorption) {
    const auto left = [&](const R& per_length) {
        return of_lanes<R>([&](auto i) {
            const float a = lane(per_length, i);
            return a > 0.0f ? std::exp(-a * lane(distance, i)) : 1.0f;
        });
    };
    return {left(absorption.x), left(absorption.y), left(absorption.z)};
}

// Glass that absorbs light on its way inside, where anything else may stand as well. It is polished: rough glass asks lights,
// on both its sides, and would have to tell which of them shine through it.
template <class M>
struct Absorbing {
    M glass;
    glm::vec<3, typename M::Scalar> absorption;  // per unit of length

    using Scalar = typename M::Scalar;
    template <lumis::Real S>
    using In = Absorbing<typename M::template In<S>>;
    static constexpr bool is_delta = true, transmits = true;
    static_assert(M::is_delta && M::transmits, "polished glass alone absorbs");

    using Lobes = typename M::Lobes;
    using Bsdf = typename M::Bsdf;
    [[nodiscard]] LUMIS_INLINE Bsdf strategy(const glm::vec<3, Scalar>& wo) const { return glass.strategy(wo); }
    [[nodiscard]] LUMIS_INLINE glm::vec<3, Scalar> albedo_seen(const glm::vec<3, Scalar>& wo) const {
        return glass.albedo_seen(wo);
    }
};

}  // namespace tracer
