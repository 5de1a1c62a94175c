#include "scenes/scene_sky.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

namespace {

std::unique_ptr<Renderer> make(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Sky>>(Sky{options.environment}, options, Sky::camera());
}

}  // namespace

const SceneEntry scene_sky{
    "sky",
    "Rising roughness under a sunset",
    "A mirror, four metals of roughness 0.01, 0.05, 0.15 and 0.4, and chalk, under a photographed sky.",
    768,
    384,
    true,
    make};

}  // namespace tracer
