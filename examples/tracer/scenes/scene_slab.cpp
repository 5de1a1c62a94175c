#include "scenes/scene_slab.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

std::unique_ptr<Renderer> make_slab(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Slab>>(Slab{}, options, Slab::camera());
}

}  // namespace tracer
