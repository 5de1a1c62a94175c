#include "scenes/scene_mesh.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

#include <utility>

namespace tracer {

std::unique_ptr<Renderer> make_mesh(const SceneOptions& options) {
    MeshScene scene{options};
    const Camera camera = scene.camera();
    return std::make_unique<SceneRenderer<MeshScene>>(std::move(scene), options, camera);
}

}  // namespace tracer
