// Scenes with known answers: images differ from them by chance alone, of the size that the images report themselves.
#include "catch.hpp"
#include "lit_plane.hpp"
#include "renderer.hpp"
#include "scene_renderer.hpp"
#include "scenes/scene_box.hpp"
#include "scenes/scene_cornell.hpp"
#include "scenes/scene_furnace.hpp"
#include "scenes/scene_slab.hpp"
#include "scenes/scenes.hpp"
#include <lumis/testing/result.hpp>

#include <boost/math/distributions/normal.hpp>

#include <cmath>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using namespace tracer;

constexpr int width = 24, height = 16, block = 8;

// A bias of 0.5 % of the whole image would fail.
constexpr double visible_bias = 0.005;

// False alarms: 1e-4 over so many comparisons (Sidak), in standard errors.
double limit_of(std::size_t comparisons) {
    const lumis::testing::Significance significance{1e-4, comparisons};
    return quantile(complement(boost::math::normal_distribution<double>{}, significance.threshold() / 2));
}

// A sum of pixels, and of what they should be.
struct Total {
    glm::dvec3 value{0}, answer{0}, variance{0};

    void add(const Pixel& pixel, const glm::dvec3& its_answer) {
        value += pixel.mean();
        answer += its_answer;
        variance += pixel.variance();
    }
};

void require_answer(const Renderer& renderer, int bounces, int samples, const auto& answer_at,
                    std::span<const std::string_view> integrators = integrator_names()) {
    constexpr int passes = 8;
    constexpr std::size_t regions = (width / block) * (height / block) + 1;  // the last is the whole
    const double limit = limit_of(3 * regions * integrators.size() * samplers.size());
    for (const auto& [sampler_name, sampler] : samplers) {
        for (const std::string_view integrator : integrators) {
            INFO(sampler_name << ", " << integrator);
            // The one-sample model ends a path, or goes on without light: few paths are long, and count much.
            const int enough = integrator == "one-sample" ? 4 * samples : samples;
            Film film{width, height};
            for (std::uint64_t seed = 1; seed <= passes; ++seed) {
                renderer.add_pass(film, integrator, {bounces, sampler, Filter::Box}, {0, enough}, seed);
            }
            std::vector<Total> blocks(regions - 1);
            Total whole;
            for (int i = 0; i < width * height; ++i) {
                const Pixel& pixel = film.pixels[static_cast<std::size_t>(i)];
                const glm::dvec3 answer = answer_at(i % width, i / width);
                const int at = i / width / block * (width / block) + i % width / block;
                blocks[static_cast<std::size_t>(at)].add(pixel, answer);
                whole.add(pixel, answer);
            }
            blocks.push_back(whole);
            for (std::size_t b = 0; b < blocks.size(); ++b) {
                for (int k = 0; k < 3; ++k) {
                    const double value = blocks[b].value[k], answer = blocks[b].answer[k],
                                 error = std::sqrt(blocks[b].variance[k]);
                    INFO("block " << b << ", channel " << k << ": " << value << " +- " << error << ", not " << answer);
                    CHECK(std::abs(value - answer) <= limit * error + 1e-5 * answer);
                }
            }
            for (int k = 0; k < 3; ++k) {
                CHECK(limit * std::sqrt(whole.variance[k]) <= visible_bias * whole.answer[k]);
            }
        }
    }
}

// The mean over a pixel of a scene's radiance, a function of the ray's direction.
glm::dvec3 mean_over_pixel(const View& view, int x, int y, const auto& radiance) {
    constexpr int points = 8;
    glm::dvec3 sum{0};
    for (int i = 0; i < points * points; ++i) {
        const auto at = [](int first, int k) {
            return static_cast<float>(first) + (static_cast<float>(k) + 0.5f) / points;
        };
        sum += radiance(glm::normalize(glm::dvec3{view.ray<float>(at(x, i % points), at(y, i / points)).direction}));
    }
    return sum / double{points * points};
}

template <class Background>
void require_lit_plane(const Brightness& of, int samples, bool finds_all,
                       std::span<const std::string_view> integrators) {
    using Plane = LitPlane<Background>;
    const View view{Plane::camera(), width, height};
    const SceneRenderer<Plane> renderer{Plane{of}, {width, height, {}}, Plane::camera()};
    const auto answer_at = [&](int x, int y) {
        return mean_over_pixel(view, x, y, [&](const glm::dvec3& w) {
            const double distance = double{Plane::camera().position.y} / -w.y;
            return Plane::radiance({distance * w.x, 0, distance * w.z}, of, finds_all);
        });
    };
    require_answer(renderer, 1, samples, answer_at, integrators);
}

// The share of pixels that are the same in both, up to rounding.
double share_alike(const Film& a, const Film& b) {
    constexpr double tolerance = 1e-4;
    std::size_t alike = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const glm::dvec3 x = a.pixels[i].mean(), y = b.pixels[i].mean();
        alike += glm::length(x - y) <= tolerance * glm::length(x);
    }
    return static_cast<double>(alike) / static_cast<double>(a.pixels.size());
}

}  // namespace

TEST_CASE("a room of one material has the same radiance everywhere") {
    const auto renderer = find_scene("box")->make({width, height, {}});
    for (const int bounces : {0, 4}) {
        CAPTURE(bounces);
        require_answer(*renderer, bounces, 64, [&](int, int) { return Box::radiance(bounces); });
    }
}

TEST_CASE("what loses no light is not seen") {
    // Less than a millionth of what is seen in the glass goes to and fro for longer.
    constexpr int bounces = 64;
    const auto renderer = find_scene("furnace")->make({width, height, {}});
    require_answer(*renderer, bounces, 96, [](int, int) { return glm::dvec3{Furnace::radiance}; });
}

TEST_CASE("a slab of glass lets through what Fresnel and Beer say") {
    const View view{Slab::camera(), width, height};
    const auto renderer = find_scene("slab")->make({width, height, {}});
    for (const int bounces : {2, 16}) {
        CAPTURE(bounces);
        require_answer(*renderer, bounces, 128, [&](int x, int y) {
            return mean_over_pixel(view, x, y, [&](const glm::dvec3& direction) {
                return Slab::radiance(direction, x >= width / 2, bounces);
            });
        });
    }
}

TEST_CASE("a plane receives of every light what its shape says") {
    const auto bsdf_and_rest = integrator_names();
    REQUIRE(bsdf_and_rest[0] == "bsdf");
    const glm::vec3 none{0}, white{1}, reddish{3, 2, 1}, bluish{1, 2, 3};
    require_lit_plane<Sunlight>({.sky = none, .sun = white, .disk = none, .beam = bluish, .points{reddish, bluish}}, 64,
                                true, bsdf_and_rest.subspan(1));
    // The BSDF meets no light without extent. No other integrator may share their light with it.
    const Brightness of{.sky = white, .sun = reddish, .disk = 4.0f * white, .beam = bluish, .points{bluish, reddish}};
    require_lit_plane<SunAndSky<Environment>>(of, 128, false, bsdf_and_rest.first(1));
    require_lit_plane<SunAndSky<Environment>>(of, 64, true, bsdf_and_rest.subspan(1));
}

// Nothing is absorbed in the open: not of light from the sky, infinitely far away. A light tree's densities are those that its
// lights are drawn with.
TEST_CASE("direct light by both techniques is that of light sampling alone") {
    const auto [scene, samples] = GENERATE(std::pair{"glass", 192}, std::pair{"many-lights", 528});
    CAPTURE(scene);
    const auto renderer = find_scene(scene)->make({width, height, {}});
    const auto total = [&, n = samples](std::string_view integrator, std::uint64_t first_seed) {
        Film film{width, height};
        for (std::uint64_t pass = 0; pass < 8; ++pass) {
            renderer->add_pass(film, integrator, {1}, {0, n}, first_seed + pass);
        }
        Total whole;  // of the lower half: in the upper one lights are seen, small and bright
        for (std::size_t i = film.pixels.size() / 2; i < film.pixels.size(); ++i) whole.add(film.pixels[i], {});
        return whole;
    };
    const Total by_both = total("balance", 1), by_light = total("light", 9);
    const double limit = limit_of(2 * 3);
    for (int k = 0; k < 3; ++k) {
        const double error = std::sqrt(by_both.variance[k] + by_light.variance[k]);
        CHECK(std::abs(by_both.value[k] - by_light.value[k]) <= limit * error);
        CHECK(limit * error <= visible_bias * by_both.value[k]);
    }
}

// Sobol points of a sample do not depend on how many are traced at once. Rays that pass an edge by a rounding may differ.
// Optimal weights, learnt from eight samples here, magnify roundings.
TEST_CASE("samples in lanes are what they are alone") {
    const SceneOptions options{width, height, {}};
    const SceneRenderer<Cornell, float> alone{Cornell{}, options, Cornell::camera()};
    const auto in_lanes = find_scene("cornell")->make(options);
    for (const std::string_view integrator : integrator_names()) {
        if (integrator == "optimal") continue;
        INFO(integrator);
        Film one{width, height}, other{width, height};
        alone.add_pass(one, integrator, {}, {0, 8}, 1);
        in_lanes->add_pass(other, integrator, {}, {0, 8}, 1);
        CHECK(share_alike(one, other) >= 0.98);
    }
}
