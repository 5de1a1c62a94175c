#include "scenes/scene_sky.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

std::unique_ptr<Renderer> make_sky(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Sky>>(Sky{options.environment}, options, Sky::camera());
}

}  // namespace tracer
