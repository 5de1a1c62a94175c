// The scenes, one in a file of its own each. All are in lumis_tracer_scenes; lumis_tracer has those of the report.
#pragma once

#include "renderer.hpp"

#include <span>
#include <string_view>

namespace tracer {

extern const SceneEntry scene_veach, scene_sky, scene_cornell, scene_veach_metal, scene_box, scene_furnace, scene_glass,
    scene_slab, scene_many_lights, scene_sundial, scene_mesh;

// All of them.
[[nodiscard]] std::span<const SceneEntry> scenes();

// nullptr if there is none of that name.
[[nodiscard]] const SceneEntry* find_scene(std::string_view name);

}  // namespace tracer
