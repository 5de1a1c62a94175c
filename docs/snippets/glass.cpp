// The guide's glass, in a world where radiance is 1 in air and eta^2 in glass: in equilibrium every direction shows as much.
#include "catch.hpp"
#include <lumis/lumis.hpp>

#include <cmath>
#include <random>

namespace {

using glm::vec3;
using Source = lumis::Uniforms<std::mt19937_64, float>;

float traced_radiance(const vec3& wi) {
    return wi.z > 0 ? 1 : 1.5f * 1.5f;
}

float equilibrium(const vec3& wo, Source& uniforms) {
    const lumis::GgxDielectric glass{wo, 0.2f, 1.5f};
    const auto scattered = multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, glass));
    const float seen =
        scattered.estimate([&](vec3 wi) { return glass.bsdf(wi) * std::abs(wi.z) * traced_radiance(wi); }, uniforms);
    return seen;
}

float along_path(const vec3& wo, Source& uniforms) {
    float throughput = 1;
    const lumis::SmoothDielectric pane{wo, 1.5f};
    const auto drawn = pane.sample(uniforms.next<3>());
    throughput *= pane.coefficient(drawn.value) / drawn.pdf;  // of radiance
    return throughput * traced_radiance(drawn.value);
}

}  // namespace

TEST_CASE("glass in equilibrium") {
    Source uniforms{std::mt19937_64{1}};
    for (const float side : {1.0f, -1.0f}) {
        const vec3 wo{0.48f, 0.36f, side * 0.8f};
        const float inside = side > 0 ? 1 : 1.5f * 1.5f;
        lumis::RunningMoments<double> rough;
        for (int i = 0; i < 10000; ++i) {
            rough.add(equilibrium(wo, uniforms));
            REQUIRE(along_path(wo, uniforms) == Approx(inside));
        }
        // What scatters more than once is lost, from inside more of it.
        CHECK((rough.mean() <= 1.005 * inside && rough.mean() >= 0.85 * inside));
    }
}
