#include "scenes/scene_veach.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

namespace {

std::unique_ptr<Renderer> make_veach(const SceneOptions& options) {
    using Scene = Veach<Coated<float>>;
    return std::make_unique<SceneRenderer<Scene>>(Scene{coated_plate}, options, Scene::camera());
}

std::unique_ptr<Renderer> make_veach_metal(const SceneOptions& options) {
    using Scene = Veach<Metal<float, Tint>>;
    return std::make_unique<SceneRenderer<Scene>>(Scene{metal_plate}, options, Scene::camera());
}

}  // namespace

const SceneEntry scene_veach{"veach",
                             "Veach's plates and spheres",
                             "Four coated plates, the farthest the smoothest, reflect five sphere lights of falling "
                             "size and rising radiance. Sampling the lights fails where a smooth plate mirrors a large "
                             "light, sampling the BSDF where a rough one reflects a small light.",
                             768,
                             512,
                             false,
                             make_veach};
const SceneEntry scene_veach_metal{"veach-metal",
                                   "Veach's plates of metal",
                                   "The plates and lights of the scene veach, but the plates reflect all light as "
                                   "rough metal does, as other renderers have them.",
                                   768,
                                   512,
                                   false,
                                   make_veach_metal};

}  // namespace tracer
