#include "scenes/scene_box.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

namespace {

std::unique_ptr<Renderer> make(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Box>>(Box{}, options, Box::camera());
}

}  // namespace

const SceneEntry scene_box{
    "box",
    "A closed room with a known answer",
    "Every wall emits the same and reflects the same share: the radiance is emission / (1 - albedo) everywhere.",
    256,
    256,
    false,
    make};

}  // namespace tracer
