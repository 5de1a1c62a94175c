// Glass, rough and polished, from both sides. A path comes from the camera, and so carries radiance. See materials.hpp.
#pragma once

#include "packet.hpp"
#include "scattering.hpp"
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

// Glass that absorbs light on its way inside, by the law of Beer and Lambert: a path that arrives at it from below, wo.z < 0,
// has come that way.
template <class M>
struct Absorbing {
    M glass;
    glm::vec<3, typename M::Scalar> absorption;  // per unit of length

    using Scalar = typename M::Scalar;
    template <lumis::Real S>
    using In = Absorbing<typename M::template In<S>>;
    static constexpr bool is_delta = M::is_delta, transmits = true;

    using Lobes = typename M::Lobes;
    using Bsdf = typename M::Bsdf;
    [[nodiscard]] LUMIS_INLINE Bsdf strategy(const glm::vec<3, Scalar>& wo) const { return glass.strategy(wo); }
    [[nodiscard]] LUMIS_INLINE glm::vec<3, Scalar> albedo_seen(const glm::vec<3, Scalar>& wo) const {
        return glass.albedo_seen(wo);
    }
    // The share of light that is left after a way inside.
    [[nodiscard]] glm::vec<3, Scalar> left_after(Scalar distance) const {
        const auto left = [&](Scalar per_length) {
            const Scalar depth = per_length * distance;
            return of_lanes<Scalar>([&](auto i) { return std::exp(-lane(depth, i)); });
        };
        const glm::vec<3, Scalar> color{left(absorption.x), left(absorption.y), left(absorption.z)};
        return finite_where(distance >= 0.0f, color);
    }
};

}  // namespace tracer
