// Direct light at a point that the camera sees. A scene is a type: its materials are the alternatives of
// Scene::Material, its lights what lights_at returns; the estimator below is composed of just these.
#pragma once

#include "geometry.hpp"
#include "integrators.hpp"
#include "materials.hpp"
#include <lumis/lumis.hpp>

#include <concepts>
#include <tuple>
#include <variant>

namespace tracer {

// A visible point: directions at it live in its frame, whose +z is the normal on the viewer's side.
struct Vertex {
    glm::vec3 position;
    lumis::Frame<float> frame;
    glm::vec3 wo;  // towards the viewer, local
    const Surface* surface;
};

template <class S>
concept Scene = requires(const S scene, const Vertex vertex, const glm::vec3 w) {
    typename S::Material;  // a std::variant
    { scene.material(*vertex.surface) } -> std::same_as<const typename S::Material&>;
    { scene.geometry() } -> std::same_as<const Geometry&>;
    scene.lights_at(vertex);                             // a std::tuple of Light
    { scene.background(w) } -> std::same_as<glm::vec3>;  // radiance from beyond all surfaces
};

// Radiance that arrives at a point from a direction.
template <Scene S>
[[nodiscard]] glm::vec3 incident(const S& scene, const glm::vec3& position, const glm::vec3& direction) {
    const auto hit = scene.geometry().closest(position, direction);
    return hit ? hit->surface->radiance : scene.background(direction);
}

// The estimator that an integrator makes of a material and the scene's lights.
template <class Integrator, Scene S, class Material>
[[nodiscard]] auto estimator_at(const S& scene, const Vertex& vertex, const Material& material) {
    const auto bsdf = lumis::in_frame(vertex.frame, material.strategy(vertex.wo));
    return std::apply([&](const auto&... lights) { return Integrator::compose(bsdf, lights...); },
                      scene.lights_at(vertex));
}

// A mirror asks no light: whatever the integrator, its one direction is all there is to sample.
template <class Integrator, Scene S>
[[nodiscard]] auto estimator_at(const S& /*scene*/, const Vertex& vertex, const Mirror& mirror) {
    return multi_sample(lumis::BalanceHeuristic{},
                        lumis::take(1, lumis::in_frame(vertex.frame, mirror.strategy(vertex.wo))));
}

template <class Integrator, Scene S, class Material>
[[nodiscard]] glm::vec3 direct_light(const S& scene, const Vertex& vertex, const Material& material, auto& uniforms) {
    const auto estimator = estimator_at<Integrator>(scene, vertex, material);
    if constexpr (std::same_as<Material, Mirror>) {
        return estimator.estimate(
            [&](const glm::vec3& wi, lumis::delta_t) { return material.color * incident(scene, vertex.position, wi); },
            uniforms);
    } else {
        return estimator.estimate(
            [&](const glm::vec3& wi) {
                const glm::vec3 local = vertex.frame.to_local(wi);
                if (!(local.z > 0)) return glm::vec3{0};
                return material.reflected(vertex.wo, local) * incident(scene, vertex.position, wi);
            },
            uniforms);
    }
}

}  // namespace tracer
