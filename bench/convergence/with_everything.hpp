// A scene with everything in: one material that holds every lobe, every kind of light, and what the scene does not use
// left to run time with count or probability 0. It is what a renderer that composes nothing carries along.
#pragma once

#include "direct_light.hpp"
#include "scene_renderer.hpp"

#include <algorithm>
#include <concepts>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace tracer {

// A diffuse base, and over it a glossy lobe, coat or metal; or a mirror. What is absent is black.
struct Everything {
    Diffuse base{vec3{0}};
    Coated coat{vec3{0}, 1, 0};  // there if its index is not 0
    Metal metal{vec3{0}, 1};     // there if its color is not black
    Mirror mirror{vec3{0}};

    Everything() = default;
    explicit Everything(const Diffuse& diffuse) : base{diffuse} {}
    explicit Everything(const Coated& coated) : coat{coated} {}
    explicit Everything(const Metal& rough) : metal{rough} {}
    explicit Everything(const Mirror& smooth) : mirror{smooth} {}

    [[nodiscard]] bool is_mirror() const { return mirror.color != vec3{0}; }

    [[nodiscard]] auto strategy(const vec3& wo) const {
        const vec3 albedo = base.albedo + coat.albedo;
        const float diffuse = std::max({albedo.r, albedo.g, albedo.b});
        const bool coated = coat.index > 0;
        const float glossy = coated ? fresnel_dielectric(wo.z, coat.index) : metal.color != vec3{0} ? 1.0f : 0.0f;
        const float sum = diffuse + glossy > 0 ? diffuse + glossy : 1.0f;
        const glm::vec2 alpha{coated ? coat.alpha : metal.alpha};
        return lumis::Mixture{lumis::choose(diffuse / sum, lumis::CosineHemisphere<float>{}),
                              lumis::choose(glossy / sum, lumis::GgxReflection<float>{wo, alpha})};
    }
    [[nodiscard]] vec3 reflected(const vec3& wo, const vec3& wi) const {
        vec3 sum{0};
        if (base.albedo != vec3{0}) sum += base.reflected(wo, wi);
        if (coat.index > 0) sum += coat.reflected(wo, wi);
        if (metal.color != vec3{0}) sum += metal.reflected(wo, wi);
        return sum;
    }
};

template <Scene S>
class WithEverything {
  public:
    using Material = std::variant<Everything>;

    explicit WithEverything(S scene) : scene_{std::move(scene)} {
        for (const auto& material : scene_.materials()) {
            materials_.push_back(std::visit([](const auto& one) { return Everything{one}; }, material));
        }
    }

    [[nodiscard]] const Geometry& geometry() const { return scene_.geometry(); }
    [[nodiscard]] const Material& material(const Surface& surface) const { return materials_[surface.material]; }
    [[nodiscard]] vec3 background(const vec3& w) const { return scene_.background(w); }

    [[nodiscard]] auto lights_at(const Vertex& vertex) const {
        return std::tuple_cat(scene_.lights_at(vertex), unless_there(vertex, no_rectangle_),
                              unless_there(vertex, no_sphere_), unless_there(vertex, no_environment_));
    }

  private:
    template <class Strategy>
    [[nodiscard]] auto unless_there(const Vertex& vertex, const Strategy& absent) const {
        const auto kinds = [](const auto&... lights) {
            return std::bool_constant<(std::same_as<std::remove_cvref_t<decltype(lights.strategy)>, Strategy> ||
                                       ...)>{};
        };
        if constexpr (decltype(std::apply(kinds, scene_.lights_at(vertex)))::value) {
            return std::tuple{};
        } else {
            return std::tuple{Light<const Strategy&>{absent, false}};
        }
    }

    S scene_;
    std::vector<Material> materials_;
    lumis::AreaLight<lumis::Parallelogram<float>> no_rectangle_{lumis::Parallelogram<float>{}, vec3{0}};
    lumis::AreaLight<lumis::Sphere<float>, lumis::BySolidAngle> no_sphere_{lumis::Sphere<float>{}, vec3{0}};
    lumis::EnvironmentMap<float> no_environment_{1, 1, std::vector<float>{0}};
};

// A mirror asks no light, here too; the power heuristic is the one measured.
template <class Integrator, Scene S>
    requires std::same_as<Integrator, Power>
[[nodiscard]] auto estimator_at(const S& scene, const Vertex& vertex, const Everything& material) {
    const bool mirror = material.is_mirror();
    const auto compose = [&](auto... lights) {
        ((lights.risen = lights.risen && !mirror), ...);
        return multi_sample(
            lumis::PowerHeuristic{}, take_bsdf(lumis::in_frame(vertex.frame, material.strategy(vertex.wo)), lights...),
            lumis::take(mirror ? 1 : 0, lumis::in_frame(vertex.frame, material.mirror.strategy(vertex.wo))),
            take_light(lights)...);
    };
    return std::apply(compose, scene.lights_at(vertex));
}

template <class Integrator, Scene S>
    requires std::same_as<Integrator, Power>
[[nodiscard]] vec3 direct_light(const S& scene, const Vertex& vertex, const Everything& material, auto& uniforms) {
    struct Reflected {
        const S& scene;
        const Vertex& vertex;
        const Everything& material;

        vec3 operator()(const vec3& wi) const {
            const vec3 local = vertex.frame.to_local(wi);
            if (!(local.z > 0)) return vec3{0};
            return material.reflected(vertex.wo, local) * incident(scene, vertex.position, wi);
        }
        vec3 operator()(const vec3& wi, lumis::delta_t) const {
            return material.mirror.color * incident(scene, vertex.position, wi);
        }
    };
    const auto estimator = estimator_at<Integrator>(scene, vertex, material);
    return estimator.estimate(Reflected{scene, vertex, material}, uniforms);
}

template <Scene S>
[[nodiscard]] std::unique_ptr<Renderer> with_everything(S scene, const SceneOptions& options) {
    return std::make_unique<SceneRenderer<WithEverything<S>, std::tuple<Power>>>(WithEverything<S>{std::move(scene)},
                                                                                 options, S::camera());
}

}  // namespace tracer
