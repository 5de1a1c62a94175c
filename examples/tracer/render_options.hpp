// How a scene is rendered, apart from the integrator: what a command line can ask of every renderer.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace tracer {

enum class Sampler { Sobol, Random };
enum class Filter { Box, Tent };

// A value and what the command line calls it.
template <class Value>
struct Named {
    std::string_view name;
    Value value;
};

// The value of that name; the first if there is none.
template <class Names>
[[nodiscard]] constexpr auto value_named(const Names& names, std::string_view name) {
    for (const auto& one : names) {
        if (one.name == name) return one.value;
    }
    return names.front().value;
}

inline constexpr std::array<Named<Sampler>, 2> samplers{{{"sobol", Sampler::Sobol}, {"random", Sampler::Random}}};
inline constexpr std::array<Named<Filter>, 2> filters{{{"box", Filter::Box}, {"tent", Filter::Tent}}};

// Some of a pixel's samples, which are numbered from 0: those of a pass.
struct SampleRange {
    std::uint32_t first;
    std::int32_t count;
};

struct RenderOptions {
    int bounces = 5;  // of a path: 0 shows emission alone, 1 direct light
    Sampler sampler = Sampler::Sobol;
    Filter filter = Filter::Box;
};

// What is asked of a camera, in the scene's coordinates; the scene's own in all else.
struct CameraOptions {
    std::optional<glm::vec3> eye{}, target{}, up{};
    std::optional<float> field_of_view{};  // in degrees, on the smaller axis
};

}  // namespace tracer
