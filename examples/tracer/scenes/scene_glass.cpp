#include "scenes/scene_glass.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

std::unique_ptr<Renderer> make_glass(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Glass>>(Glass{}, options, Glass::camera());
}

}  // namespace tracer
