// What the command line asks for.
#pragma once

#include "film/checkpoint.hpp"
#include "progress.hpp"
#include "render_options.hpp"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace tracer {

struct Settings {
    std::string scene = "veach", integrator = "power";
    std::string sampler = std::string{samplers.front().name}, filter = std::string{filters.front().name};
    int bounces = RenderOptions{}.bounces;
    Limits limits;
    std::uint64_t seed = 1;
    int threads = 1;
    int width = 0, height = 0;  // of the scene itself unless asked otherwise
    std::string environment;    // file of a map; empty: the one shipped
    std::string mesh;           // OBJ file; empty: the one shipped
    CameraOptions camera;
    std::vector<std::string> outputs{"render.png"};
    std::string error_output;  // empty: none, and so is checkpoint
    std::string checkpoint;
    double checkpoint_seconds = 30;
    bool resume = false;
    bool list_only = false;

    [[nodiscard]] RenderOptions options() const {
        return {bounces, value_named(samplers, sampler), value_named(filters, filter)};
    }
};

// All that the samples depend on, except for the size of the image.
[[nodiscard]] Origin origin_of(const Settings& settings);

// The settings; or the exit code, after the message or help has been printed.
[[nodiscard]] std::variant<Settings, int> parse_command_line(int argc, char** argv);

}  // namespace tracer
