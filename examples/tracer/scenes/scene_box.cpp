#include "scenes/scene_box.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

std::unique_ptr<Renderer> make_box(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Box>>(Box{}, options, Box::camera());
}

}  // namespace tracer
