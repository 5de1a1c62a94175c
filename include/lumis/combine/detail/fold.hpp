// Some rounds by their sums, which tell mean and variance of their estimates for any weights.
#pragma once

#include "lumis/combine/detail/normal_equations.hpp"
#include "lumis/combine/round.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

namespace lumis::LUMIS_ISA::detail {

// f of each component, of a number or a vector of them.
template <class Wide, class F>
[[nodiscard]] LUMIS_HD constexpr Wide each_component(Wide x, F f) {
    if constexpr (std::floating_point<Wide>) {
        return f(x);
    } else {
        for (int i = 0; i < Wide::length(); ++i) x[i] = f(x[i]);
        return x;
    }
}

template <class Wide>
[[nodiscard]] LUMIS_HD bool is_finite(const Wide& x) noexcept {
    bool finite = true;
    static_cast<void>(each_component(x, [&](double component) {
        finite = finite && std::isfinite(component);
        return component;
    }));
    return finite;
}

// Mean and sum of squared deviations, merged as RunningMoments are.
template <class Wide>
struct FoldMoments {
    double count{};
    Wide mean{}, squares{};

    LUMIS_HD void merge(const FoldMoments& other) noexcept {
        if (!(other.count > 0)) return;
        const double sum = count + other.count;
        const Wide between = other.mean - mean;
        mean += between * (other.count / sum);
        // A square of what is large comes after the count, which may be 0: no Inf times 0.
        squares += other.squares + between * (count * other.count / sum) * between;
        count = sum;
    }

    // The mean's; NaN for fewer than two numbers.
    [[nodiscard]] LUMIS_HD Wide standard_error() const noexcept {
        const bool known = count > 1;
        return each_component(squares, [=, divisor = count * (count - 1)](double x) {
            const double error = real::sqrt(real::quotient_where(known, x, divisor));
            return known ? error : std::numeric_limits<double>::quiet_NaN();
        });
    }
};

template <class Wide, std::size_t K>
struct Fold {
    NormalEquations<Wide, K> equations;
    double count{};
    Wide mean{};                       // of the balance heuristic's estimates
    std::array<double, K> controls{};  // means
    // Sums of products of deviations from these means: of estimates, of estimate and control, of controls.
    Wide squares{};
    std::array<Wide, K> products{};
    Symmetric<K> control_products;

    LUMIS_INLINE void add(const Round<Wide, K>& round) noexcept {
        equations.add(round.equations);
        join(1, round.balanced, round.controls);
    }

    LUMIS_HD void merge(const Fold& other) noexcept {
        if (!(other.count > 0)) return;
        equations.add(other.equations);
        squares += other.squares;
        for (std::size_t i = 0; i < K; ++i) {
            products[i] += other.products[i];
            for (std::size_t k = 0; k <= i; ++k) control_products(i, k) += other.control_products(i, k);
        }
        join(other.count, other.mean, other.controls);
    }

    // The rounds' estimates with weights alpha.
    [[nodiscard]] LUMIS_HD FoldMoments<Wide> moments(const std::array<Wide, K>& alpha) const noexcept {
        FoldMoments<Wide> result{count, mean, squares};
        for (std::size_t i = 0; i < K; ++i) {
            result.mean -= alpha[i] * (controls[i] - 1);
            Wide explained = products[i] * 2.0;
            for (std::size_t k = 0; k < K; ++k) explained -= alpha[k] * control_products(i, k);
            result.squares -= alpha[i] * explained;
        }
        // 0 where rounding has left less; infinite, never NaN, beyond double's range.
        result.squares = each_component(result.squares, [](double x) {
            constexpr double infinity = std::numeric_limits<double>::infinity();
            return x <= (std::numeric_limits<double>::max)() ? real::greater(x, 0.0) : infinity;
        });
        return result;
    }

    // Control k alone.
    [[nodiscard]] LUMIS_HD FoldMoments<double> control_moments(std::size_t k) const noexcept {
        return {count, controls[k], control_products(k, k)};
    }

  private:
    // Moves the means to those of these and `others` more rounds, by Chan, Golub and LeVeque's update (1979).
    LUMIS_INLINE void join(double others, const Wide& their_mean,
                           const std::array<double, K>& their_controls) noexcept {
        const double share = others / (count + others), size = count * share;
        const Wide between = their_mean - mean;
        std::array<double, K> controls_between;
        for (std::size_t i = 0; i < K; ++i) controls_between[i] = their_controls[i] - controls[i];
        mean += between * share;
        squares += between * size * between;  // in this order: size is 0 for the first, and a square may overflow
        for (std::size_t i = 0; i < K; ++i) {
            controls[i] += controls_between[i] * share;
            products[i] += between * (controls_between[i] * size);
            for (std::size_t k = 0; k <= i; ++k) {
                control_products(i, k) += controls_between[i] * size * controls_between[k];
            }
        }
        count += others;
    }
};

}  // namespace lumis::LUMIS_ISA::detail
