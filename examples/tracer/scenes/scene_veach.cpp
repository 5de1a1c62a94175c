#include "scenes/scene_veach.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

std::unique_ptr<Renderer> make_veach(const SceneOptions& options) {
    using Scene = Veach<Coated<float>>;
    return std::make_unique<SceneRenderer<Scene>>(Scene{coated_plate}, options, Scene::camera());
}

std::unique_ptr<Renderer> make_veach_metal(const SceneOptions& options) {
    using Scene = Veach<Metal<float, Tint>>;
    return std::make_unique<SceneRenderer<Scene>>(Scene{metal_plate}, options, Scene::camera());
}

}  // namespace tracer
