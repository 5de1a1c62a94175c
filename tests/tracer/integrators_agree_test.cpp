// Every integrator estimates the same image: a bias of one, or of what all but one share, shows as a difference.
#include "block_moments.hpp"
#include "coarse_sky.hpp"
#include "folder.hpp"
#include "renderer.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace {

using namespace tracer;

struct Rendering {
    int width, height, samples;  // a pixel and pass
    int bounces;
};

// Light that the camera sees without a bounce is taken off: all have the same, and small bright lamps would hide the rest in
// its noise. It is known to the rounding, for the points of a pass are those of the same pass without bounces.
BlockMoments block_moments(const Renderer& renderer, const Rendering& rendering, std::string_view integrator,
                           std::uint64_t seed) {
    constexpr int passes = 32;
    BlockMoments moments{rendering.width, rendering.height};
    for (std::uint64_t pass = 1; pass <= passes; ++pass) {
        Film film{rendering.width, rendering.height}, emission = film;
        renderer.add_pass(film, integrator, {.bounces = rendering.bounces}, {0, rendering.samples},
                          seed * passes + pass);
        renderer.add_pass(emission, integrator, {.bounces = 0}, {0, rendering.samples}, seed * passes + pass);
        for (std::size_t i = 0; i < film.pixels.size(); ++i) film.pixels[i].sum -= emission.pixels[i].sum;
        moments.add(film.image());
    }
    return moments;
}

// Every integrator against power, which takes eight times the samples, but for those whose errors are not normal yet: a few
// samples hold what they find. A bias of half a percent would be seen in direct light, and of one in whole paths.
void require_agreement(std::string_view scene_name, Rendering rendering, std::initializer_list<std::string_view> but,
                       const std::string& environment = {}) {
    const auto renderer = find_scene(scene_name)->make({rendering.width, rendering.height, environment});
    const std::span<const std::string_view> names = integrator_names();
    Rendering finer = rendering;
    finer.samples *= 8;
    const auto power = block_moments(*renderer, finer, "power", 1);
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == "power" || std::ranges::count(but, names[i]) > 0) continue;
        require_same_means(block_moments(*renderer, rendering, names[i], i + 2), power, names.size() - 1,
                           std::string{scene_name} + ", " + std::string{names[i]},
                           rendering.bounces > 1 ? 0.01 : 0.005);
    }
}

}  // namespace

// False alarms: 1e-4 a rendering (Sidak over integrators and blocks). What a smooth surface mirrors, light sampling alone finds in
// one of thousands of samples; and near the lamp of cornell it has no variance, nor has an average with it.
TEST_CASE("integrators agree on veach") {
    require_agreement("veach", {48, 32, 16, 1}, {"light"});
    require_agreement("veach", {48, 32, 8, 5}, {"light"});
}
TEST_CASE("integrators agree on sky") {
    const Folder folder;
    write_image(folder.file("sky.exr"), coarse_sky());
    require_agreement("sky", {48, 24, 8, 1}, {"average"}, folder.file("sky.exr"));
    require_agreement("sky", {48, 24, 8, 5}, {"light", "average"}, folder.file("sky.exr"));
}
TEST_CASE("integrators agree on cornell") {
    require_agreement("cornell", {32, 32, 24, 1}, {"light", "average"});
    require_agreement("cornell", {32, 32, 16, 5}, {"light", "average"});
}
// Directions of the BSDF meet the sun, half a thousandth of the sky, too rarely.
TEST_CASE("integrators agree on sundial") {
    require_agreement("sundial", {32, 16, 8, 1}, {"bsdf", "average"});
    require_agreement("sundial", {32, 16, 8, 5}, {"bsdf", "light", "average"});
}
