// docs/guide.md, docs/estimators.md: how many samples to take of which technique.
#include "catch.hpp"
#include <lumis/combine/allocate.hpp>
#include <lumis/combine/multi_sample.hpp>
#include <lumis/combine/optimal.hpp>
#include <lumis/lumis.hpp>

#include <chrono>
#include <random>

TEST_CASE("counts from pilot samples") {
    lumis::Uniforms uniforms{std::mt19937{1}};
    const lumis::CosineHemisphere<float> bsdf;
    const lumis::AreaLight light{lumis::Sphere<float>{{0, 0, 2}, 1}, glm::vec3{0}};
    const auto f = [&](const glm::vec3& wi) { return light.pdf(wi) > 0 ? glm::vec3{wi.z} : glm::vec3{0}; };

    // docs/guide.md
    auto plan = lumis::allocate(lumis::PowerHeuristic{}, lumis::take(1, bsdf), lumis::take(1, light));
    for (int i = 0; i < 256; ++i) plan.add(f, uniforms);
    // A light's sample costs as much as two of the BSDF; both draw all that f sees, so that either may do alone.
    const auto n = plan.counts({.of_sample = {1, 2}}, {.covers = {true, true}, .most_samples = 8});
    const auto direct = lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(n[0], bsdf), lumis::take(n[1], light));
    const glm::vec3 radiance = direct.estimate(f, uniforms);
    // docs/guide.md

    CHECK(n[0] + n[1] >= 1);
    CHECK(n[0] + n[1] <= 8);
    CHECK(radiance.x >= 0);
}
