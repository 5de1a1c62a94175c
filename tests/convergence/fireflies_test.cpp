// Fireflies are counted, and where the estimators that have none are known: weights by densities leave no rare and bright
// samples where another technique is likely to find the same light.
#include "fireflies.hpp"

#include "catch.hpp"
#include "scenes/scenes.hpp"

using namespace convergence;

namespace {

tracer::Image grey(float level) {
    tracer::Image image{9, 7, {}};
    image.pixels.assign(9 * 7, glm::vec3{level});
    return image;
}

glm::vec3& at(tracer::Image& image, int x, int y) {
    return image.pixels[static_cast<std::size_t>(y * image.width + x)];
}

}  // namespace

TEST_CASE("a firefly is a lone white pixel in the dark") {
    const tracer::Image dark = grey(0.1f), bright = grey(0.6f);
    tracer::Image image = dark;
    CHECK(count_fireflies(image, dark) == 0);
    at(image, 4, 3) = glm::vec3{7};
    at(image, 8, 6) = glm::vec3{1};  // in the corner
    CHECK(count_fireflies(image, dark) == 2);
    CHECK(count_fireflies(image, bright) == 0);
    at(image, 5, 4) = glm::vec3{0.5f};  // not alone any more
    CHECK(count_fireflies(image, dark) == 1);
    at(image, 8, 6) = glm::vec3{0.99f};
    CHECK(count_fireflies(image, dark) == 0);
}

TEST_CASE("only single techniques and their average show fireflies on veach") {
    constexpr int width = 120, height = 80;
    const tracer::RenderOptions direct{.bounces = 1, .sampler = tracer::Sampler::Random};
    const auto renderer = tracer::find_scene("veach")->make({width, height, {}});
    tracer::Film reference{width, height};
    renderer->add_pass(reference, "balance", {.bounces = 1}, {0, 64}, 1);
    for (const auto integrator : tracer::integrator_names()) {
        int fireflies = 0;  // of three images
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            tracer::Film film{width, height};
            renderer->add_pass(film, integrator, direct, {0, 16}, seed);
            fireflies += count_fireflies(film.image(), reference.image());
        }
        INFO(integrator << ": " << fireflies);
        const bool shows_some = integrator == "bsdf" || integrator == "light" || integrator == "average";
        CHECK((fireflies >= 3) == shows_some);
        CHECK((fireflies == 0) == !shows_some);
    }
}
