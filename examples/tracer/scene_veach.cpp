#include "scene_veach.hpp"

#include "scene_renderer.hpp"
#include "scenes.hpp"

namespace tracer {

std::unique_ptr<Renderer> make_veach(const SceneOptions& options) {
    using Plate = Coated<float>;
    using Scene = Veach<Plate>;
    return std::make_unique<SceneRenderer<Scene>>(Scene{[](float alpha) {
                                                      return Plate{{0.07f, 0.09f, 0.13f}, alpha, 2.0f};
                                                  }},
                                                  options, Scene::camera());
}

std::unique_ptr<Renderer> make_veach_metal(const SceneOptions& options) {
    using Plate = Metal<float, Tint>;
    using Scene = Veach<Plate>;
    return std::make_unique<SceneRenderer<Scene>>(Scene{[](float alpha) {
                                                      return Plate{{glm::vec3{1}}, alpha};
                                                  }},
                                                  options, Scene::camera());
}

}  // namespace tracer
