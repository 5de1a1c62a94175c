// Every integrator estimates the same image of every scene, but for bsdf, which is blind to lights without extent. All others
// leave what is polished, and so caustics, to directions of the BSDF.
#include "catch.hpp"
#include "coarse_sky.hpp"
#include "folder.hpp"
#include "scenes/scenes.hpp"
#include <lumis/statistics/running_moments.hpp>
#include <lumis/testing/result.hpp>

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace tracer;

constexpr int images = 32;

struct View {
    const Renderer& renderer;
    int width, height, bounces;

    // Luminance of each pixel. Light that the camera sees without a bounce is taken off: all have the same, and small bright
    // lamps would hide the rest in its noise. It is known to the rounding, for one seed gives the same points to both.
    [[nodiscard]] std::vector<double> luminances(std::string_view integrator, int samples, std::uint64_t seed) const {
        Film film{width, height}, emission = film;
        renderer.add_pass(film, integrator, {.bounces = bounces}, {0, samples}, seed);
        renderer.add_pass(emission, integrator, {.bounces = 0}, {0, samples}, seed);
        std::vector<double> result;
        for (std::size_t i = 0; i < film.pixels.size(); ++i) {
            result.push_back(luminance(glm::vec3{film.pixels[i].mean() - emission.pixels[i].mean()}));
        }
        return result;
    }
};

// Images are compared by the mean over pixels of value / expected value, so that highlights do not hide the rest. A rendering
// of its own seed says roughly what is expected: weights that depended on the compared images would bias their means. Pixels
// left of the first column do not count.
std::vector<double> weights(const View& view, int first_column) {
    std::vector<double> result = view.luminances("power", 128, 1);
    const double floor = 0.1 * std::reduce(result.begin(), result.end()) / static_cast<double>(result.size());
    double total = 0;
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double expected = result[i];
        const bool counts = expected > 0 && static_cast<int>(i) % view.width >= first_column;
        result[i] = counts ? 1 / std::max(expected, floor) : 0;
        total += result[i] * expected;
    }
    for (double& weight : result) weight /= total;
    return result;
}

constexpr int block = 8;  // pixels along each side

// The weighted sums of independent images, each of so many samples a pixel: those of blocks, and last of all that of the whole.
std::vector<lumis::RunningMoments<>> moments(const View& view, const std::vector<double>& weights,
                                             std::string_view integrator, int samples, std::uint64_t first_seed) {
    const int across = view.width / block;
    std::vector<lumis::RunningMoments<>> result(static_cast<std::size_t>(across * (view.height / block) + 1));
    for (std::uint64_t i = 0; i < images; ++i) {
        const auto image = view.luminances(integrator, samples, first_seed + i);
        std::vector<double> sums(result.size());
        for (int k = 0; k < view.width * view.height; ++k) {
            const auto pixel = static_cast<std::size_t>(k);
            const int at = k / view.width / block * across + k % view.width / block;
            sums[static_cast<std::size_t>(at)] += weights[pixel] * image[pixel];
            sums.back() += weights[pixel] * image[pixel];
        }
        for (std::size_t part = 0; part < sums.size(); ++part) result[part].add(sums[part]);
    }
    return result;
}

// The largest bias that may go unseen, as a share of the image.
struct Visible {
    double combined, light;  // combined: of balance, one-sample and optimal
    double noisy;            // of bsdf and average, which find small lamps by chance
};

struct Case {
    const char* scene;
    int width, height, bounces;
    Visible bias;
    int first_column = 0;  // where light and average are compared
    bool has_delta_lights = false;
};

constexpr std::size_t all_cases = 17, others = 6, most_parts = 19;

void require_agreement(const Case& one) {
    INFO(one.scene << ", " << one.bounces << " bounces");
    const Folder folder;
    const bool is_sky = one.scene == std::string_view{"sky"};
    if (is_sky) write_image(folder.file("sky.exr"), coarse_sky());
    const auto renderer =
        find_scene(one.scene)->make({one.width, one.height, is_sky ? folder.file("sky.exr") : std::string{}});
    const View view{*renderer, one.width, one.height, one.bounces};

    // False alarms: 1e-3 over all scenes, depths, integrators and blocks (Sidak), by Student's distribution.
    const lumis::testing::Significance significance{1e-3, all_cases * others * most_parts};
    const double limit =
        quantile(complement(boost::math::students_t_distribution<double>{images - 1}, significance.threshold() / 2));

    const auto everywhere = weights(view, 0), on_the_right = weights(view, one.first_column);
    std::uint64_t seed = 1000;
    const auto of_power = moments(view, everywhere, "power", 32, seed);
    const auto of_power_on_the_right =
        one.first_column == 0 ? of_power : moments(view, on_the_right, "power", 32, seed);
    for (const std::string_view integrator : integrator_names()) {
        seed += 1000;
        if (integrator == "power" || (integrator == "bsdf" && one.has_delta_lights)) continue;
        const bool is_noisy = integrator == "bsdf" || integrator == "average";
        const bool finds_mirrored_light_rarely = integrator == "light" || integrator == "average";
        const auto& power = finds_mirrored_light_rarely ? of_power_on_the_right : of_power;
        const auto other = moments(view, finds_mirrored_light_rarely ? on_the_right : everywhere, integrator, 16, seed);
        // Blocks are few pixels: the error of a technique alone is not normal there.
        const std::size_t first = is_noisy || finds_mirrored_light_rarely ? other.size() - 1 : 0;
        double error = 0;
        for (std::size_t part = first; part < other.size(); ++part) {
            const auto &a = other[part], &b = power[part];
            error = std::hypot(a.standard_error(), b.standard_error());
            INFO(integrator << ", block " << part << ": " << a.mean() << ", not " << b.mean() << "; +- " << error);
            CHECK(std::abs(a.mean() - b.mean()) <= limit * error + 1e-6 * b.mean());
            CHECK(a.rejected() + b.rejected() == 0);
        }
        const Visible& seen = one.bias;
        INFO(integrator);
        CHECK(limit * error <= (integrator == "light" ? seen.light : is_noisy ? seen.noisy : seen.combined));
    }
}

}  // namespace

TEST_CASE("integrators agree") {
    // Metals that are nearly smooth stand on the left of sky: light sampling finds what they mirror once in ten thousand samples.
    const auto one = GENERATE(values<Case>({
        {"veach", 32, 24, 1, {0.02, 0.06, 0.6}},
        {"veach", 32, 24, 5, {0.02, 0.06, 0.6}},
        {"veach-metal", 32, 24, 5, {0.03, 0.1, 0.5}},
        {"sky", 48, 24, 1, {0.02, 0.02, 0.04}, 32},
        {"sky", 48, 24, 5, {0.015, 0.03, 0.05}, 32},
        {"cornell", 32, 24, 1, {0.02, 0.02, 0.3}},
        {"cornell", 32, 24, 5, {0.04, 0.03, 0.3}},
        {"box", 16, 16, 1, {0.01, 0.015, 0.01}},
        {"box", 16, 16, 5, {0.015, 0.015, 0.01}},
        {"furnace", 32, 16, 5, {0.05, 0.05, 0.05}},
        {"slab", 16, 16, 5, {0.01, 0.01, 0.01}},
        {"glass", 32, 24, 1, {0.035, 0.03, 0.07}},
        {"glass", 32, 24, 5, {0.03, 0.02, 0.07}},
        {"many-lights", 24, 16, 1, {0.02, 0.02, 0.25}},
        {"sundial", 32, 24, 1, {0.03, 0.03, 0.3}, 0, true},
        {"sundial", 32, 24, 5, {0.03, 0.03, 0.3}, 0, true},
        {"mesh", 24, 16, 1, {0.04, 0.03, 0.6}},
    }));
    require_agreement(one);
}
