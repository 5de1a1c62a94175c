// The scenes that the report shows. The tracer's others have known answers, which tests look at, or show what these show.
#pragma once

#include "renderer.hpp"

#include <span>
#include <string_view>

namespace convergence {

struct ReportScene {
    const tracer::SceneEntry& entry;
    bool is_in_demo;  // else it takes the time of --all
};

[[nodiscard]] std::span<const ReportScene> report_scenes();

// One of them by its name.
[[nodiscard]] const tracer::SceneEntry& report_scene(std::string_view name);

// In pixels, of all their own widths.
[[nodiscard]] int widest_scene();

}  // namespace convergence
