// Optimal weights for one integral, and for an image whose strategies change with every path.
#include "catch.hpp"
#include <lumis/lumis.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace {

using glm::vec3;

// The host's world: a square lamp of radiance (1, 2, 3) over a floor that reflects all.
const lumis::Parallelogram<float> lamp{{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}};

vec3 reflected(const vec3& wi, const lumis::AreaLight<lumis::Parallelogram<float>>& light) {
    return light.pdf(wi) > 0 ? std::max(wi.z, 0.0f) * std::numbers::inv_pi_v<float> * vec3{1, 2, 3} : vec3{0};
}

// Lambert's formula for a rectangle overhead: what it adds up to at (x, y) of the floor.
double irradiance(double x, double y) {
    const auto corner = [](double a, double b, double h) {
        const double p = std::hypot(a, h), q = std::hypot(b, h);
        return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / 2;
    };
    return corner(1 - x, 1 - y, 2) + corner(1 + x, 1 - y, 2) + corner(1 - x, 1 + y, 2) + corner(1 + x, 1 + y, 2);
}

TEST_CASE("optimal weights for one integral") {
    const lumis::CosineHemisphere<float> bsdf;
    const lumis::AreaLight light{lamp, vec3{0}};
    const auto f = [&](vec3 wi) { return reflected(wi, light); };
    lumis::Uniforms uniforms{std::mt19937{1}};

    auto best = lumis::optimal<vec3>(lumis::take(1, bsdf), lumis::take(1, light));
    for (int round = 0; round < 1000; ++round) best.add(f, uniforms);
    const vec3 radiance = best.estimate(), error = best.standard_error();
    CHECK(std::abs(radiance.y - 2 * irradiance(0, 0) / std::numbers::pi) <= 4 * error.y);
    CHECK(error.y < best.standard_error({}).y);
}

TEST_CASE("optimal weights for an image") {
    const lumis::CosineHemisphere<float> bsdf;
    lumis::Uniforms uniforms{std::mt19937{2}};
    const auto point_of_path = [&] {
        const glm::vec2 u = uniforms.next<2>();
        return vec3{u.x - 0.5f, u.y - 0.5f, 0};
    };
    // The paths of the first pass.
    lumis::CrossFitted<vec3, 2> neighbours;
    for (int path = 0; path < 500; ++path) {
        const lumis::AreaLight light{lamp, point_of_path()};
        const auto f = [&](vec3 wi) { return reflected(wi, light); };
        neighbours.add(lumis::rounds_of(lumis::take(1, bsdf), lumis::take(1, light)).round(f, uniforms));
    }
    const auto alpha = neighbours.weights();

    // The paths of the second pass.
    lumis::RunningMoments<double> green, balance;
    for (int path = 0; path < 20'000; ++path) {
        const lumis::AreaLight light{lamp, point_of_path()};
        const auto f = [&](vec3 wi) { return reflected(wi, light); };
        const auto round = lumis::rounds_of(lumis::take(1, bsdf), lumis::take(1, light)).round(f, uniforms);
        green.add(round.estimate(alpha).y);
        balance.add(round.balanced.y);
    }
    double mean = 0;
    for (double x = -0.475; x < 0.5; x += 0.05) {
        for (double y = -0.475; y < 0.5; y += 0.05) mean += irradiance(x, y) / 400;
    }
    CHECK(std::abs(green.mean() - 2 * mean / std::numbers::pi) <= 4 * green.standard_error());
    CHECK(green.variance() < balance.variance());
}

}  // namespace
