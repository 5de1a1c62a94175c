// Materials: lanes of them are single ones, and each scatters what it should. The answers are quadratures in double.
#include "assertions.hpp"
#include "catch.hpp"
#include "material_lanes.hpp"
#include "material_subjects.hpp"
#include "paths/packet.hpp"
#include "white_furnace.hpp"
#include <lumis/testing/materials.hpp>
#include <lumis/testing/unbiased.hpp>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace {

namespace laws = lumis::testing;
using namespace subjects;

// The mean of scattered light times g(wi) over its density, for samples of the strategy, is the quadrature of it.
template <class M>
laws::UnbiasedResult samples_agree(const M& material, const glm::dvec3& wo, const auto& g) {
    const auto bsdf = material.strategy(glm::vec3{wo});
    lumis::Uniforms<std::mt19937, float> uniforms{std::mt19937{1}};
    const auto estimate = [&] {
        const auto drawn = bsdf.sample(uniforms.template next<bsdf.dimensions>());
        if (!(drawn.pdf > 0)) return 0.0f;
        return bsdf.evaluate(drawn.value).reflected.y * (static_cast<float>(g(glm::dvec3{drawn.value})) / drawn.pdf);
    };
    return laws::unbiased(estimate, quadrature(material, wo, g), {100'000, {1e-4, 20}, 1e-4});
}

double reflected_of_white_sky(const auto& material, const glm::dvec3& wo) {
    return quadrature(material, wo, [](const glm::dvec3&) { return 1.0; });
}

}  // namespace

TEST_CASE("materials in lanes scatter as each alone", "[materials]") {
    const auto check = [](auto name, const auto& material) {
        INFO(name);
        LanesAndNumbers comparison{material};
        for (int i = 0; i < 300; ++i) comparison.run(i % 2 == 1);
    };
    for_each_rough(check);
    for_each_polished(check);
}

TEST_CASE("samples of a material, by their density, add up to what it scatters", "[materials]") {
    const auto g = [](const glm::dvec3& wi) { return 1 + 0.5 * wi.x - 0.3 * wi.y + 0.1 * wi.z; };
    for_each_rough([&](auto name, const auto& material) {
        for (const auto& wo : viewed_from(material)) {
            const auto law = samples_agree(material, wo, g);
            INFO(label(name, ", wo ", wo) << ": " << law);
            CHECK(law.passed);
        }
    });
}

TEST_CASE("what enters by one direction and leaves by another does so the other way as well", "[materials]") {
    for_each_rough([](auto name, const auto& material) {
        using M = std::remove_cvref_t<decltype(material)>;
        if constexpr (!requires { material.metal; }) {
            // Radiance over the squared index is what is reciprocal.
            const auto f = [wide = in_double(material)](const glm::dvec3& wo, const glm::dvec3& wi) {
                const double n = M::transmits && wo.z < 0 ? double{glass_index} : 1;
                return wide.strategy(wo).evaluate(wi).reflected / (std::abs(wi.z) * n * n);
            };
            const auto law = laws::is_reciprocal(f, {.both_sides = M::transmits, .pairs = 2000});
            INFO(name << ": " << law);
            CHECK(law.passed);
        }
    });
}

namespace {

using Complex = std::complex<double>;

// Unpolarised reflectance by the textbook (Born and Wolf 1999, section 1.5.2).
double fresnel(double cosine, Complex eta) {
    const Complex refracted = std::sqrt(1.0 - (1 - cosine * cosine) / (eta * eta));
    const Complex s = (cosine - eta * refracted) / (cosine + eta * refracted);
    const Complex p = (eta * cosine - refracted) / (eta * cosine + refracted);
    return (std::norm(s) + std::norm(p)) / 2;
}

// D G2 / (4 wo.z wi.z) with Fresnel's reflectance 1 (Heitz 2014, eq. 85, 99), and the cosine at the normal half-way.
struct Facets {
    double brdf, cosine;

    Facets(const glm::dvec3& wo, const glm::dvec3& wi, double alpha) {
        const glm::dvec3 wm = glm::normalize(wo + wi);
        const double square = (wm.x * wm.x + wm.y * wm.y) / (alpha * alpha) + wm.z * wm.z;
        const glm::dvec2 both{alpha};
        const double seen = 1 / (1 + white_furnace::lambda(wo, both) + white_furnace::lambda(wi, both));
        brdf = seen / (std::numbers::pi * alpha * alpha * square * square * 4 * wo.z * wi.z);
        cosine = glm::dot(wo, wm);
    }
};

}  // namespace

TEST_CASE("metals and coats reflect as the textbook has it", "[materials]") {
    constexpr double a = double{roughness}, pi = std::numbers::pi;
    const glm::dvec3 albedo{0.07, 0.09, 0.13}, eta{silver.eta}, k{silver.k};
    const Metal<double> metal{{eta, k}, a}, white{{glm::dvec3{0}, glm::dvec3{1}}, a};
    const Coated<double> coated{albedo, a, 2};
    std::mt19937 engine{1};
    std::uniform_real_distribution<double> uniform;
    const auto above = [&] {
        const double versine = 0.99 * uniform(engine), turn = uniform(engine);
        return lumis::direction_at(versine, turn);
    };
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 wo = above(), wi = above();
        const Facets facets{wo, wi, a};
        const auto require_close = [&](const auto& material, double expected, int channel) {
            const double value = material.strategy(wo).evaluate(wi).reflected[channel];
            REQUIRE(std::abs(value / (expected * wi.z) - 1) <= 1e-10);
        };
        for (int c = 0; c < 3; ++c) {
            require_close(metal, facets.brdf * fresnel(facets.cosine, {eta[c], k[c]}), c);
            require_close(coated, facets.brdf * fresnel(facets.cosine, 2) + albedo[c] / pi, c);
        }
        require_close(white, facets.brdf, 0);
        const Diffuse<double> diffuse{albedo};
        require_close(diffuse, albedo.z / pi, 2);
        require_close(Blend<Metal<double>, Diffuse<double>>{white, diffuse, 0.2},
                      0.8 * facets.brdf + 0.2 * albedo.z / pi, 2);
        const glm::dvec3 seen = Mirror<double>{{eta, k}}.strategy(wo).coefficient(wi);
        REQUIRE(std::abs(seen.x / fresnel(wo.z, {eta.x, k.x}) - 1) <= 1e-10);
    }
}

TEST_CASE("nothing passes through what does not transmit", "[materials]") {
    const auto up = direction(0.6, 1), down = -direction(0.3, 2);
    for_each_rough([&](auto name, const auto& material) {
        if (material.transmits) return;
        INFO(name);
        for (const auto& [wo, wi] : {std::pair{up, down}, {down, up}, {down, down}}) {
            CHECK(material.strategy(glm::vec3{wo}).evaluate(glm::vec3{wi}).reflected == glm::vec3{0});
        }
    });
    const auto mirror = Mirror<float>{silver}.strategy(glm::vec3{down});
    CHECK(mirror.sample({0.5f, 0.5f}).pdf == 0);
    CHECK(mirror.coefficient(glm::vec3{up}) == glm::vec3{0});
}

TEST_CASE("the albedo that a denoiser sees is roughly that of a white sky", "[materials]") {
    const glm::dvec3 wo = direction(0.95, 0.4);
    for_each_rough([&](auto name, const auto& material) {
        if (material.transmits) return;
        INFO(name);
        CHECK(std::abs(double{material.albedo_seen(glm::vec3{wo}).y} - reflected_of_white_sky(material, wo)) <= 0.15);
    });
    const SmoothGlass<float> glass{glass_index};
    CHECK(glass.albedo_seen(glm::vec3{wo}) == glm::vec3{1});
    const Mirror<float> mirror{silver};
    CHECK(mirror.albedo_seen(glm::vec3{wo}) == mirror.strategy(glm::vec3{wo}).coefficient({}));
}

TEST_CASE("of a white sky metals lose what passes between their facets, and get it back", "[materials]") {
    const Metal<float, Tint> white{{glm::vec3{1}}, roughness};
    for (const glm::dvec3& wo : viewed_from(white)) {
        INFO(label("wo ", wo));
        const double lossy = white_furnace::albedo(wo, glm::dvec2{double{roughness}});
        CHECK(std::abs(reflected_of_white_sky(white, wo) - lossy) <= 1e-4);
        const double compensated = reflected_of_white_sky(Compensated<Metal<float, Tint>>{white}, wo);
        CHECK(compensated >= 0.991);
        CHECK(compensated <= 1);
        // One that reflects less gets back less.
        const Metal<float, Tint> dark{{glm::vec3{0.3f}}, roughness};
        const double gained = reflected_of_white_sky(Compensated<Metal<float, Tint>>{dark}, wo);
        CHECK(std::abs(gained / (0.3 * lossy + 0.09 * (1 - lossy)) - 1) <= 0.009);
    }
}

TEST_CASE("glass that absorbs nothing loses nothing but between its facets", "[materials]") {
    for (const glm::dvec3& wo : viewed_from(RoughGlass<float>{})) {
        INFO(label("wo ", wo));
        // The room's radiance over the squared index is 1 everywhere.
        const double n = double{glass_index}, here = wo.z < 0 ? n : 1;
        const auto radiance = [&](const glm::dvec3& wi) { return (wi.z < 0 ? n * n : 1.0) / (here * here); };
        const double rough = quadrature(RoughGlass<float>{roughness, glass_index}, wo, radiance);
        const double nearly_smooth = quadrature(RoughGlass<float>{0.01f, glass_index}, wo, radiance);
        CHECK(rough >= 0.75);
        CHECK(rough <= 1);
        CHECK(nearly_smooth >= 0.9995);
        CHECK(nearly_smooth <= 1);

        const auto smooth = SmoothGlass<double>{n}.strategy(wo);
        for (const double u : {0.0, 0.02, 0.5, 1.0}) {
            const auto drawn = smooth.sample({0.5, 0.5, u});
            const double weight = smooth.coefficient(drawn.value).x * radiance(drawn.value) / drawn.pdf;
            CHECK(std::abs(weight - 1) <= 1e-12);
        }
    }
}

TEST_CASE("absorbing glass leaves less of light the longer its way", "[materials]") {
    const Absorbing<SmoothGlass<float>> glass{{glass_index}, {0.1f, 0, 5}};
    const auto in_lanes = gather<decltype(glass)::In<Packet>, Packet>(std::vector{glass}, {});
    for (const float distance : {0.0f, 0.7f, 1e4f, 1e30f}) {
        const glm::vec3 left = left_after(distance, glass.absorption);
        CHECK(std::abs(double{left.x} - std::exp(-0.1 * double{distance})) <= 1e-7);
        CHECK(left.y == 1);
        CHECK(lane_of<Packet>(left_after(Packet{distance}, in_lanes.absorption), 3) == left);
    }
}

TEST_CASE("a pane of absorbing glass reflects and transmits what its surfaces do, to and fro", "[materials]") {
    const Absorbing<SmoothGlass<float>> glass{{glass_index}, {0.5f, 0, 0}};
    const glm::dvec3 from = direction(0.6, 1);
    const double cos_t = std::sqrt(1 - 0.64 / (1.5 * 1.5)), f = fresnel(0.6, 1.5), left = std::exp(-0.5 / cos_t);
    const double transmitted = (1 - f) * (1 - f) * left / (1 - f * f * left * left);
    // A path from the camera through a pane of thickness 1. Both surfaces have their +z outside.
    const auto walk = [&](auto& uniforms, bool through) {
        glm::vec3 wo{from};
        float throughput = 1;
        for (int bounce = 0;; ++bounce) {
            if (wo.z < 0) throughput *= left_after(-1 / wo.z, glass.absorption).x;
            const auto bsdf = glass.strategy(wo);
            const auto drawn = bsdf.sample(uniforms.template next<3>());
            throughput *= bsdf.coefficient(drawn.value).x / drawn.pdf;
            if (drawn.value.z > 0) return (bounce % 2 == 1) == through ? throughput : 0.0f;
            wo = {-drawn.value.x, -drawn.value.y, drawn.value.z};
        }
    };
    for (const bool through : {false, true}) {
        lumis::Uniforms<std::mt19937, float> uniforms{std::mt19937{1}};
        const auto law = laws::unbiased([&] { return walk(uniforms, through); },
                                        through ? transmitted : f * (1 + left * transmitted), {100'000, {1e-4, 2}});
        INFO(law);
        CHECK(law.passed);
    }
}

TEST_CASE("a polished metal is the limit of a rough one", "[materials]") {
    const glm::vec3 wo{direction(0.4, 1)}, mirrored{-wo.x, -wo.y, wo.z};
    const auto rough = Metal<float>{silver, 0.001f}.strategy(wo);
    const auto drawn = rough.sample({0.1f, 0.2f});
    const glm::vec3 limit = Mirror<float>{silver}.strategy(wo).coefficient(mirrored);
    for (int c = 0; c < 3; ++c)
        CHECK(std::abs(rough.evaluate(drawn.value).reflected[c] / drawn.pdf - limit[c]) <= 1e-4f);
}
