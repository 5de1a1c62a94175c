#include "renderer.hpp"

#include "paths/transport.hpp"
#include "scenes/scenes.hpp"

#include <algorithm>

namespace tracer {

namespace {

constexpr std::array<SceneEntry, 11> all_scenes{{
    {"veach", "Veach's plates and spheres",
     "Four coated plates, the farthest the smoothest, reflect five sphere lights of falling size and rising radiance. "
     "Sampling the lights fails where a smooth plate mirrors a large light, sampling the BSDF where a rough one "
     "reflects a small light.",
     768, 512, false, make_veach},
    {"sky", "Rising roughness under a sunset",
     "A mirror, four metals of roughness 0.01, 0.05, 0.15 and 0.4, and chalk, under a photographed sky.", 768, 384,
     true, make_sky},
    {"cornell", "Cornell box",
     "One rectangular light hangs over diffuse walls, a diffuse block and a coated one: sampling the light is nearly "
     "all that this scene needs.",
     512, 512, false, make_cornell},
    {"veach-metal", "Veach's plates of metal",
     "The plates and lights of the scene veach, but the plates reflect all light as rough metal does, as other "
     "renderers have "
     "them.",
     768, 512, false, make_veach_metal},
    {"box", "A closed room with a known answer",
     "Every wall emits the same and reflects the same share: the radiance is emission / (1 - albedo) everywhere.", 256,
     256, false, make_box},
    {"furnace", "Objects that cannot be seen",
     "Chalk, a mirror, glass and a glowing ball lose no light under a uniform sky: all of the image is 1.", 512, 256,
     false, make_furnace},
    {"glass", "Glass on a table",
     "A polished ball, whose caustic only paths of the BSDF find, a ball of ground glass, and a block that absorbs.",
     640, 480, false, make_glass},
    {"slab", "A slab of coloured glass with a known answer",
     "Seen from above under a uniform sky; in its right half a lamp shines. Each pixel is known by Fresnel's equations "
     "and "
     "Beer's law.",
     256, 256, false, make_slab},
    {"many-lights", "Ten thousand lights",
     "A spiral of small spheres, of which a light tree chooses one for each point.", 640, 400, false, make_many_lights},
    {"sundial", "A sundial at dusk",
     "Sun, moon, a lantern and a round lamp: shadows are soft or sharp as their lights are wide or have no extent.",
     640, 400, false, make_sundial},
    {"mesh", "An OBJ file", "Triangles, of which any number may shine; the room shipped, unless a file is named.", 480,
     360, true, make_mesh},
}};

}  // namespace

std::span<const SceneEntry> scenes() {
    return all_scenes;
}

const SceneEntry* find_scene(std::string_view name) {
    const auto found = std::ranges::find(all_scenes, name, &SceneEntry::name);
    return found == all_scenes.end() ? nullptr : &*found;
}

std::span<const std::string_view> integrator_names() {
    static constexpr auto names = [] {
        std::array<std::string_view, integrators.size()> result;
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = integrators[i].name;
        return result;
    }();
    return names;
}

int widest_scene() {
    return std::ranges::max(all_scenes, {}, &SceneEntry::width).width;
}

}  // namespace tracer
