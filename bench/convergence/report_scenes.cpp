#include "report_scenes.hpp"

#include "scenes/scenes.hpp"

#include <algorithm>
#include <array>

namespace convergence {

namespace {

constexpr std::array all{ReportScene{tracer::scene_veach, true}, ReportScene{tracer::scene_sky, true},
                         ReportScene{tracer::scene_cornell, true}, ReportScene{tracer::scene_glass, false},
                         ReportScene{tracer::scene_many_lights, false}};

}  // namespace

std::span<const ReportScene> report_scenes() {
    return all;
}

const tracer::SceneEntry& report_scene(std::string_view name) {
    return std::ranges::find_if(all, [&](const ReportScene& scene) { return scene.entry.name == name; })->entry;
}

int widest_scene() {
    int widest = 0;
    for (const ReportScene& scene : all) widest = std::max(widest, scene.entry.width);
    return widest;
}

}  // namespace convergence
