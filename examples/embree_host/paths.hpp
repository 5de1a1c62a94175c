// The renderer's loop, and its camera. Parts is what samples lights and materials: LumisParts, or plain code of textbooks.
#pragma once

#include "scene.hpp"
#include "sobol.hpp"

namespace host {

// Radiance that arrives at the origin from a direction. bounces: 1 is direct light.
template <class Parts>
[[nodiscard]] Vec radiance(const Scene& scene, const Parts& parts, Vec origin, Vec direction, PathSampler& sampler,
                           int bounces) {
    Vec sum, throughput{1, 1, 1};
    float bsdf_pdf = 0;  // with which the BSDF has drawn the direction; 0: it is the camera's
    for (int depth = 0;; ++depth) {
        const auto hit = scene.closest(origin, direction);
        const Material* material = hit ? &scene.material(*hit->triangle) : nullptr;

        // The first half of MIS: light that the ray has met. Light sampling could have drawn it too.
        if (!hit || material->emits()) {
            const Vec emitted = hit ? material->emission : scene.sky.radiance(direction);
            float weight = 1;
            if (bsdf_pdf > 0) {
                const float light_pdf = hit ? parts.light_pdf(origin, direction, *hit) : parts.sky_pdf(direction);
                weight = parts.weight(bsdf_pdf, light_pdf);
            }
            sum = sum + weight * throughput * emitted;
        }
        if (!hit || depth == bounces || !material->reflects()) return sum;

        // The second half: one light, and a shadow ray to it. The BSDF could have drawn this direction too.
        const Vec wo = -direction;
        const auto bsdf = parts.bsdf(*material, hit->normal, wo);
        const auto light = parts.draw_light(hit->position, sampler);
        if (light.pdf > 0) {
            const Vec reflected = material->reflected(hit->normal, wo, light.direction);
            if (largest(reflected) > 0 && !scene.occluded(hit->position, light.direction, light.distance)) {
                const float weight = parts.weight(light.pdf, bsdf.pdf(light.direction));
                sum = sum + weight / light.pdf * throughput * reflected * light.radiance;
            }
        }

        // The path goes on along the BSDF. Nothing drawn counts, as 0.
        const auto next = bsdf.draw(sampler);
        if (!(next.pdf > 0)) return sum;
        throughput = 1 / next.pdf * throughput * material->reflected(hit->normal, wo, next.direction);
        const float survival = depth > 0 ? std::min(largest(throughput), 1.0f) : 1.0f;
        if (!(sampler.next() < survival)) return sum;
        throughput = 1 / survival * throughput;
        origin = hit->position, direction = next.direction, bsdf_pdf = next.pdf;
    }
}

}  // namespace host
