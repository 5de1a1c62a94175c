// The estimate of an integral from rounds of samples with optimal weights, unbiased. Weights from the samples that they weigh
// would be biased, by 8 % with four rounds in bad cases; so the rounds are dealt out to folds, and each fold takes its weights
// from the others (cross-fitting: Chernozhukov et al. 2018, "Double/debiased machine learning").
#pragma once

#include "lumis/combine/round.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace lumis::LUMIS_ISA {

namespace detail {

// By component, for numbers and vectors of them.
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
    if constexpr (std::floating_point<Wide>) {
        return std::isfinite(x);
    } else {
        double sum = 0;
        for (int i = 0; i < Wide::length(); ++i) sum += std::abs(x[i]);
        return std::isfinite(sum);
    }
}

// Mean and sum of squared deviations of the estimates of some rounds, merged as RunningMoments are.
template <class Wide>
struct Moments {
    double count{};
    Wide mean{}, squares{};

    LUMIS_HD void merge(const Moments& other) noexcept {
        if (!(other.count > 0)) return;
        const double sum = count + other.count;
        const Wide between = other.mean - mean;
        mean += between * (other.count / sum);
        squares += other.squares + between * between * (count * other.count / sum);
        count = sum;
    }
};

// Rounds by their sums: enough to tell mean and variance of their estimates for any weights.
template <class Value, std::size_t K>
struct Fold {
    double count{};
    NormalEquations<InDouble<Value>, K> equations;
    InDouble<Value> mean{};            // of the balance heuristic's estimates
    std::array<double, K> controls{};  // means
    // Sums of products of deviations from the means.
    InDouble<Value> squares{};
    std::array<InDouble<Value>, K> products{};  // estimate times control
    Symmetric<K> control_products;

    LUMIS_INLINE void add(const Round<Value, K>& round) noexcept {
        Fold one;
        one.count = 1;
        one.mean = round.balanced;
        one.controls = round.controls;
        equations.add(round.equations);
        merge_moments(one);
    }

    LUMIS_HD void merge(const Fold& other) noexcept {
        if (!(other.count > 0)) return;
        equations.add(other.equations);
        squares += other.squares;
        for (std::size_t i = 0; i < K; ++i) products[i] += other.products[i];
        for (std::size_t i = 0; i < control_products.entries.size(); ++i) {
            control_products.entries[i] += other.control_products.entries[i];
        }
        merge_moments(other);
    }

    // Of the estimates with these weights.
    [[nodiscard]] LUMIS_HD Moments<InDouble<Value>> moments(const ControlWeights<Value, K>& alpha) const noexcept {
        Moments<InDouble<Value>> result{count, mean, squares};
        for (std::size_t i = 0; i < K; ++i) {
            result.mean -= alpha[i] * (controls[i] - 1);
            InDouble<Value> explained = products[i] * 2.0;
            for (std::size_t k = 0; k < K; ++k) explained -= alpha[k] * control_products(i, k);
            result.squares -= alpha[i] * explained;
        }
        // 0 where rounding leaves less; infinite, not NaN, beyond double's range.
        result.squares = each_component(result.squares, [](double x) {
            constexpr double infinity = std::numeric_limits<double>::infinity();
            return x <= (std::numeric_limits<double>::max)() ? real::greater(x, 0.0) : infinity;
        });
        return result;
    }

  private:
    // Chan, Golub and LeVeque's update (1979), with the sums of products added already.
    LUMIS_INLINE void merge_moments(const Fold& other) noexcept {
        const double sum = count + other.count, share = other.count / sum, size = count * share;
        const InDouble<Value> from_mean = other.mean - mean;
        std::array<double, K> from_controls;
        for (std::size_t i = 0; i < K; ++i) from_controls[i] = other.controls[i] - controls[i];
        mean += from_mean * share;
        squares += from_mean * from_mean * size;
        for (std::size_t i = 0; i < K; ++i) {
            controls[i] += from_controls[i] * share;
            products[i] += from_mean * (from_controls[i] * size);
            for (std::size_t k = 0; k <= i; ++k) {
                control_products(i, k) += from_controls[i] * from_controls[k] * size;
            }
        }
        count = sum;
    }
};

}  // namespace detail

// Accumulates for one integral, over K techniques: of a number, or of a glm::vec, each component with weights of its own.
// In double, whatever Value is.
template <SumsInDouble Value, std::size_t K>
class CrossFitted {
  public:
    using Weights = ControlWeights<Value, K>;
    static constexpr std::size_t folds = 4;

    // A round with a value that is not finite is counted in rejected() and enters nothing else.
    LUMIS_INLINE void add(const Round<Value, K>& round) noexcept {
        double controls = 0;
        for (std::size_t k = 0; k < K; ++k) controls += round.equations.a(k, k);
        if (!detail::is_finite(round.balanced) || !std::isfinite(controls)) {
            ++rejected_;
            return;
        }
        fold_of(rounds_).add(round);
        ++rounds_;
    }

    // As if every round added to `other` had been added here.
    LUMIS_HD void merge(const CrossFitted& other) noexcept {
        for (std::size_t i = 0; i < folds; ++i) fold_of(rounds_ + i).merge(other.folds_[i]);
        rounds_ += other.rounds_;
        rejected_ += other.rejected_;
    }

    // Unbiased, after any number of rounds; 0 of none. A single round is the balance heuristic's estimate.
    [[nodiscard]] LUMIS_HD Value estimate() const noexcept { return Value(moments().mean); }

    // Of the estimate; NaN for fewer than two rounds.
    [[nodiscard]] LUMIS_HD Value standard_error() const noexcept { return error_of(moments()); }

    // The same with weights from elsewhere: of neighbouring pixels, or of earlier passes. Unbiased if they do not depend on
    // these rounds. {}: the balance heuristic's.
    [[nodiscard]] LUMIS_HD Value estimate(const Weights& alpha) const noexcept { return Value(moments(alpha).mean); }
    [[nodiscard]] LUMIS_HD Value standard_error(const Weights& alpha) const noexcept {
        return error_of(moments(alpha));
    }

    // alpha, from all rounds. Their sum estimates the integral as well, but not without bias.
    [[nodiscard]] LUMIS_HD Weights weights() const noexcept { return weights_without(folds); }

    [[nodiscard]] LUMIS_HD std::uint64_t rounds() const noexcept { return rounds_; }
    [[nodiscard]] LUMIS_HD std::uint64_t rejected() const noexcept { return rejected_; }

  private:
    using Moments = detail::Moments<InDouble<Value>>;

    [[nodiscard]] LUMIS_HD detail::Fold<Value, K>& fold_of(std::uint64_t round) noexcept {
        return folds_[static_cast<std::size_t>(round % folds)];
    }

    [[nodiscard]] LUMIS_HD Weights weights_without(std::size_t left_out) const noexcept {
        detail::NormalEquations<InDouble<Value>, K> sum;
        double count = 0;
        for (std::size_t i = 0; i < folds; ++i) {
            if (i == left_out) continue;
            sum.add(folds_[i].equations);
            count += folds_[i].count;
        }
        return sum.solution(count);
    }

    [[nodiscard]] LUMIS_HD Moments moments() const noexcept {
        Moments result;
        for (std::size_t i = 0; i < folds; ++i) result.merge(folds_[i].moments(weights_without(i)));
        return result;
    }
    [[nodiscard]] LUMIS_HD Moments moments(const Weights& alpha) const noexcept {
        Moments result;
        for (const auto& fold : folds_) result.merge(fold.moments(alpha));
        return result;
    }

    [[nodiscard]] LUMIS_HD static Value error_of(const Moments& moments) noexcept {
        const double count = moments.count;
        return Value(detail::each_component(moments.squares, [=](double squares) {
            return count > 1 ? std::sqrt(squares / (count * (count - 1))) : std::numeric_limits<double>::quiet_NaN();
        }));
    }

    std::array<detail::Fold<Value, K>, folds> folds_{};
    std::uint64_t rounds_{};
    std::uint64_t rejected_{};
};

}  // namespace lumis::LUMIS_ISA
