// A strategy of one's own, power_cosine.hpp, combined with one from the library.
#include "power_cosine.hpp"
#include <lumis/lumis.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

static_assert(lumis::Strategy<PowerCosine<float>>);

int main() {
    // A highlight on a dull base: a lobe for each.
    const auto brdf_times_cosine = [](glm::vec3 w) { return w.z > 0 ? 0.2f * w.z + 10 * std::pow(w.z, 100.0f) : 0.0f; };
    const auto reflected = one_sample(lumis::BalanceHeuristic{}, lumis::choose(0.3, lumis::CosineHemisphere<float>{}),
                                      lumis::choose(0.7, PowerCosine{100.0f}));

    std::mt19937 engine{1};
    lumis::Uniforms uniforms{engine};
    lumis::RunningMoments<float> result;
    for (int i = 0; i < 10'000; ++i) result.add(reflected.estimate(brdf_times_cosine, uniforms));
    std::printf("%.4f +- %.4f, exactly %.4f\n", result.mean(), result.standard_error(),
                std::numbers::pi * (0.2 + 20.0 / 101));
}
