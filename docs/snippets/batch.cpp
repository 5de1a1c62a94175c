// The guide's batches.
#include "catch.hpp"
#include <lumis/batch/batch.hpp>
#include <lumis/lumis.hpp>

#include <cstddef>
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

}  // namespace
