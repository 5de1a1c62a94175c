#include "lights/environment.hpp"

#include "catch.hpp"
#include <lumis/lumis.hpp>

#include <numbers>
#include <random>

namespace {

using tracer::Environment;
using tracer::Image;

Image checkered(int width, int height) {
    Image map{width, height, {}};
    for (int i = 0; i < width * height; ++i) map.pixels.emplace_back((i * 7 % 5) < 2 ? 3.0f * float(i % 3) : 0.0f);
    return map;
}

}  // namespace

TEST_CASE("radiance at a texel's centre is the texel's") {
    const Image map = checkered(12, 6);
    const Environment environment{map};
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 12; ++x) {
            const float theta = std::numbers::pi_v<float> * (float(y) + 0.5f) / 6;
            const float phi = 2 * std::numbers::pi_v<float> * ((float(x) + 0.5f) / 12 - 0.5f);
            const glm::vec3 w{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
            CHECK(std::abs(environment.radiance(w).r - map.pixels[std::size_t(y * 12 + x)].r) <= 1e-4f);
        }
    }
}

TEST_CASE("beyond its edges a map goes on: around the horizon from the other side, at the poles as the last row") {
    const Environment environment{
        {4, 2, {{1, 0, 0}, {0, 0, 0}, {0, 0, 0}, {3, 0, 0}, {5, 0, 0}, {0, 0, 0}, {0, 0, 0}, {9, 0, 0}}}};
    const auto at_seam = [&](float cosine) {
        return environment.radiance(glm::vec3{-std::sqrt(1 - cosine * cosine), cosine, 0.0f}).r;
    };
    CHECK(std::abs(at_seam(0.9f) - 2) <= 1e-5f);
    CHECK(std::abs(at_seam(0.0f) - 4.5f) <= 1e-5f);
    CHECK(std::abs(at_seam(-0.9f) - 7) <= 1e-5f);
}

TEST_CASE("where there is radiance there is density") {
    const Environment environment{checkered(12, 6)};
    std::mt19937 engine{3};
    lumis::Uniforms uniforms{engine};
    for (int i = 0; i < 100'000; ++i) {
        const glm::vec2 u = uniforms.next<2>();
        const glm::vec3 w = lumis::direction_at(2 * u.x, u.y);
        if (environment.radiance(w).r > 0) CHECK(environment.strategy(false).pdf(w) > 0);
    }
}
