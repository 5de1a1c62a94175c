// Materials: how a surface scatters light, and the strategy to sample it by. Local frame, +z the normal; directions are unit
// vectors that point away from the surface. A material is an aggregate of nothing but numbers: a scene keeps it of floats,
// and packets of paths gather it into M::In<Lanes>, number by number.
//
//   is_delta               it scatters into single directions: no light is asked
//   transmits              it scatters to both sides: +z is outside, and wo may be below; otherwise +z is wo's side
//   strategy(wo)           draws wi
//   evaluate(wo, wi)       what is scattered from wi to wo, and the density of strategy(wo) at wi: see Scattering
//   coefficient(wo, wi)    of a delta material instead: by what a path's throughput is multiplied, before it is divided
//                          by the probability of wi, the pdf of its sample
//   albedo_seen(wo)        roughly how much of a white sky it scatters to wo: for a denoiser
//
// What is scattered is finite and not negative, whatever numbers a lane holds: 0 where directions are on the wrong side or are
// none. A lane that is not in use holds a unit wo all the same, such as (0, 0, 1): any other fails an assertion in debug
// builds, and takes time in others.
#pragma once

#include "material_glass.hpp"
#include "material_metal.hpp"
#include "scattering.hpp"
#include <lumis/lumis.hpp>

#include <glm/vec3.hpp>

namespace tracer {

template <lumis::Real R>
struct Diffuse {
    glm::vec<3, R> albedo;

    using Scalar = R;
    template <lumis::Real S>
    using In = Diffuse<S>;
    static constexpr bool is_delta = false, transmits = false;

    [[nodiscard]] LUMIS_INLINE static auto strategy(const glm::vec<3, R>& /*wo*/) {
        return lumis::CosineHemisphere<R>{};
    }
    [[nodiscard]] LUMIS_INLINE Scattering<R> evaluate(const glm::vec<3, R>& wo, const glm::vec<3, R>& wi) const {
        const R pdf = strategy(wo).pdf(wi);
        return {finite_where(wo.z > 0, albedo * pdf), pdf};
    }
    [[nodiscard]] LUMIS_INLINE auto albedo_seen(const glm::vec<3, R>& /*wo*/) const { return albedo; }
};

// A rough dielectric coat over a diffuse base: a mixture of two lobes, chosen by what each reflects at wo. The coat does not
// darken the base; together they reflect less than all if the base is as dark as a coat at grazing angles is bright.
template <lumis::Real R>
struct Coated {
    glm::vec<3, R> albedo;
    R alpha;
    R index;  // of the coat, to that outside

    using Scalar = R;
    template <lumis::Real S>
    using In = Coated<S>;
    static constexpr bool is_delta = false, transmits = false;

    [[nodiscard]] LUMIS_INLINE auto strategy(const glm::vec<3, R>& wo) const {
        const R share = coat_share(wo);
        return lumis::Mixture{lumis::choose(1 - share, lumis::CosineHemisphere<R>{}),
                              lumis::choose(share, lumis::GgxReflection<R>{wo, alpha})};
    }
    [[nodiscard]] LUMIS_INLINE Scattering<R> evaluate(const glm::vec<3, R>& wo, const glm::vec<3, R>& wi) const {
        const lumis::GgxReflection<R> rough{wo, alpha};
        const R base = lumis::CosineHemisphere<R>{}.pdf(wi), coat = rough.pdf(wi), share = coat_share(wo);
        const R gloss = lumis::fresnel_dielectric(cos_half(wo, wi), index) * (rough.weight(wi) * coat);
        return {finite_where(wo.z > 0, albedo * base + gloss), (1 - share) * base + share * coat};
    }
    [[nodiscard]] LUMIS_INLINE auto albedo_seen(const glm::vec<3, R>& wo) const {
        return albedo + lumis::fresnel_dielectric(wo.z, index);
    }

  private:
    [[nodiscard]] LUMIS_INLINE R coat_share(const glm::vec<3, R>& wo) const {
        const R coat = lumis::fresnel_dielectric(wo.z, index);
        const R sum = coat + lumis::real::greater(lumis::real::greater(albedo.x, albedo.y), albedo.z);
        return lumis::real::quotient_where(sum > 0, coat, sum);
    }
};

// Two materials side by side, finer than any pixel: a share of the surface is b, the rest a.
template <class A, class B>
struct Blend {
    A a;
    B b;
    typename A::Scalar share;

    using Scalar = typename A::Scalar;
    template <lumis::Real S>
    using In = Blend<typename A::template In<S>, typename B::template In<S>>;
    static constexpr bool is_delta = false, transmits = A::transmits || B::transmits;
    static_assert(!(A::is_delta || B::is_delta), "a mixture has a density: give the polished part some roughness");

    [[nodiscard]] LUMIS_INLINE auto strategy(const glm::vec<3, Scalar>& wo) const {
        return lumis::Mixture{lumis::choose(1 - share, a.strategy(wo)), lumis::choose(share, b.strategy(wo))};
    }
    [[nodiscard]] LUMIS_INLINE Scattering<Scalar> evaluate(const glm::vec<3, Scalar>& wo,
                                                           const glm::vec<3, Scalar>& wi) const {
        const auto of_a = a.evaluate(wo, wi), of_b = b.evaluate(wo, wi);
        return {(1 - share) * of_a.reflected + share * of_b.reflected, (1 - share) * of_a.pdf + share * of_b.pdf};
    }
    [[nodiscard]] LUMIS_INLINE auto albedo_seen(const glm::vec<3, Scalar>& wo) const {
        return (1 - share) * a.albedo_seen(wo) + share * b.albedo_seen(wo);
    }
};

}  // namespace tracer
