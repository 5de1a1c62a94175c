// What a path tracer is asked to do: how many bounces, and how light sampling and BSDF sampling share what both can find.
#pragma once

#include "filter.hpp"
#include "packet.hpp"
#include "sampler.hpp"
#include <lumis/combine/heuristics.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace tracer {

enum class Integrator { Bsdf, Light, Balance, Power, OneSample, Average };
inline constexpr std::array<std::string_view, 6> integrator_names{"bsdf",  "light",      "balance",
                                                                  "power", "one-sample", "average"};

struct Transport {
    Integrator integrator = Integrator::Power;
    int bounces = 5;  // 0: light that the camera sees; 1: direct light as well
    Filter filter = Filter::Box;
    Sampler sampler = Sampler::Sobol;

    [[nodiscard]] bool asks_lights() const { return integrator != Integrator::Bsdf; }

    // The weight of a sample by its own technique, where the other could have drawn it as well. Densities are times the
    // number of samples, or the probability of taking one. Not for bsdf, which has one technique.
    template <lumis::Real R>
    [[nodiscard]] LUMIS_INLINE R weight(const R& own, const R& other) const {
        switch (integrator) {
        case Integrator::Power: return lumis::mis_weight(lumis::PowerHeuristic{}, own, other);
        case Integrator::Average: return lumis::mis_weight(lumis::EqualWeights{}, own, other);
        default: return lumis::mis_weight(lumis::BalanceHeuristic{}, own, other);
        }
    }
};

}  // namespace tracer
