// What pilot samples tell of every split of samples by optimal weights: the equations that these would solve there.
#pragma once

#include "lumis/combine/detail/normal_equations.hpp"
#include "lumis/combine/detail/splits.hpp"
#include "lumis/core/platform.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

namespace lumis::LUMIS_ISA::detail {

// Sums over pilot rounds, for S techniques with a density, see PilotMoments. With the counts n of a split and
// sum = sum of n_t p_t, optimal weights leave the variance that f / sum has beyond what the p_t / sum explain of it. It is the
// same in both models. A technique of count 0 is a control variate.
template <std::size_t S>
struct PilotEquations {
    static constexpr std::size_t splits = Splits<S>::size;

    std::array<NormalEquations<double, S>, splits> equations{};
    std::array<double, splits> seconds{};  // sums of f^2 / (sum p)
    std::array<bool, splits> misses{};     // whether a split cannot draw a point that f or a control variate needs

    template <std::floating_point T, class H>
    LUMIS_HD void add(const H& /*heuristic*/, double f, const std::array<double, S>& densities, double p) noexcept {
        constexpr Splits<S> all = make_splits<S>();
        for (std::size_t k = 0; k < splits; ++k) {
            double sum = 0;
            for (std::size_t t = 0; t < S; ++t) sum += all.counts[t][k] * densities[t];
            misses[k] |= !(sum > 0);
            if (!(sum > 0)) continue;
            const double scale = 1 / std::sqrt(sum * p);
            std::array<double, S> q;
            for (std::size_t t = 0; t < S; ++t) q[t] = densities[t] * scale;
            equations[k].add_sample(f * scale, q);
            seconds[k] += f * scale * f * scale;
        }
    }

    // A draw that yielded nothing is a point of technique t alone, where f is 0. One that is not drawn cannot be a control
    // variate then.
    LUMIS_HD void add_nothing(std::size_t t, double count) noexcept {
        constexpr Splits<S> all = make_splits<S>();
        for (std::size_t k = 0; k < splits; ++k) {
            misses[k] |= all.counts[t][k] == 0;
            if (all.counts[t][k] > 0) equations[k].a(t, t) += 1 / (all.counts[t][k] * count);
        }
    }

    LUMIS_HD void merge(const PilotEquations& other) noexcept {
        for (std::size_t k = 0; k < splits; ++k) {
            equations[k].add(other.equations[k]);
            seconds[k] += other.seconds[k];
            misses[k] |= other.misses[k];
        }
    }

    // The integral of (f - alpha . p)^2 / S, for alpha as it can be known after so many rounds. Its mean is 0.
    [[nodiscard]] LUMIS_HD SplitOutcome outcome(std::size_t k, const std::array<int, S>& split,
                                                double rounds) const noexcept {
        NormalEquations<double, S> known = equations[k];
        for (std::size_t t = 0; t < S; ++t) known.factors[t] = split[t] * rounds;
        const std::array<double, S> alpha = known.solution(rounds);
        double residual = seconds[k];
        for (std::size_t i = 0; i < S; ++i) {
            residual -= 2 * alpha[i] * known.b[i];
            for (std::size_t t = 0; t < S; ++t) residual += alpha[i] * known.a(i, t) * alpha[t];
        }
        residual = residual > 0 ? residual / rounds : 0;
        return {residual, residual, 0};
    }
};

}  // namespace lumis::LUMIS_ISA::detail
