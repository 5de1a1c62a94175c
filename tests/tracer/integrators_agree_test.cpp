// Every integrator estimates the same image: a bias of one, or of what all but one share, shows as a difference.
#include "block_moments.hpp"
#include "coarse_sky.hpp"
#include "folder.hpp"
#include "renderer.hpp"

#include <string>

namespace {

using namespace tracer;

constexpr int passes = 64;

BlockMoments block_moments(const Renderer& renderer, int width, int height, std::string_view integrator, int samples,
                           std::uint64_t seed) {
    BlockMoments moments{width, height};
    for (std::uint64_t pass = 0; pass < passes; ++pass) {
        Film film{width, height};
        renderer.add_pass(film, integrator, samples, seed, pass);
        moments.add(film.image());
    }
    return moments;
}

// samples: a pixel and pass.
void require_agreement(std::string_view scene_name, int width, int height, int samples,
                       const std::string& environment = {}) {
    const auto renderer = find_scene(scene_name)->make({width, height, environment});
    const auto power = block_moments(*renderer, width, height, "power", samples, 1);
    for (std::size_t i = 0; i < integrator_names.size(); ++i) {
        if (integrator_names[i] == "power") continue;
        require_same_means(block_moments(*renderer, width, height, integrator_names[i], samples, i + 2), power,
                           integrator_names.size() - 1,
                           std::string{scene_name} + ", " + std::string{integrator_names[i]});
    }
}

}  // namespace

// False alarms: 1e-4 a scene (Sidak over integrators and blocks).
TEST_CASE("integrators agree on veach") {
    require_agreement("veach", 48, 32, 16);
}
TEST_CASE("integrators agree on sky") {
    const Folder folder;
    write_image(folder.file("sky.exr"), coarse_sky());
    require_agreement("sky", 48, 24, 16, folder.file("sky.exr"));
}
TEST_CASE("integrators agree on cornell") {
    require_agreement("cornell", 32, 32, 100);
}
