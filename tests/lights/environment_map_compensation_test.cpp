// MIS compensation of environment maps: the density goes where the light stands out, and the combination stays unbiased.
#include "catch.hpp"
#include "irradiance.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/stability.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t width = 32, height = 16;

// A sky that fades towards the horizon, noisy, with a sun of a few texels.
template <class T>
std::vector<T> sunny(double sun) {
    std::mt19937_64 engine{5};
    std::uniform_real_distribution<double> noise{0.5, 1.5};
    std::vector<T> texels(width * height);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const double row = static_cast<double>(i / width);
        texels[i] = static_cast<T>((row < 8 ? 1 - row / 16 : 0.2) * noise(engine));
    }
    texels[4 * width + 20] = texels[4 * width + 21] = static_cast<T>(sun);
    return texels;
}

double row_edge(std::size_t y) {
    return pi * static_cast<double>(y) / static_cast<double>(height);
}

double solid_angle(std::size_t y) {
    return 2 * pi / static_cast<double>(width) * (std::cos(row_edge(y)) - std::cos(row_edge(y + 1)));
}

// On a plane that faces up; each texel's integral of the cosine in closed form.
template <class T>
double irradiance_of(const std::vector<T>& texels) {
    double sum = 0;
    for (std::size_t i = 0; i < width * height / 2; ++i) {
        const double top = std::sin(row_edge(i / width)), bottom = std::sin(row_edge(i / width + 1));
        sum += double{texels[i]} * pi / static_cast<double>(width) * (bottom * bottom - top * top);
    }
    return sum;
}

template <class T>
double mean_of(const std::vector<T>& texels) {
    double sum = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) sum += double{texels[i]} * solid_angle(i / width);
    return sum / (4 * pi);
}

// The texel that a direction points at, told without the library.
template <class T>
std::size_t texel_of(const glm::vec<3, T>& w) {
    const double u = 0.5 + std::atan2(double{w.z}, double{w.x}) / (2 * pi);
    const double v = std::atan2(std::hypot(double{w.x}, double{w.z}), double{w.y}) / pi;
    return std::min(static_cast<std::size_t>(v * height), height - 1) * width +
           std::min(static_cast<std::size_t>(u * width), width - 1);
}

glm::dvec3 centre(std::size_t texel) {
    const double phi = 2 * pi * ((static_cast<double>(texel % width) + 0.5) / width - 0.5);
    const double theta = pi * (static_cast<double>(texel / width) + 0.5) / height;
    return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

template <class T>
lumis::EnvironmentMap<T> map_of(const std::vector<T>& texels, bool compensated) {
    return {width, height, texels, {lumis::Interpolation::Nearest, compensated}};
}

// Direct light on a diffuse plane that faces up.
template <class T>
auto estimator(const lumis::EnvironmentMap<T>& map, const auto& heuristic) {
    const lumis::Frame<T> up{glm::vec<3, T>{T(0), T(1), T(0)}};
    return lumis::multi_sample(heuristic, lumis::take(1, map),
                               lumis::take(1, lumis::in_frame(up, lumis::CosineHemisphere<T>{})));
}

template <class T>
auto radiance_times_cosine(const std::vector<T>& texels) {
    return [&](const glm::vec<3, T>& w) { return w.y > 0 ? texels[texel_of(w)] * w.y : T(0); };
}

}  // namespace

TEMPLATE_TEST_CASE("a compensated map and a BSDF together are unbiased", "[environment_map]", float, double) {
    using T = TestType;
    for (const double sun : {3.0, 100.0, 1e4}) {
        const auto texels = sunny<T>(sun);
        const auto map = map_of(texels, true);
        const auto f = radiance_times_cosine(texels);
        const double answer = irradiance_of(texels);
        const auto check = [&](const char* how, const auto& combination) {
            irradiance::check_unbiased<T>(
                lumis::testing::detail::text(how, ", sun ", sun),
                [&](auto& uniforms) { return combination.estimate(f, uniforms); }, answer);
        };
        check("balance", estimator(map, lumis::BalanceHeuristic{}));
        check("power", estimator(map, lumis::PowerHeuristic{}));
    }
}

TEMPLATE_TEST_CASE("compensation takes the mean off every texel", "[environment_map]", float, double) {
    using T = TestType;
    const auto texels = sunny<T>(100);
    const auto map = map_of(texels, true);
    const double mean = mean_of(texels);
    double left = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        left += std::fmax(double{texels[i]} - mean, 0) * solid_angle(i / width);
    }
    std::size_t below = 0, wrong = 0;
    double mass = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const double pdf = map.pdf(glm::vec<3, T>(centre(i))), expected = std::fmax(double{texels[i]} - mean, 0) / left;
        below += expected == 0;
        wrong += (pdf > 0) != (expected > 0) || !(std::abs(pdf - expected) <= 1e-5 + 1e-4 * expected);
        mass += pdf * solid_angle(i / width);
    }
    CHECK(wrong == 0);
    CHECK(below > 100);
    CHECK(std::abs(mass - 1) <= 1e-6);
    auto uniforms = irradiance::uniforms<T>(1);
    for (int i = 0; i < 5000; ++i) {
        const auto sample = map.sample(uniforms.template next<2>());
        REQUIRE(sample.pdf > 0);
        REQUIRE(double{texels[texel_of(sample.value)]} > mean);
    }
}

TEMPLATE_TEST_CASE("compensation never leaves a map without density", "[environment_map]", float, double) {
    using T = TestType;
    const auto check_even = [](const lumis::EnvironmentMap<T>& map) {
        CHECK_FALSE(map.empty());
        for (const auto& w : {glm::dvec3{0.48, 0.64, 0.6}, {-0.48, -0.64, 0.6}, {0.1, 0.99, 0.1}}) {
            CHECK(std::abs(double{map.pdf(glm::vec<3, T>(glm::normalize(w)))} * 4 * pi - 1) <= 1e-4);
        }
    };
    for (const double level : {1.0, 0.1, 1e-30, 1e30, 0.7}) {
        for (const auto interpolation : {lumis::Interpolation::Nearest, lumis::Interpolation::Bilinear}) {
            const std::vector<T> even(width * height, static_cast<T>(level));
            check_even({width, height, even, {interpolation, true}});
            check_even({1, 1, std::vector<T>{static_cast<T>(level)}, {interpolation, true}});
            check_even({5, 7, std::vector<T>(35, static_cast<T>(level)), {interpolation, true}});
        }
    }
    // Nearly even: whatever is left over has a density.
    for (const double contrast : {1e-7, 1e-6, 1e-5, 1e-3}) {
        std::vector<T> texels(width * height, T(0.7));
        texels[77] = static_cast<T>(0.7 * (1 + contrast));
        const auto map = map_of(texels, true);
        CHECK_FALSE(map.empty());
        CHECK(map.sample({T(0.3), T(0.4)}).pdf > 0);
        const auto law = lumis::testing::stays_finite(map);
        INFO(law.message);
        CHECK(law.passed);
    }
    const lumis::EnvironmentMap<T> black{width, height, std::vector<T>(width * height), {{}, true}};
    CHECK(black.empty());
    CHECK(black.sample({T(0.3), T(0.4)}).pdf == 0);
}

// At equal numbers of samples; the time is the same as well, since only the weights in the tables differ.
TEST_CASE("compensation lowers the variance of direct light under a sun", "[environment_map]") {
    for (const double sun : {30.0, 300.0}) {
        const auto texels = sunny<double>(sun);
        const auto f = radiance_times_cosine(texels);
        const auto variance = [&](bool compensated) {
            const auto map = map_of(texels, compensated);
            const auto combination = estimator(map, lumis::BalanceHeuristic{});
            auto uniforms = irradiance::uniforms<double>(9);
            lumis::RunningMoments<double> moments;
            for (int i = 0; i < 200'000; ++i) moments.add(combination.estimate(f, uniforms));
            return moments.variance();
        };
        const double plain = variance(false), compensated = variance(true);
        INFO("sun " << sun << ": " << plain << " to " << compensated << ", ratio " << plain / compensated);
        CHECK(compensated <= 0.9 * plain);
    }
}
