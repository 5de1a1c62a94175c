// What examples/embree_host asks of LumisParts, as books have it: a light chosen by area or by power, a point of a triangle by a square root
// (Pharr, Jakob and Humphreys 2023, section 6.5.4), a sky by its luminance times the sine, GGX by its microfacets (Walter et al.
// 2007, eq. 35, 36 and 38), the power heuristic from squares.
#pragma once

#include "adaptors.hpp"
#include "textbook/directions.hpp"
#include "textbook/lights.hpp"
#include "textbook/tables.hpp"
#include "textbook/weights.hpp"

namespace textbook {

using host::Vec;

struct Bsdf {
    host::Material material;
    Vec normal, wo;

    [[nodiscard]] host::Bsdf<CosineHemisphere<float>>::Draw draw(host::PathSampler& sampler) const {
        const float lobe = sampler.next();
        const glm::vec2 u = host::uniforms_of(sampler).next<2>();
        Vec wi;
        if (lobe < material.coat_share(dot(normal, wo))) {
            const float cos_m = std::sqrt((1 - u.x) / (1 + (material.alpha * material.alpha - 1) * u.x));
            const float sin_m = std::sqrt(std::max(0.0f, 1 - cos_m * cos_m));
            const Vec m = to_world(from_spherical(cos_m, sin_m, 2 * std::numbers::pi_v<float> * u.y));
            wi = 2 * dot(wo, m) * m - wo;
        } else {
            wi = to_world(CosineHemisphere<float>{}.sample(u).value);
        }
        return {wi, pdf(wi)};
    }

    [[nodiscard]] float pdf(const Vec& wi) const {
        const float cos_i = dot(normal, wi), share = material.coat_share(dot(normal, wo));
        if (cos_i <= 0) return 0;
        const float base = (1 - share) * cos_i * std::numbers::inv_pi_v<float>;
        if (share == 0) return base;
        const Vec m = normalized(wo + wi);
        const float cos_m = dot(normal, m);
        return base + share * material.microfacets(cos_m) * cos_m / (4 * dot(wo, m));
    }

  private:
    [[nodiscard]] Vec to_world(const Direction<float>& w) const {
        const Basis<float> basis{host::to_lumis(normal)};
        return host::from_lumis(w.x * basis.x + w.y * basis.y + w.z * basis.z);
    }
};

enum class LightsBy { Area, Power };

class HostParts {
  public:
    explicit HostParts(const host::Scene& scene, LightsBy lights_by = LightsBy::Area)
        : scene_{scene},
          lights_by_{lights_by},
          weights_{weights()},
          sky_{static_cast<std::size_t>(scene.sky.width), static_cast<std::size_t>(scene.sky.height),
               luminances(scene.sky)} {}

    [[nodiscard]] host::LightDraw draw_light(const Vec& point, host::PathSampler& sampler) const {
        const float choice = sampler.next();
        const glm::vec2 u = host::uniforms_of(sampler).next<2>();
        if (choice < sky_share) {
            const auto drawn = sky_.sample(u);
            const Vec direction = host::from_lumis(drawn.value);
            return {direction, sky_share * drawn.pdf, drawn.distance, scene_.sky.radiance(direction)};
        }
        const auto chosen = weights_.sample((choice - sky_share) / (1 - sky_share));
        const host::Triangle& light = scene_.light(chosen.index);
        const float root = std::sqrt(u.x);
        const Vec to_light =
            light.a + root * (1 - u.y) * (light.b - light.a) + root * u.y * (light.c - light.a) - point;
        const float distance = length(to_light);
        const Vec direction = 1 / distance * to_light;
        return {direction, density(light, distance, direction), distance, scene_.material(light).emission};
    }
    [[nodiscard]] float light_pdf(const Vec& /*origin*/, const Vec& direction, const host::Hit& hit) const {
        return density(*hit.triangle, hit.distance, direction);
    }
    [[nodiscard]] float sky_pdf(const Vec& direction) const { return sky_share * sky_.pdf(host::to_lumis(direction)); }

    [[nodiscard]] static Bsdf bsdf(const host::Material& material, const Vec& normal, const Vec& wo) {
        return {material, normal, wo};
    }
    [[nodiscard]] static float weight(float own, float other) { return PowerHeuristic{}(own, other); }

  private:
    static constexpr float sky_share = 0.5f;

    [[nodiscard]] float density(const host::Triangle& light, float distance, const Vec& direction) const {
        const float density_of_area = (1 - sky_share) * weight_of_area(light) / total_;
        return density_of_area * distance * distance / std::abs(dot(light.normal(), direction));
    }
    [[nodiscard]] float weight_of_area(const host::Triangle& light) const {
        return lights_by_ == LightsBy::Area ? 1.0f : luminance(scene_.material(light).emission);
    }
    [[nodiscard]] std::vector<float> weights() const {
        std::vector<float> result;
        for (const std::size_t i : scene_.lights) {
            const host::Triangle& light = scene_.triangles[i];
            result.push_back(light.area() * weight_of_area(light));
        }
        return result;
    }
    static std::vector<float> luminances(const host::Sky& sky) {
        std::vector<float> result;
        for (const Vec& texel : sky.texels) result.push_back(luminance(texel));
        return result;
    }

    const host::Scene& scene_;
    LightsBy lights_by_;
    PiecewiseConstant1D<float> weights_;
    float total_ = weights_.integral() * static_cast<float>(weights_.size());
    EnvironmentMap<float> sky_;
};

}  // namespace textbook
