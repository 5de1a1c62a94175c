// What the command line, the report and the tests see of the tracer: scenes by name, rendered pass by pass.
#pragma once

#include "film.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tracer {

inline constexpr std::array<std::string_view, 6> integrator_names{"bsdf",  "light",      "balance",
                                                                  "power", "one-sample", "average"};

// A scene seen by its camera at one resolution. Primary rays go through the pixels' centres and are traced once: what is
// left to estimate, and to time, is direct light.
class Renderer {
  public:
    virtual ~Renderer() = default;

    // The estimators that an integrator composes in this scene, one for each material, read off their types.
    [[nodiscard]] virtual std::vector<std::string> strategies(std::string_view integrator) const = 0;

    // Adds samples to every pixel. What is added depends on the seed and the pass alone, never on the threads. Returns
    // the CPU seconds that all threads together spent on estimation.
    virtual double add_pass(Film& film, std::string_view integrator, int samples, std::uint64_t seed,
                            std::uint64_t pass) const = 0;
};

struct SceneOptions {
    int width{}, height{};    // in pixels
    std::string environment;  // file of an environment map; empty: the one shipped
};

struct SceneEntry {
    std::string_view name, title, description;
    int width, height;  // unless asked otherwise
    bool has_sky;       // shows SceneOptions::environment
    std::unique_ptr<Renderer> (*make)(const SceneOptions&);
};

[[nodiscard]] std::span<const SceneEntry> scenes();

// nullptr if there is none of that name.
[[nodiscard]] const SceneEntry* find_scene(std::string_view name);

// In pixels, of all the scenes' own widths.
[[nodiscard]] int widest_scene();

}  // namespace tracer
