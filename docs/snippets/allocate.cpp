// How many samples to take of which technique, from a pilot.
#include "catch.hpp"
#include <lumis/combine/allocate.hpp>
#include <lumis/combine/optimal.hpp>
#include <lumis/lumis.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>

namespace {

using glm::vec3;

// The irradiance of a sphere of radiance 1.
const lumis::CosineHemisphere<float> cosine;
const lumis::Sphere<float> sphere{{0, 0, 3}, 1};
const lumis::AreaLight<lumis::Sphere<float>, lumis::BySolidAngle> light{sphere, vec3{0}};
const auto f = [](const vec3& wi) { return wi.z > 0 && light.pdf(wi) > 0 ? vec3{wi.z} : vec3{0}; };
constexpr float answer = 3.14159265f / 9;

// The mean of many.
float mean_of(const auto& estimate) {
    float sum = 0;
    for (int i = 0; i < 2000; ++i) sum += estimate();
    return sum / 2000;
}

}  // namespace

TEST_CASE("counts and probabilities from a pilot") {
    lumis::Uniforms uniforms{std::mt19937{1}};

    auto plan = lumis::allocate(lumis::PowerHeuristic{}, lumis::take(1, cosine), lumis::take(1, light));
    for (int i = 0; i < 256; ++i) plan.add(f, uniforms);

    // A sample of the light takes twice the time. Both techniques draw all that f sees: either may do alone.
    const auto n = plan.counts({.of_sample = {1, 2}}, {.covers = {true, true}, .most_samples = 8});
    const auto direct = multi_sample(lumis::PowerHeuristic{}, lumis::take(n[0], cosine), lumis::take(n[1], light));

    // Or one sample, of the one or the other.
    const auto c = plan.probabilities({.of_sample = {1, 2}}, {.covers = {true, true}});
    const auto mixed = one_sample(lumis::PowerHeuristic{}, lumis::choose(c[0], cosine), lumis::choose(c[1], light));

    CHECK(n == std::array{0, 1});
    CHECK(c == std::array{0.0, 1.0});
    CHECK(std::abs(mean_of([&] { return direct.estimate(f, uniforms).x; }) / answer - 1) <= 0.01f);
    CHECK(std::abs(mean_of([&] { return mixed.estimate(f, uniforms).x; }) / answer - 1) <= 0.01f);
}

TEST_CASE("counts for all pixels of a tile") {
    lumis::Uniforms uniforms{std::mt19937{2}};
    const auto pilot_at = [&](float height) {
        const lumis::AreaLight seen{lumis::Sphere<float>{{0, 0, height}, 1}, vec3{0}};
        auto plan = lumis::allocate(lumis::BalanceHeuristic{}, lumis::take(1, cosine), lumis::take(1, seen));
        for (int i = 0; i < 8; ++i) {
            plan.add([&](const vec3& wi) { return wi.z > 0 && seen.pdf(wi) > 0 ? wi.z : 0.0f; }, uniforms);
        }
        return plan;
    };

    auto forecast = pilot_at(1.1f).forecast();
    for (float height = 1.2f; height < 3; height += 0.1f) forecast += pilot_at(height).forecast();
    const auto n = forecast.counts({.of_sample = {1, 2}, .of_estimate = 4}, {.most_samples = 8});

    CHECK(n[0] + n[1] == 8);
}

TEST_CASE("counts for optimal weights") {
    lumis::Uniforms uniforms{std::mt19937{3}};

    auto plan = lumis::allocate(lumis::OptimalWeights{}, lumis::take(1, cosine), lumis::take(1, light));
    for (int i = 0; i < 256; ++i) plan.add(f, uniforms);
    const auto n = plan.counts({.of_sample = {1, 2}}, {.covers = {true, true}});
    auto best = lumis::optimal<vec3>(lumis::take(n[0], cosine), lumis::take(n[1], light));  // 0: a control variate

    for (int i = 0; i < 2000; ++i) best.add(f, uniforms);
    CHECK(std::abs(best.estimate().x / answer - 1) <= 0.01);
}
