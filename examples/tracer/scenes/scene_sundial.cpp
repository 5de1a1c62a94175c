#include "scenes/scene_sundial.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

namespace {

std::unique_ptr<Renderer> make(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Sundial>>(Sundial{}, options, Sundial::camera());
}

}  // namespace

const SceneEntry scene_sundial{
    "sundial",
    "A sundial at dusk",
    "Sun, moon, a lantern and a round lamp: shadows are soft or sharp as their lights are wide or have no extent.",
    640,
    400,
    false,
    make};

}  // namespace tracer
