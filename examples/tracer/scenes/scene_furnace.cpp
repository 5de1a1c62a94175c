#include "scenes/scene_furnace.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

namespace {

std::unique_ptr<Renderer> make(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Furnace>>(Furnace{}, options, Furnace::camera());
}

}  // namespace

const SceneEntry scene_furnace{
    "furnace",
    "Objects that cannot be seen",
    "Chalk, a mirror, glass and a glowing ball lose no light under a uniform sky: all of the image is 1.",
    512,
    256,
    false,
    make};

}  // namespace tracer
