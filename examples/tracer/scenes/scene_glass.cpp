#include "scenes/scene_glass.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

namespace {

std::unique_ptr<Renderer> make(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Glass>>(Glass{}, options, Glass::camera());
}

}  // namespace

const SceneEntry scene_glass{
    "glass",
    "Glass on a table",
    "A polished ball, whose caustic only paths of the BSDF find, a ball of ground glass, and a block that absorbs.",
    640,
    480,
    false,
    make};

}  // namespace tracer
