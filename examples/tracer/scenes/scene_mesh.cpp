#include "scenes/scene_mesh.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

#include <utility>

namespace tracer {

namespace {

std::unique_ptr<Renderer> make(const SceneOptions& options) {
    MeshScene scene{options};
    const Camera camera = scene.camera();
    SceneOptions placed = options;
    for (auto* point : {&placed.camera.eye, &placed.camera.target}) {
        if (*point) *point = scene.placement()(**point);
    }
    return std::make_unique<SceneRenderer<MeshScene>>(std::move(scene), placed, camera);
}

}  // namespace

const SceneEntry scene_mesh{
    "mesh", "An OBJ file", "Triangles, of which any number may shine; the room shipped, unless a file is named.",
    480,    360,           true,
    make};

}  // namespace tracer
