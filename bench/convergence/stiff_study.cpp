#include "stiff_study.hpp"

#include "near_mirror.hpp"
#include "paths/random_stream.hpp"
#include "thread_clock.hpp"
#include <lumis/lumis.hpp>

#include <cstdio>
#include <numbers>

namespace convergence {

namespace {

using lumis::AreaLight;
using lumis::BySolidAngle;

constexpr double hemisphere = 2 * std::numbers::pi;

// Runs one estimator for a time.
template <class Estimator, class F>
StiffCell measure(const Estimator& estimator, const F& f, double answer, int runs, double seconds) {
    constexpr int batch = 256;
    Moments errors, squares;
    std::uint64_t not_finite = 0;
    for (int run = 0; run <= runs; ++run) {
        lumis::Uniforms uniforms{tracer::random_stream<pcg64>(static_cast<std::uint64_t>(run))};
        Moments estimates;
        const tracer::ThreadClock clock;
        do {
            for (int i = 0; i < batch; ++i) estimates.add(estimator.estimate(f, uniforms));
        } while (clock.seconds() < seconds);
        if (run == 0) continue;  // warms the machine up
        not_finite += estimates.rejected();
        const double error = estimates.mean() / answer - 1;
        errors.add(error);
        squares.add(error * error);
    }
    return {std::sqrt(squares.mean()), errors.mean() / errors.standard_error(), not_finite};
}

// All estimators of one BSDF and one light, in the order of `names`.
std::vector<StiffCell> measure_all(float alpha, const auto& light, double answer, int runs, double seconds) {
    const glm::vec3 wo = viewer<float>();
    const lumis::GgxReflection<float> bsdf{wo, glm::vec2{alpha}};
    // The light shines with radiance 1, so what it does not cover reflects nothing.
    const auto f = [&](const glm::vec3& wi) {
        return wi.z > 0 && light.pdf(wi) > 0 ? bsdf.ggx().brdf(wo, wi) * wi.z : 0.0f;
    };
    const auto by_bsdf = lumis::take(1, bsdf), by_light = lumis::take(1, light);
    const auto measured = [&](const auto& estimator) { return measure(estimator, f, answer, runs, seconds); };
    return {measured(multi_sample(lumis::BalanceHeuristic{}, by_bsdf)),
            measured(multi_sample(lumis::BalanceHeuristic{}, by_light)),
            measured(multi_sample(lumis::BalanceHeuristic{}, by_bsdf, by_light)),
            measured(multi_sample(lumis::PowerHeuristic{}, by_bsdf, by_light)),
            measured(one_sample(lumis::BalanceHeuristic{}, lumis::choose(0.5f, bsdf), lumis::choose(0.5f, light))),
            measured(multi_sample(lumis::EqualWeights{}, by_bsdf, by_light))};
}

const std::vector<std::string> names{"bsdf", "light", "balance", "power", "one-sample", "average"};

std::vector<StiffCell> measure_case(double alpha, double solid_angle, int runs, double seconds) {
    const auto roughness = static_cast<float>(alpha);
    if (solid_angle == hemisphere) {
        return measure_all(roughness, lumis::UniformHemisphere<float>{}, reflected_hemisphere(alpha).value, runs,
                           seconds);
    }
    // A sphere at distance 1 whose radius is the sine of the cone's half-angle.
    const double versine = solid_angle / hemisphere;
    const auto radius = static_cast<float>(lumis::sine_of_versine(versine));
    const AreaLight<lumis::Sphere<float>, BySolidAngle> light{{mirrored<float>(), radius}, glm::vec3{0}};
    return measure_all(roughness, light, reflected_cone(alpha, light.solid_angle()).value, runs, seconds);
}

}  // namespace

double StiffStudy::worst_error(std::size_t integrator) const {
    double worst = 0;
    for (const auto& row : cells[integrator]) {
        for (const StiffCell& cell : row) {
            if (!(cell.relative_error <= worst)) worst = cell.relative_error;
            if (std::isnan(worst)) return worst;
        }
    }
    return worst;
}

StiffStudy stiff_study(int runs, double seconds, const Progress& progress) {
    StiffStudy study{
        {0.1, 0.01, 0.001, lumis::ggx_min_alpha}, {1e-6, 1e-4, 1e-2, 1, hemisphere}, seconds, runs, names, {}};
    study.cells.assign(study.integrators.size(), std::vector<std::vector<StiffCell>>(study.alphas.size()));
    for (std::size_t a = 0; a < study.alphas.size(); ++a) {
        for (const double solid_angle : study.solid_angles) {
            progress("near-mirror, roughness " + std::to_string(study.alphas[a]));
            const auto cells = measure_case(study.alphas[a], solid_angle, runs, seconds);
            for (std::size_t i = 0; i < cells.size(); ++i) study.cells[i][a].push_back(cells[i]);
        }
    }
    return study;
}

void print_table(const StiffStudy& study) {
    std::printf("\nNear-mirror GGX under lights of all sizes: relative error after %.3g s of CPU, %d runs\n",
                study.seconds, study.runs);
    std::printf("  %-8s %-10s", "alpha", "light, sr");
    for (const std::string& name : study.integrators) std::printf(" %12s", name.c_str());
    std::printf("\n");
    for (std::size_t a = 0; a < study.alphas.size(); ++a) {
        for (std::size_t s = 0; s < study.solid_angles.size(); ++s) {
            std::printf("  %-8.3g %-10.3g", study.alphas[a], study.solid_angles[s]);
            for (const auto& cells : study.cells) std::printf(" %10.2g %%", 100 * cells[a][s].relative_error);
            std::printf("\n");
        }
    }
    std::printf("  %-19s", "worst");
    for (std::size_t i = 0; i < study.integrators.size(); ++i) std::printf(" %10.2g %%", 100 * study.worst_error(i));
    std::printf("\n");
}

}  // namespace convergence
