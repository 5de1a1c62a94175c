// An image depends on the seed alone, its error falls as passes add up, and a scene has what it needs and nothing else.
#include "catch.hpp"
#include "folder.hpp"
#include "paths/camera.hpp"
#include "scenes/scenes.hpp"
#include <lumis/statistics/running_moments.hpp>

#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <vector>

namespace {

using namespace tracer;

// Its passes do not fill whole packets.
Image render(const Renderer& renderer, const RenderOptions& options, std::uint64_t seed, std::size_t threads) {
    const oneapi::tbb::global_control limit{oneapi::tbb::global_control::max_allowed_parallelism, threads};
    Film film{24, 16};
    for (std::uint32_t first : {0u, 5u, 10u}) renderer.add_pass(film, "power", options, {first, 5}, seed);
    return film.image();
}

std::vector<std::string> strategies(std::string_view scene) {
    return find_scene(scene)->make({8, 8, {}})->strategies();
}

}  // namespace

TEST_CASE("an image depends on the seed alone") {
    for (const SceneEntry& scene : scenes()) {
        const auto renderer = scene.make({24, 16, {}});
        for (const auto& sampler : samplers) {
            const RenderOptions options{.sampler = sampler.value};
            const Image one = render(*renderer, options, 7, 1);
            for (const std::size_t threads : {2u, 5u, 8u}) {
                INFO(scene.name << ", " << sampler.name << ", " << threads << " threads");
                CHECK(one.pixels == render(*renderer, options, 7, threads).pixels);
            }
            CHECK(one.pixels != render(*renderer, options, 8, 2).pixels);
        }
    }
}

// A pixel's variance over seeds, after one pass and after all, summed over pixels as shares of their own variance. Its standard
// error is 1.1 %, and that of the image's variance 4.4 %: passes and pixels that are independent fail once in 5000.
TEST_CASE("the error of an image falls as its passes say, and by Sobol points faster") {
    constexpr int size = 16, seeds = 64;
    constexpr std::uint32_t passes = 16, samples = 8;
    const auto renderer = find_scene("cornell")->make({size, size, {}});
    for (const auto& sampler : samplers) {
        INFO(sampler.name);
        const RenderOptions options{.bounces = 1, .sampler = sampler.value};
        std::vector<lumis::RunningMoments<>> of_one(size * size), of_all(size * size), reported(size * size);
        lumis::RunningMoments<> of_image;  // the sum of all pixels after one pass
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            Film sum{size, size};
            for (std::uint32_t pass = 0; pass < passes; ++pass) {
                const std::vector<Pixel> before = sum.pixels;
                renderer->add_pass(sum, "light", options, {pass * samples, samples}, seed);
                double image = 0;
                for (std::size_t i = 0; i < of_one.size(); ++i) {
                    const double value = sum.pixels[i].sum.g - before[i].sum.g;
                    of_one[i].add(value);
                    image += value;
                }
                of_image.add(image);
            }
            for (std::size_t i = 0; i < of_all.size(); ++i) {
                of_all[i].add(sum.pixels[i].mean().g);
                reported[i].add(sum.pixels[i].variance().g);
            }
        }
        lumis::RunningMoments<> ratios, reported_ratios;
        double variances = 0;
        for (std::size_t i = 0; i < of_one.size(); ++i) {
            variances += of_one[i].variance();
            // A pixel within the light itself has no variance.
            if (!(of_one[i].variance() > 0)) continue;
            const double independent = of_one[i].variance() / (samples * samples * passes);
            ratios.add(of_all[i].variance() / independent);
            reported_ratios.add(reported[i].mean() / independent);
        }
        CHECK(ratios.count() >= 240);
        if (sampler.value == Sampler::Random) {
            CHECK(std::abs(ratios.mean() - 1) <= 0.042);
            CHECK(std::abs(reported_ratios.mean() - 1) <= 0.042);
        } else {
            CHECK(ratios.mean() <= 0.8);
            CHECK(reported_ratios.mean() >= 1);
        }
        // Pixels do not share samples: the variance of their sum is the sum of their variances.
        CHECK(std::abs(of_image.variance() / variances - 1) <= 0.17);
    }
}

TEST_CASE("scenes name what they sample, and have nothing else") {
    CHECK(strategies("sky") == std::vector<std::string>{"Diffuse: CosineHemisphere", "Metal<Conductor>: GgxReflection",
                                                        "Mirror<Conductor>: PerfectReflection",
                                                        "light: EnvironmentMap"});
    CHECK(strategies("cornell") == std::vector<std::string>{"Diffuse: CosineHemisphere",
                                                            "Coated: Mixture<CosineHemisphere, GgxReflection>",
                                                            "light: AreaLight<Parallelogram, ByArea>"});
    CHECK(strategies("veach") == std::vector<std::string>{"Diffuse: CosineHemisphere",
                                                          "Coated: Mixture<CosineHemisphere, GgxReflection>",
                                                          "light: AreaLight<Sphere, BySolidAngle>"});
}

TEST_CASE("a camera is the scene's own but for what is asked; straight down it sees x to the right") {
    const Camera own{{0, 1, 5}, {0, 1, 0}, {0, 1, 0}, 90};
    CHECK(View{asked(own, {}), 8, 8}.ray(4.0f, 4.0f).direction == glm::vec3{0, 0, -1});
    const View down{asked(own, {.eye = glm::vec3{0, 9, 0}}), 8, 8};
    const float half = std::sqrt(0.5f);
    CHECK(glm::length(down.ray(4.0f, 4.0f).direction - glm::vec3{0, -1, 0}) <= 1e-6f);
    CHECK(glm::length(down.ray(8.0f, 4.0f).direction - glm::vec3{half, -half, 0}) <= 1e-6f);
    CHECK(glm::length(down.ray(4.0f, 0.0f).direction - glm::vec3{0, -half, -half}) <= 1e-6f);
    CHECK_THROWS(asked(own, {.eye = own.target}));
    CHECK_THROWS(asked(own, {.target = glm::vec3{3e38f}}));
}

TEST_CASE("a mesh looks the same whatever its unit and its origin") {
    const Folder folder;
    const auto image = [&](float size, const glm::vec3& at) {
        std::ofstream obj{folder.file("a.obj")};
        for (const glm::vec3 corner : {glm::vec3{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {0, 0, 1}}) {
            const glm::vec3 v = at + size * corner;
            obj << std::setprecision(9) << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
        }
        obj << "f 1 2 3\nf 2 4 1\n" << std::flush;
        const CameraOptions camera{.eye = at + size * glm::vec3{1, 2, 4}, .target = at};
        return render(*find_scene("mesh")->make({24, 16, {}, folder.file("a.obj"), camera}), {}, 1, 2).pixels;
    };
    const auto expected = image(1, {0, 0, -0.5f});
    CHECK((image(0x1p-6f, {0, 0, -0x1p-7f}) == expected));
    CHECK((image(1, {65536, -32768, 1024}) == expected));
}
