// An image depends on the seed alone, and estimators contain what their scene needs and nothing else.
#include "renderer.hpp"

#include "catch.hpp"
#include <lumis/statistics/running_moments.hpp>

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace tracer;

Image render(const Renderer& renderer, std::uint64_t seed, std::size_t threads) {
    const oneapi::tbb::global_control limit{oneapi::tbb::global_control::max_allowed_parallelism, threads};
    Film film{24, 16};
    for (std::uint64_t pass = 0; pass < 3; ++pass) renderer.add_pass(film, "power", 2, seed, pass);
    return film.image();
}

bool any_contains(const std::vector<std::string>& names, std::string_view part) {
    return std::ranges::any_of(names, [&](const std::string& name) { return name.find(part) != std::string::npos; });
}

std::vector<std::string> strategies(std::string_view scene, std::string_view integrator) {
    return find_scene(scene)->make({8, 8, {}})->strategies(integrator);
}

}  // namespace

TEST_CASE("an image depends on the seed alone") {
    for (const SceneEntry& scene : scenes()) {
        const auto renderer = scene.make({24, 16, {}});
        const Image one = render(*renderer, 7, 1);
        CHECK(one.pixels == render(*renderer, 7, 2).pixels);
        CHECK(one.pixels == render(*renderer, 7, 5).pixels);
        CHECK(one.pixels != render(*renderer, 8, 2).pixels);
    }
}

// A pixel's variance over seeds, after 64 passes and after one, summed over pixels as shares of their own variance. Its
// standard error is 0.8 %: streams that are independent fail once in 5000.
TEST_CASE("the error of an image falls as its passes say") {
    constexpr int size = 24, seeds = 64, passes = 64;
    const auto renderer = find_scene("cornell")->make({size, size, {}});
    std::vector<lumis::RunningMoments<>> of_one(size * size), of_all(size * size);
    lumis::RunningMoments<> of_image;  // the sum of all pixels after one pass
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        Film sum{size, size};
        for (std::uint64_t pass = 0; pass < passes; ++pass) {
            const std::vector<Pixel> before = sum.pixels;
            renderer->add_pass(sum, "light", 1, seed, pass);
            double image = 0;
            for (std::size_t i = 0; i < of_one.size(); ++i) {
                const double value = sum.pixels[i].sum.g - before[i].sum.g;
                of_one[i].add(value);
                image += value;
            }
            of_image.add(image);
        }
        for (std::size_t i = 0; i < of_all.size(); ++i) of_all[i].add(sum.pixels[i].sum.g / passes);
    }
    lumis::RunningMoments<> ratios;
    for (std::size_t i = 0; i < of_one.size(); ++i) {
        // The light itself, which the camera sees, has no variance.
        if (of_one[i].variance() > 0) ratios.add(passes * of_all[i].variance() / of_one[i].variance());
    }
    CHECK(ratios.count() >= 500);
    CHECK(std::abs(ratios.mean() - 1) <= 0.03);
    // Pixels do not share samples: the variance of their sum is the sum of their variances, here within 2.2 %.
    double variances = 0;
    for (const auto& pixel : of_one) variances += pixel.variance();
    CHECK(std::abs(of_image.variance() / variances - 1) <= 0.1);
}

TEST_CASE("estimators contain what their scene needs and nothing else") {
    CHECK(any_contains(strategies("sky", "power"), "EnvironmentMap"));
    CHECK(!any_contains(strategies("veach", "power"), "EnvironmentMap"));
    CHECK(!any_contains(strategies("cornell", "power"), "EnvironmentMap"));
    CHECK(any_contains(strategies("veach", "power"), "Sphere"));
    CHECK(!any_contains(strategies("cornell", "power"), "Sphere"));

    // One technique alone contains neither the other nor a heuristic's terms.
    CHECK(!any_contains(strategies("veach", "bsdf"), "AreaLight"));
    CHECK(!any_contains(strategies("veach", "light"), "Ggx"));

    // A mirror asks no light, whatever the integrator; a diffuse wall has no GGX.
    for (const auto integrator : integrator_names) {
        for (const std::string& name : strategies("sky", integrator)) {
            if (name.starts_with("Mirror"))
                CHECK(name == "Mirror: MultiSample<BalanceHeuristic, InFrame<PerfectReflection>>");
            if (name.starts_with("Diffuse")) CHECK(name.find("Ggx") == std::string::npos);
        }
    }
}
