// Materials: each gives the strategy to sample it by, and what it reflects. Local frame, +z the normal on wo's side.
#pragma once

#include <lumis/lumis.hpp>

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tracer {

using glm::vec3;

// reflected(wo, wi): the fraction of radiance from wi that leaves towards wo per solid angle, the cosine included.
struct Diffuse {
    vec3 albedo;

    [[nodiscard]] static auto strategy(const vec3& /*wo*/) { return lumis::CosineHemisphere<float>{}; }
    [[nodiscard]] vec3 reflected(const vec3& /*wo*/, const vec3& wi) const {
        return albedo * (wi.z * std::numbers::inv_pi_v<float>);
    }
};

// A rough metal; its color at normal incidence goes to white at grazing (Schlick 1994).
struct Metal {
    vec3 color;
    float alpha;

    [[nodiscard]] auto strategy(const vec3& wo) const { return lumis::GgxReflection<float>{wo, glm::vec2{alpha}}; }
    [[nodiscard]] vec3 reflected(const vec3& wo, const vec3& wi) const {
        const float cos_half = 0.5f * glm::length(wo + wi);
        const vec3 fresnel = color + (1.0f - color) * std::pow(std::max(1 - cos_half, 0.0f), 5.0f);
        return fresnel * (lumis::Ggx<float>{glm::vec2{alpha}}.brdf(wo, wi) * wi.z);
    }
};

// A polished metal: a delta strategy, whose coefficient is the color itself.
struct Mirror {
    vec3 color;

    [[nodiscard]] static auto strategy(const vec3& wo) { return lumis::PerfectReflection<float>{wo}; }
};

// Reflectance of the boundary to a dielectric of relative index `index`, unpolarized light (Fresnel).
[[nodiscard]] inline float fresnel_dielectric(float cos_i, float index) {
    const float cos_t = std::sqrt(std::max(1 - (1 - cos_i * cos_i) / (index * index), 0.0f));
    const float parallel = (index * cos_i - cos_t) / (index * cos_i + cos_t);
    const float perpendicular = (cos_i - index * cos_t) / (cos_i + index * cos_t);
    return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

// A rough dielectric coat over a diffuse base: a mixture of two lobes, chosen by what each reflects at wo.
struct Coated {
    vec3 albedo;
    float alpha;
    float index;

    [[nodiscard]] auto strategy(const vec3& wo) const {
        const float coat = fresnel_dielectric(wo.z, index);
        const float base = std::max({albedo.r, albedo.g, albedo.b});
        return lumis::Mixture{lumis::choose(base / (base + coat), lumis::CosineHemisphere<float>{}),
                              lumis::choose(coat / (base + coat), lumis::GgxReflection<float>{wo, glm::vec2{alpha}})};
    }
    [[nodiscard]] vec3 reflected(const vec3& wo, const vec3& wi) const {
        const float coat =
            fresnel_dielectric(0.5f * glm::length(wo + wi), index) * lumis::Ggx<float>{glm::vec2{alpha}}.brdf(wo, wi);
        return (albedo * std::numbers::inv_pi_v<float> + coat) * wi.z;
    }
};

}  // namespace tracer
