#include "scenes/scene_slab.hpp"

#include "scene_renderer.hpp"
#include "scenes/scenes.hpp"

namespace tracer {

namespace {

std::unique_ptr<Renderer> make(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<Slab>>(Slab{}, options, Slab::camera());
}

}  // namespace

const SceneEntry scene_slab{"slab",
                            "A slab of coloured glass with a known answer",
                            "Seen from above under a uniform sky; in its right half a lamp shines. Each pixel is known "
                            "by Fresnel's equations and Beer's law.",
                            256,
                            256,
                            false,
                            make};

}  // namespace tracer
