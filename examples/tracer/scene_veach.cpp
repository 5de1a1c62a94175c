#include "scene_veach.hpp"

#include "scene_renderer.hpp"
#include "scenes.hpp"

namespace tracer {

std::unique_ptr<Renderer> make_veach(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Veach>>(Veach{}, options, Veach::camera());
}

}  // namespace tracer
