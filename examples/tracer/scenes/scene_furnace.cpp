#include "scenes/scene_furnace.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

std::unique_ptr<Renderer> make_furnace(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Furnace>>(Furnace{}, options, Furnace::camera());
}

}  // namespace tracer
