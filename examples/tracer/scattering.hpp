// What materials are made of: the value of one at two directions, and what several need for it.
#pragma once

#include <lumis/lumis.hpp>

#include <glm/vec3.hpp>

namespace tracer {

// reflected: radiance that leaves per radiance that arrives and solid angle, the cosine included. pdf: of the arriving
// direction, by the material's strategy.
template <lumis::Real R>
struct Scattering {
    glm::vec<3, R> reflected;
    R pdf;
};

// A colour where the condition holds and each channel that is positive and finite; else 0.
template <class Mask, lumis::Real R>
[[nodiscard]] LUMIS_INLINE inline glm::vec<3, R> finite_where(const Mask& condition, const glm::vec<3, R>& color) {
    const glm::vec<3, R> finite{lumis::density_or_zero(color.x), lumis::density_or_zero(color.y),
                                lumis::density_or_zero(color.z)};
    return lumis::real::select(condition, finite, glm::vec<3, R>{R(0.0f)});
}

// The cosine between a direction and the normal that mirrors it into the other: half the length of their sum.
template <lumis::Real R>
[[nodiscard]] LUMIS_INLINE inline R cos_half(const glm::vec<3, R>& wo, const glm::vec<3, R>& wi) {
    return 0.5f * lumis::real::length(glm::vec<3, R>(wo + wi));
}

}  // namespace tracer
