// The guide's sets of lights: of one type, made as they are asked for; selected by a light tree; and of several kinds by
// std::variant.
#include "catch.hpp"
#include "z_test.hpp"
#include <lumis/lumis.hpp>

#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

namespace {

using glm::vec3;

// Two halves of the square over the origin whose irradiance is Lambert's 1.7408.
const std::vector<lumis::Triangle<float>> triangles{{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}},
                                                    {{-1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
const std::vector<float> powers{1, 2};
constexpr double irradiance_of_square = 1.740839502734;

// A light of either shape, as seen from a point.
template <class Shape>
using BySolidAngle = lumis::AreaLight<Shape, lumis::BySolidAngle>;
using AnyLight =
    lumis::VariantStrategy<std::variant<BySolidAngle<lumis::Sphere<float>>, BySolidAngle<lumis::Parallelogram<float>>>>;

template <class Shape>
BySolidAngle<Shape> by_solid_angle(const Shape& shape, const vec3& position) {
    return {shape, position};
}

// The irradiance that a set of lights of radiance 1 gives at the origin.
template <class Set>
void check_irradiance(const Set& set, double answer) {
    const auto direct = multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, set));
    const auto cosine = [&](const vec3& w) { return w.z > 0 ? w.z : 0.0f; };
    const auto law = z_test<float>([&](auto& uniforms) { return direct.estimate(cosine, uniforms); }, answer, 1);
    INFO(law.message);
    CHECK(law.passed);
}

TEST_CASE("one shadow ray to the nearest light") {
    // A square of radiance 2 hides part of one of radiance 1 behind it.
    const vec3 position{0};
    const lumis::Parallelogram<float> front{{-1, -1, 1}, {2, 0, 0}, {0, 2, 0}},
        back{{-2, -2, 1.5f}, {4, 0, 0}, {0, 4, 0}};
    const auto radiance_at = [](const vec3& point) { return point.z < 1.25f ? 2.0f : 1.0f; };
    const auto occluded = [](const vec3& /*from*/, const vec3& /*direction*/, float /*distance*/) { return false; };
    const auto brdf_cos = [](const vec3& wi) { return wi.z; };
    const lumis::CosineHemisphere<float> bsdf;
    const lumis::AreaLight near{front, position}, far{back, position};

    const auto direct =
        multi_sample(lumis::PowerHeuristic{}, lumis::take(1, bsdf), lumis::take(1, near), lumis::take(1, far));
    const auto reflected = [&](const lumis::AnySample auto& s) {
        if (std::isinf(s.distance)) return 0.0f;  // no light in this direction
        if (occluded(position, s.value, 0.9999f * s.distance)) return 0.0f;
        return brdf_cos(s.value) * radiance_at(position + s.distance * s.value);
    };

    constexpr double irradiance_of_both = 2 * irradiance_of_square + 0.418331512381;
    const auto law =
        z_test<float>([&](auto& uniforms) { return direct.estimate(reflected, uniforms); }, irradiance_of_both, 1);
    INFO(law.message);
    CHECK(law.passed);
}

TEST_CASE("a set of lights of one type") {
    const vec3 position{0};
    const lumis::AliasTable<float> by_power{powers};  // once
    const auto lights = [&](std::size_t i) { return lumis::AreaLight{triangles[i], position}; };
    const lumis::LightSet set{lights, by_power};  // at each point; allocates nothing
    check_irradiance(set, irradiance_of_square);
}

TEST_CASE("a light tree") {
    const vec3 position{0}, normal{0, 0, 1};
    const std::vector<float> radiance{1, 1};
    const auto lights = [&](std::size_t i) { return lumis::AreaLight{triangles[i], position}; };
    const lumis::CosineHemisphere<float> bsdf;
    const auto brdf_cos = [](const vec3& wi) { return wi.z > 0 ? wi.z : 0.0f; };
    const auto is_visible = [](std::size_t, const vec3&) { return true; };
    const auto first_light = [](const vec3& wi) {
        const bool is_met = std::abs(wi.x) < wi.z && std::abs(wi.y) < wi.z;
        return !is_met ? lumis::no_light : wi.y < wi.x ? std::size_t{0} : std::size_t{1};
    };

    std::vector<lumis::LightBounds<float>> bounds;
    for (std::size_t i = 0; i < triangles.size(); ++i) bounds.push_back(light_bounds(triangles[i], radiance[i]));
    const lumis::LightTree tree{bounds};  // once

    const lumis::SelectedLight one{lumis::LightSet{lights, tree.from(position, normal)}};  // at each point
    const lumis::MetLight met{one, bsdf, first_light};  // first_light(wi): that which a ray meets, or lumis::no_light
    const auto direct = multi_sample(lumis::PowerHeuristic{}, lumis::take(1, met), lumis::take(1, one));
    const auto reflected = [&](const lumis::ToLight<vec3>& x) {
        return is_visible(x.index, x.direction) ? radiance[x.index] * brdf_cos(x.direction) : 0.0f;
    };

    const auto law =
        z_test<float>([&](auto& uniforms) { return direct.estimate(reflected, uniforms); }, irradiance_of_square, 1);
    INFO(law.message);
    CHECK(law.passed);
}

TEST_CASE("a set of lights of several kinds") {
    using Shape = std::variant<lumis::Sphere<float>, lumis::Parallelogram<float>>;
    const std::vector<Shape> shapes{lumis::Parallelogram<float>{{-1, -1, 1}, {2, 0, 0}, {0, 2, 0}},
                                    lumis::Sphere<float>{{2, 0, 0}, 1}};
    constexpr double irradiance_of_sphere = 0.0905860737;  // half of it is below the horizon
    const vec3 position{0};
    const lumis::AliasTable<float> by_power{powers};

    const auto lights = [&](std::size_t i) {
        return std::visit([&](const auto& shape) { return AnyLight{by_solid_angle(shape, position)}; }, shapes[i]);
    };
    const lumis::LightSet set{lights, by_power};
    check_irradiance(set, irradiance_of_square + irradiance_of_sphere);
}

}  // namespace
