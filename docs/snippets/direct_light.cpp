// The guide's direct light at a point, in a host's world of one lamp.
#include "catch.hpp"
#include "z_test.hpp"
#include <lumis/lumis.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace {

using glm::vec3;

// The host's colours, eight bands of them.
struct Spectrum {
    float bands[8];
    Spectrum() {}  // sets nothing
    explicit Spectrum(float all) { std::fill_n(bands, 8, all); }
};
[[maybe_unused]] Spectrum operator*(Spectrum a, float scale) {
    for (float& band : a.bands) band *= scale;
    return a;
}
[[maybe_unused]] Spectrum operator+(Spectrum a, const Spectrum& b) {
    for (int i = 0; i < 8; ++i) a.bands[i] += b.bands[i];
    return a;
}

}  // namespace

template <>
struct lumis::zero<Spectrum> {
    static Spectrum value() { return Spectrum{0}; }
};

namespace {

// The host's world: a triangle of radiance (1, 2, 3) over the origin, and a floor that reflects all.
const vec3 a{0, 0, 1}, b{1, 0, 1}, c{0, 1, 1};
constexpr double irradiance = 0.302299894039;  // Lambert's formula, radiance 1
constexpr float alpha = 0.6f;

vec3 traced_radiance(const vec3& wi) {
    return lumis::AreaLight{lumis::Triangle{a, b, c}, vec3{0}}.pdf(wi) > 0 ? vec3{1, 2, 3} : vec3{0};
}
float brdf_cos(const vec3& wi) {
    return std::max(wi.z, 0.0f) * std::numbers::inv_pi_v<float>;
}
bool occluded(const vec3& /*position*/, const vec3& /*wi*/, float /*distance*/) {
    return false;
}

vec3 reflected(const vec3& position, const vec3& normal, const vec3& wo, auto& uniforms) {
    const lumis::Frame frame{normal};
    const lumis::GgxReflection bsdf{frame.to_local(wo), glm::vec2{alpha}};
    const lumis::AreaLight light{lumis::Triangle{a, b, c}, position};

    const auto direct =
        multi_sample(lumis::PowerHeuristic{}, lumis::take(1, in_frame(frame, bsdf)), lumis::take(1, light));
    const vec3 radiance = direct.estimate([&](vec3 wi) { return brdf_cos(wi) * traced_radiance(wi); }, uniforms);
    return radiance;
}

TEST_CASE("a BSDF and a light share an estimate") {
    const auto green = [](auto& uniforms) {
        return reflected(vec3{0}, vec3{0, 0, 1}, glm::normalize(vec3{1, 0, 2}), uniforms).y;
    };
    const auto law = z_test<float>(green, 2 * irradiance / std::numbers::pi, 1);
    INFO(law.message);
    CHECK(law.passed);
}

TEST_CASE("a host's own colours") {
    const lumis::AreaLight light{lumis::Triangle{a, b, c}, vec3{0}};
    const auto direct = multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, light));
    const auto band = [&](auto& uniforms) {
        return direct.estimate([](vec3 wi) { return Spectrum{brdf_cos(wi)}; }, uniforms).bands[7];
    };
    const auto law = z_test<float>(band, irradiance / std::numbers::pi, 1);
    INFO(law.message);
    CHECK(law.passed);
}

vec3 texture(const glm::vec2& uv) {
    return {uv.x, uv.y, 1};
}

vec3 reflected_of_panel(const vec3& position, const vec3& normal, const vec3& wo, auto& uniforms) {
    const lumis::Frame frame{normal};
    const lumis::GgxReflection bsdf{frame.to_local(wo), glm::vec2{alpha}};
    const lumis::Triangle<float> triangle{a, c, b};  // its normal points down

    const lumis::SurfaceLight panel{triangle, position, lumis::Sides::One};
    const auto by_panel =
        multi_sample(lumis::PowerHeuristic{}, lumis::take(1, in_frame(frame, bsdf)), lumis::take(1, panel));
    const vec3 lit = by_panel.estimate(
        [&](const lumis::AnySample auto& s) {
            if (!std::isfinite(s.distance) || occluded(position, s.value, s.distance)) return vec3{0};
            return brdf_cos(s.value) * texture(s.surface.uv);
        },
        uniforms);
    return lit;
}

TEST_CASE("a textured light of one side") {
    const auto blue = [](auto& uniforms) {
        return reflected_of_panel(vec3{0}, vec3{0, 0, 1}, glm::normalize(vec3{1, 0, 2}), uniforms).z;
    };
    const auto law = z_test<float>(blue, irradiance / std::numbers::pi, 1);
    INFO(law.message);
    CHECK(law.passed);
}

TEST_CASE("a light by solid angle") {
    const vec3 position{0};
    const lumis::Sphere<float> sphere{{0, 0, 2}, 1};
    const lumis::AreaLight<lumis::Sphere<float>, lumis::BySolidAngle> bulb{sphere, position};
    CHECK(bulb.sample({0.5f, 0.5f}).pdf * bulb.solid_angle() == Approx(1));
}

TEST_CASE("delta strategies ask for a coefficient") {
    const vec3 position{0}, lamp{0, 3, 4}, intensity{25}, color{0.5f}, wo{0, 0, 1};
    lumis::Uniforms uniforms{std::mt19937{1}};

    const auto mirror = multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, lumis::PerfectReflection{wo}));
    const vec3 seen = mirror.estimate([&](vec3 wi, lumis::delta_t) { return color * traced_radiance(wi); }, uniforms);
    CHECK(seen.z == 1.5f);

    const auto bulb = multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, lumis::PointLight{lamp, position}));
    const vec3 lit = bulb.estimate(
        [&](const lumis::AnySample auto& s, lumis::delta_t) {
            if (occluded(position, s.value, s.distance)) return vec3{0};
            return brdf_cos(s.value) * intensity / (s.distance * s.distance);
        },
        uniforms);
    CHECK(lit.x == Approx(0.8 / std::numbers::pi));
}

}  // namespace
