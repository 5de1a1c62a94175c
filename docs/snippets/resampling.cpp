// The guide's resampling: many lights with one shadow ray, a light beside a surface, and a neighbour's sample used again.
#include "catch.hpp"
#include "z_test.hpp"
#include <lumis/combine/resample.hpp>
#include <lumis/combine/reservoir.hpp>
#include <lumis/lights/selected_light.hpp>
#include <lumis/lumis.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace {

using glm::vec3;

// Two halves of the square over the origin whose irradiance is Lambert's 1.7408; nothing is hidden.
const std::vector<lumis::Triangle<float>> triangles{{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}},
                                                    {{-1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
const std::vector<float> powers{1, 2};
constexpr double irradiance_of_square = 1.740839502734;
const vec3 position{0};

float reflected(const vec3& wi) {
    return wi.z > 0 ? wi.z : 0.0f;
}
float emitted(std::size_t /*light*/) {
    return 1;
}
bool occluded(const vec3& /*from*/, const vec3& /*direction*/, float /*distance*/) {
    return false;
}

template <class Estimate>
void check_irradiance(const Estimate& estimate) {
    const auto law = z_test<float>(estimate, irradiance_of_square, 1);
    INFO(law.message);
    CHECK(law.passed);
}

TEST_CASE("one shadow ray for eight candidates") {
    const lumis::AliasTable<float> by_power{powers};
    const auto lights = [&](std::size_t i) { return lumis::AreaLight{triangles[i], position}; };

    const lumis::SelectedLight one{lumis::LightSet{lights, by_power}};  // a light by its power, and a direction to it
    const auto unshadowed = [&](const lumis::AnySample auto& s) {
        return emitted(s.value.index) * reflected(s.value.direction);
    };
    const auto direct = lumis::resample(unshadowed, lumis::take(8, one));
    const auto shadowed = [&](const lumis::AnySample auto& s) {
        return occluded(position, s.value.direction, 0.9999f * s.distance) ? 0.0f : unshadowed(s);
    };

    check_irradiance([&](auto& uniforms) {
        const float light = direct.estimate(shadowed, uniforms);
        return light;
    });
    check_irradiance([&](auto& uniforms) {
        float light = 0;
        const auto s = direct.sample(uniforms);
        if (s.contribution_weight > 0) light += shadowed(s.sample) * s.contribution_weight;
        return light;
    });
}

TEST_CASE("candidates of a light and of a surface") {
    const lumis::AreaLight light{lumis::Parallelogram<float>{{-1, -1, 1}, {2, 0, 0}, {0, 2, 0}}, position};
    const lumis::CosineHemisphere<float> bsdf;
    const auto unshadowed = [&](const lumis::AnySample auto& s) {
        return std::isinf(s.distance) ? 0.0f : reflected(s.value);
    };
    const auto both = lumis::resample(unshadowed, lumis::take(4, light), lumis::take(2, bsdf));
    check_irradiance([&](auto& uniforms) { return both.estimate(unshadowed, uniforms); });
}

TEST_CASE("a neighbour's sample is used again") {
    const lumis::AreaLight light{lumis::Parallelogram<float>{{-1, -1, 1}, {2, 0, 0}, {0, 2, 0}}, position};
    const auto target_here = [](const vec3& wi) { return reflected(wi); };
    // The neighbour's surface is tilted: it does not see all of the light.
    const auto target_there = [](const vec3& wi) { return std::max(0.8f * wi.z - 0.6f * wi.x, 0.0f); };
    const auto pixel_here = lumis::resample(target_here, lumis::take(2, light));
    const auto pixel_there = lumis::resample(target_there, lumis::take(6, light));

    check_irradiance([&](auto& uniforms) {
        const auto here = pixel_here.sample(uniforms), there = pixel_there.sample(uniforms);

        lumis::Reservoir<lumis::LightSample<vec3, float>> kept;
        const auto add = [&](const auto& s, auto target, std::size_t candidates) {
            const vec3 wi = s.sample.value;
            const float sum = 2 * target_here(wi) + 6 * target_there(wi);  // candidates times target, of each
            const float mis = sum > 0 ? static_cast<float>(candidates) * target(wi) / sum : 0.0f;
            kept.add(s.sample, mis * target_here(wi) * s.contribution_weight, uniforms.template next<1>().x,
                     candidates);
        };
        add(here, target_here, 2);
        add(there, target_there, 6);
        const float weight = kept.contribution_weight(target_here(kept.item().value));
        return reflected(kept.item().value) * weight;
    });
}

}  // namespace
