// Metals, rough and polished: a reflectance, and a surface that has it. See materials.hpp.
#pragma once

#include "materials/scattering.hpp"
#include <lumis/lumis.hpp>

#include <glm/vec3.hpp>

namespace tracer {

// Unpolarised reflectance by the complex index of refraction eta + i k of each channel (Fresnel). With eta = 0 all is
// reflected.
template <lumis::Real R>
struct Conductor {
    glm::vec<3, R> eta, k;

    [[nodiscard]] LUMIS_INLINE glm::vec<3, R> reflectance(R cosine) const {
        return {lumis::fresnel_conductor(cosine, eta.x, k.x), lumis::fresnel_conductor(cosine, eta.y, k.y),
                lumis::fresnel_conductor(cosine, eta.z, k.z)};
    }
};

// Indices of silver at red, green and blue light.
inline constexpr Conductor<float> silver{{0.1553f, 0.1167f, 0.1383f}, {4.8283f, 3.1222f, 2.1470f}};

// The same reflectance at all angles.
template <lumis::Real R>
struct Tint {
    glm::vec<3, R> color;

    [[nodiscard]] LUMIS_INLINE const glm::vec<3, R>& reflectance(R /*cosine*/) const { return color; }
};

// A rough metal: microfacets of GGX, each a mirror. What would be reflected more than once is lost, see Compensated.
template <lumis::Real R, template <class> class Reflectance = Conductor>
struct Metal {
    Reflectance<R> surface;
    R alpha;

    using Scalar = R;
    template <lumis::Real S>
    using In = Metal<S, Reflectance>;
    static constexpr bool is_delta = false, transmits = false;

    using Lobes = lumis::GgxReflection<R>;
    struct Bsdf : Lobes {
        Reflectance<R> surface;
        glm::vec<3, R> wo;

        [[nodiscard]] LUMIS_INLINE Scattering<R> evaluate(const glm::vec<3, R>& wi) const {
            const R pdf = this->pdf(wi);
            return {finite_where(pdf > 0, surface.reflectance(cos_half(wo, wi)) * (this->weight(wi) * pdf)), pdf};
        }
    };
    [[nodiscard]] LUMIS_INLINE Bsdf strategy(const glm::vec<3, R>& wo) const { return {{wo, alpha}, surface, wo}; }
    [[nodiscard]] LUMIS_INLINE glm::vec<3, R> albedo_seen(const glm::vec<3, R>& wo) const {
        return surface.reflectance(wo.z);
    }
};

// A rough metal that loses nothing between its facets (Turquin 2019): a white one reflects 99.1 % or more of a white sky.
// Not reciprocal: wo is the direction towards the camera.
template <class M>
struct Compensated {
    M metal;

    using Scalar = typename M::Scalar;
    template <lumis::Real S>
    using In = Compensated<typename M::template In<S>>;
    static constexpr bool is_delta = false, transmits = false;

    using Lobes = typename M::Lobes;
    struct Bsdf : M::Bsdf {
        glm::vec<3, Scalar> gain;

        [[nodiscard]] LUMIS_INLINE Scattering<Scalar> evaluate(const glm::vec<3, Scalar>& wi) const {
            const auto lossy = M::Bsdf::evaluate(wi);
            return {finite_where(lossy.pdf > 0, lossy.reflected * gain), lossy.pdf};
        }
    };
    [[nodiscard]] LUMIS_INLINE Bsdf strategy(const glm::vec<3, Scalar>& wo) const {
        const auto lossy = metal.strategy(wo);
        return {lossy, lumis::ggx_compensation(lossy.ggx(), wo, metal.surface.reflectance(Scalar(1.0f)))};
    }
    [[nodiscard]] LUMIS_INLINE glm::vec<3, Scalar> albedo_seen(const glm::vec<3, Scalar>& wo) const {
        return metal.albedo_seen(wo);
    }
};

// A polished metal.
template <lumis::Real R, template <class> class Reflectance = Conductor>
struct Mirror {
    Reflectance<R> surface;

    using Scalar = R;
    template <lumis::Real S>
    using In = Mirror<S, Reflectance>;
    static constexpr bool is_delta = true, transmits = false;

    using Lobes = lumis::PerfectReflection<R>;
    struct Bsdf : Lobes {
        glm::vec<3, R> color;

        [[nodiscard]] LUMIS_INLINE glm::vec<3, R> coefficient(const glm::vec<3, R>& /*wi*/) const { return color; }
    };
    [[nodiscard]] LUMIS_INLINE Bsdf strategy(const glm::vec<3, R>& wo) const {
        return {Lobes{wo}, finite_where(wo.z > 0, surface.reflectance(wo.z))};
    }
    [[nodiscard]] LUMIS_INLINE glm::vec<3, R> albedo_seen(const glm::vec<3, R>& wo) const {
        return surface.reflectance(wo.z);
    }
};

}  // namespace tracer
