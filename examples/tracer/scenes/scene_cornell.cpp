#include "scenes/scene_cornell.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

std::unique_ptr<Renderer> make_cornell(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Cornell>>(Cornell{}, options, Cornell::camera());
}

}  // namespace tracer
