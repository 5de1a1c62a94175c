// Two renderings agree within their noise, and one that is off in one corner does not.
#include "agreement.hpp"

#include "catch.hpp"

#include <cmath>
#include <limits>
#include <random>

using namespace convergence;

namespace {

tracer::Image noisy(std::uint64_t seed) {
    std::mt19937_64 engine{seed};
    std::lognormal_distribution<float> noise{0, 0.5f};
    tracer::Image image{100, 70, {}};
    for (int i = 0; i < 7000; ++i) image.pixels.emplace_back(noise(engine));
    return image;
}

bool agree(const tracer::Image& a, const tracer::Image& b) {
    const Agreement result = agreement(a, b);
    return result.worst_z <= result.limit;
}

}  // namespace

TEST_CASE("images of the same noise agree") {
    for (std::uint64_t seed = 0; seed < 50; ++seed) CHECK(agree(noisy(2 * seed), noisy(2 * seed + 1)));
    CHECK(agreement(noisy(1), noisy(1)).worst_z == 0);
    CHECK(agreement(noisy(1), noisy(2)).blocks == 7 * 5);
}

TEST_CASE("a bias in one corner is found") {
    tracer::Image off = noisy(1);
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) off.pixels[static_cast<std::size_t>(y * 100 + x)] *= 1.4f;
    }
    CHECK_FALSE(agree(off, noisy(2)));
    CHECK_FALSE(agree(noisy(2), off));
}

TEST_CASE("a pixel that is not a number is no agreement") {
    tracer::Image broken = noisy(1);
    broken.pixels[5000].y = std::numeric_limits<float>::quiet_NaN();
    CHECK_FALSE(agree(broken, noisy(2)));
}
