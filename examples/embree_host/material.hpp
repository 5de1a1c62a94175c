// The renderer's own reflectance: a diffuse base, and a coat of GGX over it. Lumis samples; what a surface reflects is the
// renderer's to say.
#pragma once

#include "vector.hpp"

#include <numbers>

namespace host {

struct Material {
    Vec albedo, emission;
    float alpha;  // roughness of the coat; 0: there is none
    float index;  // its refractive index

    [[nodiscard]] bool emits() const { return largest(emission) > 0; }
    [[nodiscard]] bool reflects() const { return alpha > 0 || largest(albedo) > 0; }

    // What the coat reflects at an angle to its microfacets, unpolarised light (Fresnel).
    [[nodiscard]] float fresnel(float cos_i) const {
        const float cos_t = std::sqrt(std::max(1 - (1 - cos_i * cos_i) / (index * index), 0.0f));
        const float parallel = (index * cos_i - cos_t) / (index * cos_i + cos_t);
        const float perpendicular = (cos_i - index * cos_t) / (cos_i + index * cos_t);
        return (parallel * parallel + perpendicular * perpendicular) / 2;
    }
    // Density of the coat's microfacets (Walter et al. 2007, eq. 33).
    [[nodiscard]] float microfacets(float cos_m) const {
        const float a = alpha * alpha, s = cos_m * cos_m * (a - 1) + 1;
        return a / (std::numbers::pi_v<float> * s * s);
    }
    // Reflectance times the cosine at wi. Unit vectors; n is the normal on wo's side.
    [[nodiscard]] Vec reflected(const Vec& n, const Vec& wo, const Vec& wi) const {
        const float cos_o = dot(n, wo), cos_i = dot(n, wi);
        if (!(cos_o > 0 && cos_i > 0)) return {};
        const Vec base = std::numbers::inv_pi_v<float> * albedo;
        if (!(alpha > 0)) return cos_i * base;
        const Vec m = normalized(wo + wi);
        const auto slope = [&](float c) { return std::sqrt(alpha * alpha * (1 - c * c) + c * c); };
        const float masking = 0.5f / (cos_o * slope(cos_i) + cos_i * slope(cos_o));  // Smith's, heights correlated
        const float coat = fresnel(dot(wo, m)) * microfacets(dot(n, m)) * masking;
        return cos_i * (base + Vec{coat, coat, coat});
    }
    // The share of samples for the coat: what it reflects at wo, against the base.
    [[nodiscard]] float coat_share(float cos_o) const {
        const float coat = alpha > 0 ? fresnel(cos_o) : 0.0f;
        return coat > 0 ? coat / (coat + largest(albedo)) : 0.0f;
    }
};

}  // namespace host
