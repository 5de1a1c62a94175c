// A strategy of one's own: a cosine lobe to the power of n about +z, combined with one from the library.
#include <lumis/lumis.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

// Density (n + 1) / (2 pi) cos^n(theta) per solid angle, local frame.
struct PowerCosine {
    using Scalar = float;
    using Point = lumis::Direction<float>;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;

    float n;

    lumis::Sample<Point, float> sample(glm::vec2 u) const noexcept {
        const float cos_theta = std::pow(1 - u.x, 1 / (n + 1));
        const Point w = lumis::direction_at(1 - cos_theta, u.y);
        return {w, pdf(w)};
    }
    float pdf(const Point& w) const noexcept {
        return w.z > 0 ? (n + 1) * std::numbers::inv_pi_v<float> / 2 * std::pow(w.z, n) : 0.0f;
    }
};
static_assert(lumis::Strategy<PowerCosine>);

int main() {
    // A highlight on a dull base: a lobe for each.
    const auto brdf_times_cosine = [](glm::vec3 w) { return w.z > 0 ? 0.2f * w.z + 10 * std::pow(w.z, 100.0f) : 0.0f; };
    const auto reflected = one_sample(lumis::BalanceHeuristic{}, lumis::choose(0.3, lumis::CosineHemisphere<float>{}),
                                      lumis::choose(0.7, PowerCosine{100}));

    std::mt19937 engine{1};
    lumis::Uniforms uniforms{engine};
    lumis::RunningMoments<float> result;
    for (int i = 0; i < 10'000; ++i) result.add(reflected.estimate(brdf_times_cosine, uniforms));
    std::printf("%.4f +- %.4f, exactly %.4f\n", result.mean(), result.standard_error(),
                std::numbers::pi * (0.2 + 20.0 / 101));
}
