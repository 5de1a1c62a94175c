// What the command line, the report and the tests see of the tracer: scenes, rendered pass by pass.
#pragma once

#include "film/film.hpp"
#include "render_options.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tracer {

// A scene seen by its camera at one resolution.
class Renderer {
  public:
    virtual ~Renderer() = default;

    // What samples this scene: a line for each kind of material and each group of lights, read off their types.
    [[nodiscard]] virtual std::vector<std::string> strategies() const = 0;

    // What the user's files ask for and do not get, a line each.
    [[nodiscard]] virtual std::vector<std::string> notes() const { return {}; }

    // Adds a pass to every pixel; whole packets (paths/packet.hpp) take the least time. What is added depends on the seed and
    // the samples alone, never on the threads. Returns the CPU seconds that all threads together spent.
    virtual double add_pass(Film& film, std::string_view integrator, const RenderOptions& options,
                            const SampleRange& samples, std::uint64_t seed) const = 0;
};

struct SceneOptions {
    int width{}, height{};    // in pixels
    std::string environment;  // file of an environment map; empty: the one shipped
    std::string mesh{};       // OBJ file of the scene mesh; empty: the one shipped
    CameraOptions camera{};
};

struct SceneEntry {
    std::string_view name, title, description;
    int width, height;  // unless asked otherwise
    bool has_sky;       // shows SceneOptions::environment
    std::unique_ptr<Renderer> (*make)(const SceneOptions&);
};

// All integrators, in the order in which they are best told.
[[nodiscard]] std::span<const std::string_view> integrator_names();

}  // namespace tracer
