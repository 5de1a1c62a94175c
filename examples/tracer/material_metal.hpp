// Metals, rough and polished: a reflectance that depends on the angle, and a surface. See materials.hpp.
#pragma once

#include "scattering.hpp"
#include <lumis/lumis.hpp>

#include <glm/vec3.hpp>

namespace tracer {

// Unpolarised reflectance by the complex index of refraction eta + i k of each channel (Fresnel).
template <lumis::Real R>
struct Conductor {
    glm::vec<3, R> eta, k;

    template <lumis::Real S>
    using In = Conductor<S>;

    [[nodiscard]] LUMIS_INLINE glm::vec<3, R> reflectance(R cosine) const {
        return {lumis::fresnel_conductor(cosine, eta.x, k.x), lumis::fresnel_conductor(cosine, eta.y, k.y),
                lumis::fresnel_conductor(cosine, eta.z, k.z)};
    }
};

// At red, green and blue light.
inline constexpr Conductor<float> silver{{0.1553f, 0.1167f, 0.1383f}, {4.8283f, 3.1222f, 2.1470f}};

// The same reflectance at all angles.
template <lumis::Real R>
struct Tint {
    glm::vec<3, R> color;

    template <lumis::Real S>
    using In = Tint<S>;

    [[nodiscard]] LUMIS_INLINE const glm::vec<3, R>& reflectance(R /*cosine*/) const { return color; }
};

// A rough metal: microfacets of GGX, each a mirror. What is reflected twice is lost, see Compensated.
template <lumis::Real R, template <class> class Reflectance = Conductor>
struct Metal {
    Reflectance<R> surface;
    R alpha;

    using Scalar = R;
    template <lumis::Real S>
    using In = Metal<S, Reflectance>;
    static constexpr bool is_delta = false, transmits = false;

    [[nodiscard]] LUMIS_INLINE auto strategy(const glm::vec<3, R>& wo) const {
        return lumis::GgxReflection<R>{wo, alpha};
    }
    [[nodiscard]] LUMIS_INLINE Scattering<R> evaluate(const glm::vec<3, R>& wo, const glm::vec<3, R>& wi) const {
        const auto ggx = strategy(wo);
        const R pdf = ggx.pdf(wi);
        return {finite_where(pdf > 0, surface.reflectance(cos_half(wo, wi)) * (ggx.weight(wi) * pdf)), pdf};
    }
    [[nodiscard]] LUMIS_INLINE auto albedo_seen(const glm::vec<3, R>& wo) const { return surface.reflectance(wo.z); }
};

// A rough metal that loses nothing to reflections between its facets (Turquin 2019): a white one reflects 99.1 % or more
// of a white sky. A little less reciprocal than nature: wo is the direction towards the camera.
template <class M>
struct Compensated {
    M metal;

    using Scalar = typename M::Scalar;
    template <lumis::Real S>
    using In = Compensated<typename M::template In<S>>;
    static constexpr bool is_delta = false, transmits = false;

    [[nodiscard]] LUMIS_INLINE auto strategy(const glm::vec<3, Scalar>& wo) const { return metal.strategy(wo); }
    [[nodiscard]] LUMIS_INLINE Scattering<Scalar> evaluate(const glm::vec<3, Scalar>& wo,
                                                           const glm::vec<3, Scalar>& wi) const {
        const auto [reflected, pdf] = metal.evaluate(wo, wi);
        const glm::vec<3, Scalar> factor =
            lumis::ggx_compensation(lumis::Ggx<Scalar>{metal.alpha}, wo, metal.surface.reflectance(Scalar(1.0f)));
        return {finite_where(pdf > 0, reflected * factor), pdf};
    }
    [[nodiscard]] LUMIS_INLINE auto albedo_seen(const glm::vec<3, Scalar>& wo) const { return metal.albedo_seen(wo); }
};

// A polished metal.
template <lumis::Real R, template <class> class Reflectance = Conductor>
struct Mirror {
    Reflectance<R> surface;

    using Scalar = R;
    template <lumis::Real S>
    using In = Mirror<S, Reflectance>;
    static constexpr bool is_delta = true, transmits = false;

    [[nodiscard]] LUMIS_INLINE static auto strategy(const glm::vec<3, R>& wo) {
        return lumis::PerfectReflection<R>{wo};
    }
    [[nodiscard]] LUMIS_INLINE auto coefficient(const glm::vec<3, R>& wo, const glm::vec<3, R>& /*wi*/) const {
        return finite_where(wo.z > 0, surface.reflectance(wo.z));
    }
    [[nodiscard]] LUMIS_INLINE auto albedo_seen(const glm::vec<3, R>& wo) const { return surface.reflectance(wo.z); }
};

}  // namespace tracer
