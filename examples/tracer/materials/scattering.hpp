// What materials are made of: the value of a BSDF at two directions, and what several need for it.
#pragma once

#include <lumis/lumis.hpp>

#include <glm/vec3.hpp>

namespace tracer {

// reflected: radiance towards wo per radiance from wi and solid angle, |cos wi| included. pdf: the density of wi.
template <lumis::Real R>
struct Scattering {
    glm::vec<3, R> reflected;
    R pdf;
};

// A colour where the condition holds, and of it each channel that is positive and finite; else 0.
template <class Mask, lumis::Real R>
[[nodiscard]] LUMIS_INLINE inline glm::vec<3, R> finite_where(const Mask& condition, const glm::vec<3, R>& color) {
    const glm::vec<3, R> finite{lumis::density_or_zero(color.x), lumis::density_or_zero(color.y),
                                lumis::density_or_zero(color.z)};
    return lumis::real::select(condition, finite, glm::vec<3, R>{R(0.0f)});
}

// The cosine between wo and the normal that mirrors it into wi: half the length of their sum.
template <lumis::Real R>
[[nodiscard]] LUMIS_INLINE inline R cos_half(const glm::vec<3, R>& wo, const glm::vec<3, R>& wi) {
    return 0.5f * lumis::real::length(glm::vec<3, R>(wo + wi));
}

}  // namespace tracer
