// Studies of rendered scenes: every integrator of the tracer against a reference image.
#pragma once

#include "render_options.hpp"
#include "study.hpp"

#include <filesystem>
#include <string_view>

namespace convergence {

struct RenderSettings {
    int width;                // of the widest scene, in pixels; the others in proportion
    double seconds;           // CPU time of each run
    int reference_samples;    // a pixel, for each of the two images that the reference is made of
    std::string environment;  // file; empty: the one shipped
    std::filesystem::path output;
    std::filesystem::path references;  // where they are kept
};

// What a scene is for: direct light where that is all that differs, or else whole paths. Both are of the default filter.
[[nodiscard]] tracer::RenderOptions render_options(std::string_view scene);

[[nodiscard]] Study render_study(const std::string& scene, const std::vector<std::uint64_t>& seeds,
                                 const RenderSettings& settings, const Progress& progress);

}  // namespace convergence
