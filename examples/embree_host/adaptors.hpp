// What a renderer writes to sample by Lumis. Four adaptors: vectors, random numbers, lights, materials.
#pragma once

#include "scene.hpp"
#include "sobol.hpp"
#include <lumis/lumis.hpp>

namespace host {

// 1. Vectors. Lumis takes and returns glm::vec<3, float>; a compiler makes nothing of the conversion.
inline glm::vec3 to_lumis(const Vec& v) {
    return {v.x, v.y, v.z};
}
inline Vec from_lumis(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

// 2. Random numbers. Whatever has next<N>() is a source; this makes one of a function that returns the next number. Each
// strategy spends a fixed number of them, so Sobol dimensions keep their meaning.
inline auto uniforms_of(PathSampler& sampler) {
    return lumis::uniforms_from<float>([&sampler] { return sampler.next(); });
}

// 3. Lights. What one sample of them tells the renderer's loop.
struct LightDraw {
    Vec direction;
    float pdf = 0;  // per solid angle, the choice of this light included; 0: nothing was drawn
    float distance = 0;
    Vec radiance;
};

// 4. Materials. A strategy over directions, as the loop sees it.
template <class Strategy>
struct Bsdf {
    struct Draw {
        Vec direction;
        float pdf;  // 0: nothing was drawn
    };
    Strategy strategy;

    [[nodiscard]] Draw draw(PathSampler& sampler) const {
        const auto sample = strategy.sample(uniforms_of(sampler).template next<Strategy::dimensions>());
        return {from_lumis(sample.value), sample.pdf};
    }
    [[nodiscard]] float pdf(const Vec& wi) const { return strategy.pdf(to_lumis(wi)); }
};
template <class Strategy>
Bsdf(Strategy) -> Bsdf<Strategy>;

// All that the loop asks of Lumis. The tables are made once; strategies are made where they are used, and allocate nothing.
class LumisParts {
  public:
    explicit LumisParts(const Scene& scene)
        : scene_{scene}, sky_{scene.sky.width, scene.sky.height, luminances(scene.sky)}, choice_{weights()} {}

    // Chooses a light in proportion to its power, then a point of it evenly by area, or a direction of the sky.
    [[nodiscard]] LightDraw draw_light(const Vec& point, PathSampler& sampler) const {
        auto uniforms = uniforms_of(sampler);
        const auto chosen = choice_.sample(uniforms.next<1>());
        const glm::vec2 u = uniforms.next<2>();
        if (!(chosen.pdf > 0)) return {};
        if (chosen.value == scene_.lights.size()) {
            const auto drawn = sky_.sample(u);
            const Vec direction = from_lumis(drawn.value);
            return {direction, chosen.pdf * drawn.pdf, drawn.distance, scene_.sky.radiance(direction)};
        }
        const Triangle& triangle = scene_.light(chosen.value);
        const auto drawn = lumis::AreaLight{shape_of(triangle), to_lumis(point)}.sample(u);
        return {from_lumis(drawn.value), chosen.pdf * drawn.pdf, drawn.distance, scene_.material(triangle).emission};
    }

    // The density with which draw_light, at the ray's origin, draws what the ray has met: a light, or the sky.
    [[nodiscard]] float light_pdf(const Vec& origin, const Vec& direction, const Hit& hit) const {
        const float cosine = dot(hit.normal, direction);  // of the geometric normal: densities are of true areas
        const float pdf = lumis::pdf_from_hit(shape_of(*hit.triangle), to_lumis(origin), hit.distance, cosine);
        return choice_.pdf(hit.triangle->light) * pdf;
    }
    [[nodiscard]] float sky_pdf(const Vec& direction) const {
        return choice_.pdf(scene_.lights.size()) * sky_.pdf(to_lumis(direction));
    }

    // A mixture of the material's two lobes, turned from its local frame, +z the normal, to the world.
    [[nodiscard]] static auto bsdf(const Material& material, const Vec& normal, const Vec& wo) {
        const lumis::Frame<float> frame{to_lumis(normal)};
        const glm::vec3 local = frame.to_local(to_lumis(wo));
        const float coat = material.coat_share(local.z);
        return Bsdf{
            in_frame(frame, lumis::Mixture{lumis::choose(1 - coat, lumis::CosineHemisphere<float>{}),
                                           lumis::choose(coat, lumis::GgxReflection<float>{local, material.alpha})})};
    }

    [[nodiscard]] static float weight(float own, float other) {
        return lumis::mis_weight(lumis::PowerHeuristic{}, own, other);
    }

  private:
    static lumis::Triangle<float> shape_of(const Triangle& t) { return {to_lumis(t.a), to_lumis(t.b), to_lumis(t.c)}; }
    static std::vector<float> luminances(const Sky& sky) {
        std::vector<float> result;
        for (const Vec& texel : sky.texels) result.push_back(luminance(texel));
        return result;
    }
    // One weight a light, and last that of the sky: as much as all the others.
    [[nodiscard]] std::vector<float> weights() const {
        std::vector<float> result;
        float sum = 0;
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
            const Triangle& light = scene_.light(i);
            sum += result.emplace_back(light.area() * luminance(scene_.material(light).emission));
        }
        result.push_back(sky_.empty() ? 0 : sum > 0 ? sum : 1);
        return result;
    }

    const Scene& scene_;
    lumis::EnvironmentMap<float> sky_;
    lumis::DiscreteTable<float> choice_;  // in the order of its uniform, as Sobol points want it
};

}  // namespace host
