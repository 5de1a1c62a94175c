// MIS weights that cost one density for most samples, whatever the number of techniques: each is weighed against the first alone.
// Bitterli 2022, "Correlations and Reuse for Fast and Accurate Physically Based Light Transport"; Lin et al. 2022, "Generalized
// Resampled Importance Sampling".
#pragma once

#include "lumis/combine/heuristics.hpp"
#include "lumis/core/detail/for_each_index.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

namespace lumis::LUMIS_ISA {

// A heuristic for multi_sample, one_sample and resample; it needs the counts too, so mis_weight does not take it. Technique 0 is
// the canonical one, which should cover all of the integrand. Its samples are shared out among pairs with each of the others,
// and a pair is weighed by balance. With n_k samples of density p_k (or probabilities c_k), and N the sum of n_k over k > 0:
//
//     w_k(x) =                      n_k p_k(x) / (N p_k(x) + n_0 p_0(x)),    k > 0
//     w_0(x) = sum over k > 0 of  n_k/N n_0 p_0(x) / (N p_k(x) + n_0 p_0(x))
//
// These sum to 1 where p_0 is positive. Elsewhere the techniques are weighed by balance, which asks for all of their densities.
// A sample of the canonical technique asks for all densities, too; one of another asks for p_0 alone. With two techniques this is
// the balance heuristic.
struct PairwiseWeights {
    static constexpr bool is_positive = true;  // see BalanceHeuristic

    // The weight of technique I of N. factor(k) is n_k, density(k) is n_k p_k(x), and k is a constant.
    template <std::size_t I, std::size_t N, Real R, class Factor, class Density>
    [[nodiscard]] LUMIS_HD static R weight(Factor factor, Density density) noexcept {
        using T = scalar_of<R>;
        const R own = density(constant<I>);
        const MaskOf<R> drawn = own > 0;
        if (!real::any(drawn)) return T(0);
        auto others = factor(constant<1>);
        detail::for_each_index<N>([&](auto k) {
            if constexpr (k > 1) others += factor(k);
        });
        R result = T(0);
        MaskOf<R> settled;
        if constexpr (I == 0) {
            if (!real::any(others > 0)) return real::select(drawn, R(T(1)), T(0));
            detail::for_each_index<N>([&](auto k) {
                if constexpr (k > 0) {
                    if (!real::any(factor(k) > 0)) return;
                    const R share = real::divide(R(factor(k)), R(others));
                    const R ratio = real::quotient_where(drawn && share > 0, R(density(k)), R(share * own));
                    result += real::divide(share, R(1 + ratio));
                }
            });
            settled = !drawn || result >= 0;
        } else {
            const R canonical = density(constant<0>);
            const R inverse_share = real::divide(R(others), real::divisor_where(drawn, R(factor(constant<I>))));
            const R ratio = real::quotient_where(drawn, canonical, own);
            result = real::divide(R(T(1)), real::divisor_where(drawn, R(inverse_share + ratio)));
            settled = !drawn || (canonical > 0 && result >= 0);
        }
        result = real::select(drawn, result, T(0));
        if (real::all(settled)) [[likely]]
            return result;
        // Balance where the canonical density is 0, and for what the policy on numbers that misbehave decides.
        std::array<R, N> q{};
        detail::for_each_index<N>([&](auto k) { q[k] = density(k); });
        return real::select(settled, result, detail::weigh(BalanceHeuristic{}, I, std::span<const R, N>{q}));
    }

  private:
    template <std::size_t I>
    static constexpr std::integral_constant<std::size_t, I> constant{};
};

}  // namespace lumis::LUMIS_ISA
