// What pilot samples tell of every split of samples: the moments that the contributions of each technique would have there.
#pragma once

#include "lumis/combine/detail/splits.hpp"
#include "lumis/combine/heuristics.hpp"
#include "lumis/core/platform.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <span>

namespace lumis::LUMIS_ISA::detail {

// Sums over pilot rounds, for S techniques with a density. With the counts of a split, technique t contributes
// h_t(x) = w_t(x) f(x) / p_t(x) at a point x that it draws. The pilot draws m_s samples of each technique s in a round, which
// together have the density p = sum of m_s p_s: the importance weight p_t / p makes each of them one of technique t.
template <std::size_t S>
struct PilotMoments {
    static constexpr std::size_t splits = Splits<S>::size;

    std::array<double, S> masses{};                       // sums of p_t / p, about one a round
    std::array<std::array<double, splits>, S> firsts{};   // sums of h_t p_t / p
    std::array<std::array<double, splits>, S> seconds{};  // sums of h_t^2 p_t / p
    std::array<bool, splits> misses{};                    // whether a split cannot draw a point where f is not 0

    // A pilot sample where the integrand is f. The heuristic weighs numbers T.
    template <std::floating_point T, class H>
    LUMIS_HD void add(const H& heuristic, double f, const std::array<double, S>& densities, double p) noexcept {
        const double inverse_p = 1 / p;
        for (std::size_t t = 0; t < S; ++t) masses[t] += densities[t] * inverse_p;
        if (f == 0) return;
        constexpr Splits<S> all = make_splits<S>();
        for (std::size_t k = 0; k < splits; ++k) {
            std::array<double, S> effective;
            double sum = 0;
            for (std::size_t t = 0; t < S; ++t) {
                effective[t] = all.counts[t][k] * densities[t];
                sum += effective[t];
            }
            misses[k] |= !(sum > 0);
            const double inverse = 1 / (sum > 0 ? sum : 1);
            for (std::size_t t = 0; t < S; ++t) {
                double first, second;  // of this sample, times p
                if constexpr (S == 1 || std::same_as<H, BalanceHeuristic>) {
                    const double h = all.counts[t][k] * f * inverse;
                    first = h * densities[t];
                    second = h * first;
                } else {
                    first = effective[t] > 0 ? f * weight<T>(heuristic, t, effective, inverse) : 0;
                    second = effective[t] > 0 ? first * first / densities[t] : 0;
                }
                firsts[t][k] += first * inverse_p;
                seconds[t][k] += second * inverse_p;
            }
        }
    }

    // A draw of technique t, one of `count` in a round, that yielded nothing. It contributes 0 and is technique t's alone.
    LUMIS_HD void add_nothing(std::size_t t, double count) noexcept { masses[t] += 1 / count; }

    LUMIS_HD void merge(const PilotMoments& other) noexcept {
        for (std::size_t k = 0; k < splits; ++k) misses[k] |= other.misses[k];
        for (std::size_t t = 0; t < S; ++t) {
            masses[t] += other.masses[t];
            for (std::size_t k = 0; k < splits; ++k) {
                firsts[t][k] += other.firsts[t][k];
                seconds[t][k] += other.seconds[t][k];
            }
        }
    }

    // Expectations: sums over the masses, instead of over the number of rounds that they estimate. So the variance of what is
    // nearly constant is nearly 0, and none is negative.
    [[nodiscard]] LUMIS_HD SplitOutcome outcome(std::size_t k, const std::array<int, S>& split,
                                                double /*rounds*/) const noexcept {
        SplitOutcome result{};
        for (std::size_t t = 0; t < S; ++t) {
            if (split[t] == 0 || !(masses[t] > 0)) continue;
            const double first = firsts[t][k] / masses[t], second = seconds[t][k] / masses[t];
            result.mean += first;
            result.second += second / split[t];
            result.variance += (second - first * first) / split[t];
        }
        return result;
    }

  private:
    // Effective densities are brought near 1, so that numbers T hold them.
    template <std::floating_point T, class H>
    [[nodiscard]] LUMIS_HD static double weight(const H& heuristic, std::size_t own,
                                                const std::array<double, S>& effective, double scale) noexcept {
        std::array<T, S> scaled;
        for (std::size_t t = 0; t < S; ++t) scaled[t] = static_cast<T>(effective[t] * scale);
        return static_cast<double>(weigh(heuristic, own, std::span<const T, S>{scaled}));
    }
};

}  // namespace lumis::LUMIS_ISA::detail
