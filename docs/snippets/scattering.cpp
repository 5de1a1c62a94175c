// A metal that loses nothing, and a cloud.
#include "catch.hpp"
#include <lumis/lumis.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <random>

using glm::vec3;

// Schlick's approximation.
static vec3 fresnel(const vec3& f0, float cosine) {
    return f0 + (1.0f - f0) * std::pow(1 - cosine, 5.0f);
}

TEST_CASE("a rough metal in a white room") {
    lumis::Uniforms uniforms{std::mt19937{1}};
    const vec3 wo{0, 0.6f, 0.8f}, f0{1, 0.78f, 0.34f};
    const float alpha = 0.8f;

    const lumis::GgxReflection<float> metal{wo, alpha};
    const vec3 compensation = lumis::ggx_compensation(metal.ggx(), wo, f0);  // once for all directions

    // What a light's sample brings is scaled by it, and so is the path's throughput.
    const auto brdf = [&](const vec3& wi) {
        return compensation * fresnel(f0, glm::dot(wo, glm::normalize(wo + wi))) * metal.ggx().brdf(wo, wi);
    };
    const auto throughput = [&](const vec3& wi) {
        return compensation * fresnel(f0, glm::dot(wo, glm::normalize(wo + wi))) * metal.weight(wi);
    };

    vec3 reflected{0};
    for (int i = 0; i < 20'000; ++i) {
        const auto drawn = metal.sample(uniforms.next<2>());
        if (drawn.pdf > 0) reflected += throughput(drawn.value) / 20'000.0f;
    }
    CHECK(std::abs(reflected.x - 1) <= 0.01f);
    const vec3 wi = glm::normalize(vec3{0.3f, -0.5f, 0.8f});
    CHECK(std::abs(brdf(wi).y * wi.z / metal.pdf(wi) / throughput(wi).y - 1) <= 1e-5f);
}

TEST_CASE("a path through a cloud") {
    lumis::Uniforms uniforms{std::mt19937{2}};
    const vec3 wo{0, 0, 1};
    const float g = 0.85f, albedo = 0.99f;

    const lumis::HenyeyGreenstein phase{wo, g};
    const auto drawn = phase.sample(uniforms.next<2>());  // goes on along drawn.value, away from the point
    const float throughput = albedo;                      // times phase.pdf(w) / drawn.pdf, which is 1
    const float towards_light = albedo * phase.pdf(vec3{0, 0, -1});

    CHECK(glm::dot(drawn.value, -wo) > 0);
    CHECK(throughput < towards_light);
}
