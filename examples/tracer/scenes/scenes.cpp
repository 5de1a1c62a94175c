#include "scenes/scenes.hpp"

#include <algorithm>
#include <array>

namespace tracer {

std::span<const SceneEntry> scenes() {
    static const std::array all{scene_veach, scene_sky,  scene_cornell,     scene_veach_metal, scene_box, scene_furnace,
                                scene_glass, scene_slab, scene_many_lights, scene_sundial,     scene_mesh};
    return all;
}

const SceneEntry* find_scene(std::string_view name) {
    const auto found = std::ranges::find(scenes(), name, &SceneEntry::name);
    return found == scenes().end() ? nullptr : &*found;
}

}  // namespace tracer
