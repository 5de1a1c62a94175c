// The guide's low-discrepancy points: an estimate by several randomisations, and its error.
#include "catch.hpp"
#include <lumis/core/lanes.hpp>
#include <lumis/lumis.hpp>
#include <lumis/qmc/sobol.hpp>

#include <cmath>
#include <cstdint>
#include <random>

namespace {

TEST_CASE("an estimate with low-discrepancy points and its error") {
    const lumis::AreaLight light{lumis::Parallelogram{glm::vec3{-1, -1, 1}, glm::vec3{2, 0, 0}, glm::vec3{0, 2, 0}},
                                 glm::vec3{0}};
    const lumis::CosineHemisphere<float> bsdf;
    const auto direct = multi_sample(lumis::PowerHeuristic{}, lumis::take(1, bsdf), lumis::take(1, light));
    const auto cosine = [&](const auto& w) { return light.pdf(w) > 0 ? w.z : 0.0f; };

    lumis::RunningMoments<double> means;
    for (std::uint64_t randomisation = 0; randomisation < 16; ++randomisation) {
        lumis::Sobol<float> points{randomisation};
        lumis::RunningMoments<float> estimates;
        for (std::uint32_t i = 0; i < 256; ++i) {
            points.start(i);
            estimates.add(direct.estimate(cosine, points));
        }
        means.add(estimates.mean());
    }
    const double value = means.mean(), error = means.standard_error();

    CHECK(std::abs(value - 1.740839502734) <= 4 * error);
    CHECK(error > 0);

    // Random numbers, as many, are off by more.
    lumis::RunningMoments<float> at_random;
    lumis::Uniforms uniforms{std::mt19937{1}};
    for (int i = 0; i < 16 * 256; ++i) at_random.add(direct.estimate(cosine, uniforms));
    CHECK(10 * error <= at_random.standard_error());
}

TEST_CASE("low-discrepancy points in lanes") {
    const lumis::UniformHemisphere<float> strategy;
    const auto direct = multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, strategy));
    const auto cosine = [](const auto& w) { return w.z; };

    using Lanes = lumis::NativeLanes<float>;
    lumis::Sobol<Lanes> points{1};
    lumis::RunningMoments<float> estimates;
    for (std::uint32_t i = 0; i < 256; i += Lanes::size) {
        points.start(i);  // points i, i + 1, ..., one in each lane
        const Lanes values = direct.estimate(cosine, points);
        for (std::size_t lane = 0; lane < Lanes::size; ++lane) estimates.add(values[lane]);
    }

    CHECK(std::abs(estimates.mean() - 3.14159265f) <= 0.01f);
}

}  // namespace
