#include "renderer.hpp"

#include "scenes.hpp"

#include <algorithm>

namespace tracer {

namespace {

constexpr std::array<SceneEntry, 3> all_scenes{{
    {"veach", "Veach's plates and spheres", 768, 512, make_veach},
    {"sky", "Rising roughness under a sunset", 768, 384, make_sky},
    {"cornell", "Cornell box with a glossy block", 512, 512, make_cornell},
}};

}  // namespace

Image Film::image() const {
    Image image{width, height, {}};
    for (const glm::dvec3& sum : sums) image.pixels.emplace_back(sum / static_cast<double>(std::max(samples, 1)));
    return image;
}

std::span<const SceneEntry> scenes() {
    return all_scenes;
}

const SceneEntry* find_scene(std::string_view name) {
    const auto found = std::ranges::find(all_scenes, name, &SceneEntry::name);
    return found == all_scenes.end() ? nullptr : &*found;
}

}  // namespace tracer
