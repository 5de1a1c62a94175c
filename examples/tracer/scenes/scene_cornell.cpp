#include "scenes/scene_cornell.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

namespace {

std::unique_ptr<Renderer> make(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Cornell>>(Cornell{}, options, Cornell::camera());
}

}  // namespace

const SceneEntry scene_cornell{"cornell",
                               "Cornell box",
                               "One rectangular light hangs over diffuse walls, a diffuse block and a coated one: "
                               "sampling the light is nearly all that this scene needs.",
                               512,
                               512,
                               false,
                               make};

}  // namespace tracer
