#include "scenes/scene_many_lights.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

std::unique_ptr<Renderer> make_many_lights(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<ManyLightsRoom>>(ManyLightsRoom{}, options, ManyLightsRoom::camera());
}

}  // namespace tracer
