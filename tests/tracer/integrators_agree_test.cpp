// Every integrator estimates the same image: a bias of one, or of what all but one share, shows as a difference.
#include "catch.hpp"
#include "folder.hpp"
#include "renderer.hpp"
#include <lumis/statistics/running_moments.hpp>
#include <lumis/testing/result.hpp>

#include <boost/math/distributions/normal.hpp>

#include <string>
#include <vector>

namespace {

using namespace tracer;

constexpr int block = 8;  // pixels along each side
constexpr int passes = 64;

// Moments over passes of each block's mean luminance, and last of all that of the whole image.
std::vector<lumis::RunningMoments<>> block_moments(const Renderer& renderer, int width, int height,
                                                   std::string_view integrator, int samples, std::uint64_t seed) {
    const int across = width / block, down = height / block;
    std::vector<lumis::RunningMoments<>> moments(static_cast<std::size_t>(across * down) + 1);
    for (std::uint64_t pass = 0; pass < passes; ++pass) {
        Film film{width, height};
        renderer.add_pass(film, integrator, samples, seed, pass);
        const Image image = film.image();
        std::vector<double> sums(moments.size());
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const double value = luminance(image.pixels[static_cast<std::size_t>(y * width + x)]);
                sums[static_cast<std::size_t>(y / block * across + x / block)] += value / (block * block);
                sums.back() += value / (width * height);
            }
        }
        for (std::size_t b = 0; b < sums.size(); ++b) moments[b].add(sums[b]);
    }
    return moments;
}

// The shipped sky, each of its texels the mean of 8 x 8. Directions of the BSDF meet the sun of the whole one so rarely, three
// times in a block, that their error is not normal.
Image coarse_sky() {
    constexpr int factor = 8;
    const Image fine = read_image(LUMIS_EXAMPLES_DATA "/venice_sunset_1k.hdr");
    Image coarse{fine.width / factor, fine.height / factor, {}};
    coarse.pixels.resize(fine.pixels.size() / (factor * factor));
    for (int y = 0; y < fine.height; ++y) {
        for (int x = 0; x < fine.width; ++x) {
            coarse.pixels[static_cast<std::size_t>(y / factor * coarse.width + x / factor)] +=
                fine.pixels[static_cast<std::size_t>(y * fine.width + x)] / float{factor * factor};
        }
    }
    return coarse;
}

// samples: a pixel and pass.
void require_agreement(std::string_view scene_name, int width, int height, int samples,
                       const std::string& environment = {}) {
    const auto renderer = find_scene(scene_name)->make({width, height, environment});
    const auto power = block_moments(*renderer, width, height, "power", samples, 1);
    const lumis::testing::Significance significance{1e-4, (integrator_names.size() - 1) * power.size()};
    const boost::math::normal_distribution<double> normal;
    const double limit = quantile(complement(normal, significance.threshold() / 2));
    for (std::size_t i = 0; i < integrator_names.size(); ++i) {
        if (integrator_names[i] == "power") continue;
        const auto other = block_moments(*renderer, width, height, integrator_names[i], samples, i + 2);
        for (std::size_t b = 0; b < power.size(); ++b) {
            INFO(scene_name << ", " << integrator_names[i] << ", block " << b << ": " << other[b].mean() << " +- "
                            << other[b].standard_error() << " against " << power[b].mean() << " +- "
                            << power[b].standard_error());
            const double error = std::hypot(other[b].standard_error(), power[b].standard_error());
            const double difference = std::abs(other[b].mean() - power[b].mean());
            // What all see alike (the sky itself) has no error but rounding.
            CHECK(difference <= limit * error + 1e-6 * power[b].mean());
            CHECK(power[b].rejected() + other[b].rejected() == 0);
        }
    }
    // The image as a whole is known so well that the test would see a bias of 0.5 % of power.
    CHECK(limit * power.back().standard_error() <= 0.005 * power.back().mean());
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
