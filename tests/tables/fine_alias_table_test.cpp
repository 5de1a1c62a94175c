// A table in float by two uniforms: it keeps the laws, alone and as the selection of a set of lights.
#include "catch.hpp"
#include "irradiance.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/laws.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace laws = lumis::testing;

namespace {

const std::vector<float> weights{1, 0, 3, 1e-5f, 0.5f, 1e-12f};

}  // namespace

TEST_CASE("the laws over a fine alias table", "[alias_table]") {
    const lumis::FineAliasTable table{weights};
    const auto chart = laws::index_chart(weights.size());
    STATIC_REQUIRE(lumis::Strategy<lumis::FineAliasTable>);
    CHECK(laws::agreement(table));
    CHECK(laws::integrates(table, chart, {.probability = 1.0}));
    CHECK(laws::covers(
        table, [](std::size_t i) { return weights[i] > 0; }, chart));
    CHECK(laws::chi_square(table, chart));
    CHECK(laws::stays_finite(table));
}

TEST_CASE("a set of lights selected by a fine alias table", "[light_set]") {
    using Light = lumis::AreaLight<lumis::Sphere<float>, lumis::BySolidAngle>;
    // One of them behind the horizon, one of power 0.
    std::vector<Light> lights;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto x = static_cast<float>(i);
        lights.push_back({{{x - 2, 1, i == 4 ? -2.0f : 2.0f}, 0.25f + x / 16}, {0, 0, 0}});
    }
    const lumis::FineAliasTable table{weights};
    const lumis::LightSet fine{lights, table};
    const lumis::LightSet coarse{lights, lumis::AliasTable{weights}};
    STATIC_REQUIRE(decltype(fine)::dimensions == 4);
    STATIC_REQUIRE(decltype(coarse)::dimensions == 3);
    CHECK(laws::agreement(fine));
    CHECK(laws::stays_finite(fine));
    for (int i = 0; i < 64; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / 64;
        const auto a = fine.sample({u, 0.3f, 0.2f, 0.7f}), b = coarse.sample({u, 0.2f, 0.7f});
        CHECK(a.value == b.value);
        CHECK(std::abs(a.pdf - b.pdf) <= 1e-5f * b.pdf);
        CHECK(fine.sample_one({u, 0.3f, 0.2f, 0.7f}).index == coarse.sample_one({u, 0.2f, 0.7f}).index);
    }
    // pi (r / d)^2 cos(omega) for each that is above the horizon and has a weight.
    double answer = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (i == 4 || !(weights[i] > 0)) continue;
        const double x = static_cast<double>(i) - 2, radius = 0.25 + static_cast<double>(i) / 16;
        answer += std::numbers::pi * radius * radius * 2 / std::pow(x * x + 5, 1.5);
    }
    const auto estimator = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, fine),
                                               lumis::take(1, lumis::CosineHemisphere<float>{}));
    const auto f = [&](const glm::vec3& w) {
        float sum = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] > 0 && lights[i].pdf(w) > 0 ? 1.0f : 0.0f;
        return sum * std::max(w.z, 0.0f);
    };
    irradiance::check_unbiased<float>(
        "set and BSDF", [&](auto& uniforms) { return estimator.estimate(f, uniforms); }, answer);
}
