// Materials: how a surface scatters light. Local frame, +z the normal; directions are unit vectors that point away from the
// surface. A material is an aggregate of nothing but numbers: a scene keeps it of floats, and packets of paths gather it into
// M::In<Lanes>, number by number.
//
//   is_delta               it scatters into single directions: no light is asked
//   transmits              it scatters to both sides: +z is outside, and wo may be below; otherwise +z is wo's side
//   Lobes                  the strategy of the library that its BSDF is made of, for those who ask what a scene consists of
//   strategy(wo)           its BSDF as seen from wo, a strategy that draws wi. All that depends on wo alone is formed here
//     .evaluate(wi)        what is scattered from wi to wo, and the density of wi, which share work: see Scattering
//     .coefficient(wi)     instead, if it is a delta strategy: multiply a path's throughput by it, and divide by the pdf
//                          of the sample
//   absorption             of what absorbs light inside: see Absorbing
//   albedo_seen(wo)        roughly how much of a white sky it scatters to wo, for a denoiser
//
// What is scattered is finite and not negative, whatever numbers a lane holds: 0 where directions are on the wrong side or are
// none. A lane that is not in use holds a material and a unit wo all the same, such as (0, 0, 1): others fail assertions in
// debug builds, and take time in the rest.
#pragma once

#include "materials/material_glass.hpp"
#include "materials/material_metal.hpp"
#include "materials/scattering.hpp"
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

    using Lobes = lumis::CosineHemisphere<R>;
    struct Bsdf : Lobes {
        glm::vec<3, R> albedo;

        [[nodiscard]] LUMIS_INLINE Scattering<R> evaluate(const glm::vec<3, R>& wi) const {
            const R pdf = this->pdf(wi);
            return {finite_where(pdf > 0, albedo * pdf), pdf};
        }
    };
    [[nodiscard]] LUMIS_INLINE Bsdf strategy(const glm::vec<3, R>& wo) const {
        return {{}, lumis::real::select(wo.z > 0, albedo, glm::vec<3, R>{R(0.0f)})};
    }
    [[nodiscard]] LUMIS_INLINE glm::vec<3, R> albedo_seen(const glm::vec<3, R>& /*wo*/) const { return albedo; }
};

// A rough dielectric coat over a diffuse base: a mixture of two lobes, chosen by what each reflects at wo. The coat takes no
// light from the base: at grazing angles, where it reflects nearly all, both together reflect more than comes in.
template <lumis::Real R>
struct Coated {
    glm::vec<3, R> albedo;
    R alpha;
    R index;  // of the coat, to that outside

    using Scalar = R;
    template <lumis::Real S>
    using In = Coated<S>;
    static constexpr bool is_delta = false, transmits = false;

    using Lobes = lumis::Mixture<lumis::CosineHemisphere<R>, lumis::GgxReflection<R>>;
    struct Bsdf : Lobes {
        glm::vec<3, R> albedo, wo;
        R index;

        [[nodiscard]] LUMIS_INLINE Scattering<R> evaluate(const glm::vec<3, R>& wi) const {
            const auto& cosine = this->template strategy<0>();
            const auto& ggx = this->template strategy<1>();
            const R base = cosine.pdf(wi), coat = ggx.pdf(wi);
            const R gloss = lumis::fresnel_dielectric(cos_half(wo, wi), index) * (ggx.weight(wi) * coat);
            return {finite_where(wo.z > 0, albedo * base + gloss),
                    this->template probability<0>() * base + this->template probability<1>() * coat};
        }
    };
    [[nodiscard]] LUMIS_INLINE Bsdf strategy(const glm::vec<3, R>& wo) const {
        const R coat = lumis::fresnel_dielectric(wo.z, index);
        const R sum = coat + lumis::real::greater(lumis::real::greater(albedo.x, albedo.y), albedo.z);
        const R share = lumis::real::quotient_where(sum > 0, coat, sum);
        return {Lobes{lumis::choose(1 - share, lumis::CosineHemisphere<R>{}),
                      lumis::choose(share, lumis::GgxReflection<R>{wo, alpha})},
                albedo, wo, index};
    }
    [[nodiscard]] LUMIS_INLINE glm::vec<3, R> albedo_seen(const glm::vec<3, R>& wo) const {
        return albedo + lumis::fresnel_dielectric(wo.z, index);
    }
};

// Two materials side by side, finer than any pixel: a share of the surface, from 0 to 1, is b, and the rest a.
template <class A, class B>
struct Blend {
    A a;
    B b;
    typename A::Scalar share;

    using Scalar = typename A::Scalar;
    template <lumis::Real S>
    using In = Blend<typename A::template In<S>, typename B::template In<S>>;
    static constexpr bool is_delta = false, transmits = A::transmits || B::transmits;
    static_assert(!(A::is_delta || B::is_delta), "a blend has a density: give what is polished a little roughness");

    using Lobes = lumis::Mixture<typename A::Bsdf, typename B::Bsdf>;
    struct Bsdf : Lobes {
        [[nodiscard]] LUMIS_INLINE Scattering<Scalar> evaluate(const glm::vec<3, Scalar>& wi) const {
            const auto of_a = this->template strategy<0>().evaluate(wi),
                       of_b = this->template strategy<1>().evaluate(wi);
            const Scalar share_a = this->template probability<0>(), share_b = this->template probability<1>();
            return {share_a * of_a.reflected + share_b * of_b.reflected, share_a * of_a.pdf + share_b * of_b.pdf};
        }
    };
    [[nodiscard]] LUMIS_INLINE Bsdf strategy(const glm::vec<3, Scalar>& wo) const {
        return {Lobes{lumis::choose(1 - share, a.strategy(wo)), lumis::choose(share, b.strategy(wo))}};
    }
    [[nodiscard]] LUMIS_INLINE glm::vec<3, Scalar> albedo_seen(const glm::vec<3, Scalar>& wo) const {
        return (1 - share) * a.albedo_seen(wo) + share * b.albedo_seen(wo);
    }
};

}  // namespace tracer
