// How light sampling and BSDF sampling share what both can find.
#pragma once

#include "paths/packet.hpp"
#include "render_options.hpp"
#include <lumis/combine/heuristics.hpp>

#include <array>

namespace tracer {

// bsdf and light: one technique alone. one-sample: one of the two at random, by the balance heuristic. The others take both.
// optimal: direct light at the first surface with optimal weights, learnt from the pixel's samples of a pass, which are random
// numbers then; further on balance.
enum class Integrator { Bsdf, Light, Balance, Power, OneSample, Average, Optimal };
inline constexpr std::array<Named<Integrator>, 7> integrators{{{"bsdf", Integrator::Bsdf},
                                                               {"light", Integrator::Light},
                                                               {"balance", Integrator::Balance},
                                                               {"power", Integrator::Power},
                                                               {"one-sample", Integrator::OneSample},
                                                               {"average", Integrator::Average},
                                                               {"optimal", Integrator::Optimal}}};

[[nodiscard]] constexpr bool asks_lights(Integrator integrator) {
    return integrator != Integrator::Bsdf;
}

// The weight of a sample of light that the other technique could have drawn as well. Densities are times the number of samples,
// or the probability of taking one.
template <lumis::Real R>
[[nodiscard]] LUMIS_INLINE inline R weight_of_light_sample(Integrator integrator, const R& own, const R& other) {
    switch (integrator) {
        case Integrator::Light:
            return R(1.0f);
        case Integrator::Power:
            return lumis::mis_weight(lumis::PowerHeuristic{}, own, other);
        case Integrator::Average:
            return lumis::mis_weight(lumis::EqualWeights{}, own, other);
        default:
            return lumis::mis_weight(lumis::BalanceHeuristic{}, own, other);
    }
}
template <lumis::Real R>
[[nodiscard]] LUMIS_INLINE inline R weight_of_bsdf_sample(Integrator integrator, const R& own, const R& other) {
    return integrator == Integrator::Light ? R(0.0f) : weight_of_light_sample(integrator, own, other);
}

}  // namespace tracer
