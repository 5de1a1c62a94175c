#include "scenes/scene_many_lights.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

namespace {

std::unique_ptr<Renderer> make(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<ManyLightsRoom>>(ManyLightsRoom{}, options, ManyLightsRoom::camera());
}

}  // namespace

const SceneEntry scene_many_lights{"many-lights",
                                   "Ten thousand lights",
                                   "A spiral of small spheres, of which a light tree chooses one for each point.",
                                   640,
                                   400,
                                   false,
                                   make};

}  // namespace tracer
