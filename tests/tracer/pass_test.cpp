// Ranks of MPI render passes into films of their own, and the root merges them: the image must not tell.
#include "catch.hpp"
#include "scenes/scenes.hpp"

#include <cstring>

TEST_CASE("a pass that is merged adds the very bits of a pass added in place") {
    using namespace tracer;
    constexpr int size = 16;
    constexpr std::uint32_t samples = 24;
    for (const SceneEntry& scene : scenes()) {
        const auto renderer = scene.make({size, size, {}});
        Film in_place{size, size}, merged{size, size};
        for (std::uint32_t first = 0; first < 4 * samples; first += samples) {
            Film alone{size, size};
            for (Film* film : {&in_place, &alone}) renderer->add_pass(*film, "power", {}, {first, samples}, 3);
            merged.merge(alone);
        }
        CAPTURE(scene.name);
        const std::size_t bytes = in_place.pixels.size() * sizeof(Pixel);  // which has no gaps
        CHECK(std::memcmp(in_place.pixels.data(), merged.pixels.data(), bytes) == 0);
    }
}
