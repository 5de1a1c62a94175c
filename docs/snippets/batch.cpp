// The guide's batches.
#include "catch.hpp"
#include <lumis/batch/batch.hpp>
#include <lumis/lumis.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace {

TEST_CASE("a batch of samples") {
    const glm::vec3 wo{0, 0, 1};
    const lumis::Ggx ggx{glm::vec2{0.5f}};
    const lumis::CosineHemisphere<float> strategy;
    const std::vector<float> ux{0.1f, 0.5f, 0.9f}, uy{0.2f, 0.4f, 0.6f}, other(3, 1.0f);
    std::vector<float> x(3), y(3), z(3), pdf(3), values(3), weights(3);

    lumis::sample_n(strategy, {ux, uy}, {x, y, z, pdf});  // arrays of one size, as spans
    lumis::pdf_n(strategy, x, y, z, pdf);
    lumis::evaluate_n<float>([&](const auto& wi) { return ggx.brdf(wo, wi) * wi.z; }, x, y, z, values);
    lumis::mis_weight_n(lumis::PowerHeuristic{}, pdf, other, std::span{weights});

    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(pdf[i] == Approx(strategy.sample({ux[i], uy[i]}).pdf));
        CHECK(weights[i] == Approx(lumis::mis_weight(lumis::PowerHeuristic{}, pdf[i], other[i])));
        CHECK(values[i] > 0);
    }
}

TEST_CASE("a batch of estimates") {
    constexpr std::size_t count = 1000;
    const lumis::CosineHemisphere<float> bsdf;
    const lumis::AreaLight<lumis::Sphere<float>, lumis::BySolidAngle> light{{{0, 0, 3}, 1}, {0, 0, 0}};
    const auto direct = lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, bsdf), lumis::take(1, light));
    const auto reflected = [&](const auto& w) {
        return lumis::real::select(light.pdf(w) > 0, w.z, decltype(w.z)(0.0f));
    };
    lumis::Uniforms source{std::mt19937{1}};
    std::vector<float> uniforms(4 * count);
    for (float& u : uniforms) u = source.next<1>().x;

    const std::size_t numbers = direct.uniforms_per_estimate();  // 2 + 2
    std::vector<std::span<const float>> columns;
    for (std::size_t k = 0; k < numbers; ++k) columns.push_back(std::span{uniforms}.subspan(k * count, count));
    std::vector<float> estimates(count);
    lumis::estimate_n(direct, reflected, columns, std::span{estimates});

    lumis::RunningMoments<float> moments;
    for (const float estimate : estimates) moments.add(estimate);
    // pi sin^2 of the half angle
    CHECK(std::abs(moments.mean() - std::numbers::pi / 9) <= 4 * moments.standard_error());
}

using Eight = lumis::Lanes<float, 8>;

// Eight streams of random numbers, one in each lane.
struct EightStreams {
    std::mt19937 engine{1};

    template <int N>
    glm::vec<N, Eight> next() {
        lumis::Uniforms<std::mt19937&> uniforms{engine};
        glm::vec<N, Eight> u;
        for (int k = 0; k < N; ++k) u[k] = Eight::of_lanes([&](auto) { return uniforms.next<1>().x; });
        return u;
    }
};

TEST_CASE("estimates in lanes") {
    EightStreams eight_streams;
    const auto direct = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, lumis::CosineHemisphere<float>{}),
                                            lumis::take(1, lumis::UniformHemisphere<float>{}));
    lumis::RunningMoments<float> moments;
    for (int i = 0; i < 1000; ++i) {
        const auto cosine_in_lanes = [](const lumis::Direction<Eight>& w) { return w.z; };
        const Eight estimates = direct.estimate(cosine_in_lanes, eight_streams);  // next<N>() yields glm::vec<N, Eight>
        moments.add(estimates);                                                   // RunningMoments counts eight
    }
    CHECK(moments.count() == 8000);
    CHECK(std::abs(moments.mean() - std::numbers::pi) <= 4 * moments.standard_error());
}

TEST_CASE("a surface in each lane") {
    EightStreams eight_streams;
    const auto u = eight_streams.next<2>();
    const Eight cosine = Eight::of_lanes([](auto i) { return 0.1f + 0.1f * static_cast<float>(i); });
    const lumis::Direction<Eight> wo{sqrt(1.0f - cosine * cosine), Eight{0.0f}, cosine};

    const glm::vec<2, Eight> alpha{0.3f, 0.3f};
    const lumis::GgxReflection<Eight> eight_surfaces{wo, alpha};  // a direction and a roughness in each lane
    const auto drawn = eight_surfaces.sample(u);

    for (std::size_t i = 0; i < 8; ++i) {
        const lumis::GgxReflection<float> surface{{wo.x[i], 0, wo.z[i]}, glm::vec2{0.3f}};
        CHECK(drawn.pdf[i] == Approx(surface.sample({u.x[i], u.y[i]}).pdf).epsilon(1e-3));
    }
}

}  // namespace
