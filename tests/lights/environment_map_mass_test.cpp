// The widest maps: a texel's mass in float is the frequency drawn; and directions lead back to their uniforms.
#include "catch.hpp"
#include "irradiance.hpp"
#include <lumis/lights/environment_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace {

constexpr double pi = std::numbers::pi;

template <class T>
std::vector<T> random_texels(std::size_t size, double decades) {
    std::mt19937_64 engine{7};
    std::uniform_real_distribution<double> exponent{-decades, 0};
    std::vector<T> texels(size);
    for (auto& texel : texels) texel = static_cast<T>(std::pow(10, exponent(engine)));
    return texels;
}

}  // namespace

// All 2^24 uniforms of a row 8192 wide, with texels from black to one that outshines the others by 1e8.
TEMPLATE_TEST_CASE("float: the mass of every texel of a row of 8192 is the frequency drawn", "[environment_map]",
                   lumis::EnvironmentMap<float>, lumis::AliasEnvironmentMap<float>) {
    constexpr std::size_t width = 8192, height = 3, row = 1;
    auto texels = random_texels<float>(width * height, 4);
    for (std::size_t x = 0; x < width; x += 7) texels[row * width + x] = 0;
    texels[row * width + 4095] = 1e4f;
    const TestType map{width, height, texels};
    std::vector<std::uint32_t> drawn(width);
    for (std::uint32_t k = 0; k < 1u << 24; ++k) {
        const auto w = map.sample({static_cast<float>(k) * 0x1p-24f, 0.5f}).value;
        const double u = 0.5 + std::atan2(double{w.z}, double{w.x}) / (2 * pi);
        ++drawn[std::min(static_cast<std::size_t>(u * width), width - 1)];
    }
    // The row's own mass is common to all of its texels: densities are in proportion to counts.
    const double all = 0x1p24, equator = pi / 2;
    double worst = 0, row_mass = 0;
    std::size_t wrong = 0;
    std::vector<double> told(width);
    for (std::size_t x = 0; x < width; ++x) {
        const double phi = 2 * pi * ((static_cast<double>(x) + 0.5) / width - 0.5);
        told[x] =
            map.pdf({static_cast<float>(std::cos(phi) * std::sin(equator)), 0.0f, static_cast<float>(std::sin(phi))});
        row_mass += told[x];
    }
    for (std::size_t x = 0; x < width; ++x) {
        wrong += (drawn[x] > 0) != (texels[row * width + x] > 0) || (told[x] > 0) != (drawn[x] > 0);
        worst = std::fmax(worst, std::abs(told[x] / row_mass * all - drawn[x]) / std::fmax(drawn[x], 1));
    }
    CHECK(wrong == 0);
    CHECK(worst <= 4 * double{std::numeric_limits<float>::epsilon()});
}

TEMPLATE_TEST_CASE("a direction leads back to the uniforms that an environment drew it by", "[environment_map]", float,
                   double) {
    using T = TestType;
    struct Size {
        std::size_t width, height;
    };
    for (const auto& [width, height] : {Size{1, 1}, Size{7, 1}, Size{1, 5}, Size{16, 8}, Size{512, 256}}) {
        const lumis::EnvironmentMap map{width, height, random_texels<T>(width * height, 2)};
        auto uniforms = irradiance::uniforms<T>(4);
        double worst = 0;
        for (int i = 0; i < 5000; ++i) {
            const auto u = uniforms.template next<2>();
            const auto sample = map.sample(u);
            const auto back = map.invert(sample.value);
            // What the direction's rounding amounts to on the map, by its density; at a pole its azimuth has no meaning.
            const double sine = std::hypot(double{sample.value.x}, double{sample.value.z});
            const double blur = double{std::numeric_limits<T>::epsilon()} * (1 + double{sample.pdf}) *
                                (8 + static_cast<double>(width + height));
            const double turn = std::abs(double{back.x} - double{u.x});
            worst = std::fmax(worst, std::fmin(turn, 1 - turn) * sine / blur);
            worst = std::fmax(worst, std::abs(double{back.y} - double{u.y}) / blur);
            if (!(back.x >= 0 && back.x <= 1 && back.y >= 0 && back.y <= 1)) worst = 1e9;
        }
        INFO(width << " x " << height << ": " << worst);
        CHECK(worst <= 4);
    }
}
