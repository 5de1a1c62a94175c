#include "scenes/scene_sundial.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

std::unique_ptr<Renderer> make_sundial(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Sundial>>(Sundial{}, options, Sundial::camera());
}

}  // namespace tracer
