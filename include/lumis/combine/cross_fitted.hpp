// The estimate of an integral from rounds of samples with optimal weights, without bias. Weights from the very samples that
// they weigh are biased, by as much as 8 % of the integral at four rounds. So the rounds are dealt out to folds, and each fold
// takes its weights from the others (cross-fitting: Chernozhukov et al. 2018, "Double/debiased machine learning").
//
// Rounds have to be independent of each other. Those drawn from low-discrepancy points of one randomisation are not: one fold's
// points tell of another's, and the estimate is biased. Such rounds take weights from another randomisation: estimate(alpha).
#pragma once

#include "lumis/combine/detail/fold.hpp"
#include "lumis/combine/round.hpp"
#include "lumis/core/platform.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace lumis::LUMIS_ISA {

// Accumulates rounds of K techniques for one integral: of a number or, with weights for each component, of a glm::vec. Sums in
// double, whatever Value is.
template <class Value, std::size_t K>
class CrossFitted {
    static_assert(SumsInDouble<Value>, "optimal weights are for integrands that return a number or a glm::vec");
    using Wide = InDouble<Value>;
    using Moments = detail::FoldMoments<Wide>;

  public:
    // alpha_k, by which the density of technique k is subtracted from the integrand. 0: the balance heuristic's estimate.
    using Weights = std::array<Wide, K>;

    // The mean of whole numbers is none.
    using Estimate = std::conditional_t<std::integral<Value>, Wide, Value>;

    static constexpr std::size_t folds = 4;

    // A round that is not finite is counted in rejected() and enters nothing else.
    LUMIS_INLINE void add(const Round<Wide, K>& round) noexcept {
        double squares = 0;
        for (std::size_t k = 0; k < K; ++k) squares += round.equations.a(k, k);
        if (!detail::is_finite(round.balanced) || !std::isfinite(squares)) {
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

    // Unbiased, after any number of rounds; 0 of none. One round is the balance heuristic's estimate.
    [[nodiscard]] LUMIS_HD Estimate estimate() const noexcept { return Estimate(moments().mean); }

    // The estimate's; NaN for fewer than two rounds. It takes the rounds' estimates as independent, but folds share the rounds
    // that they take weights from: its square is too small by up to 22 % at two rounds, 12 % at four, 5 % at seven, 1 % at
    // sixteen. As any from few rounds, it is too small as well while what happens rarely has not happened yet.
    [[nodiscard]] LUMIS_HD Estimate standard_error() const noexcept { return Estimate(moments().standard_error()); }

    // The same with weights from elsewhere, as of neighbouring pixels or earlier passes. Unbiased if they do not depend on
    // these rounds, and so is the square of the standard error.
    [[nodiscard]] LUMIS_HD Estimate estimate(const Weights& alpha) const noexcept {
        return Estimate(moments(alpha).mean);
    }
    [[nodiscard]] LUMIS_HD Estimate standard_error(const Weights& alpha) const noexcept {
        return Estimate(moments(alpha).standard_error());
    }

    // alpha from all rounds. Their sum is the integral as well, but estimates it with bias.
    [[nodiscard]] LUMIS_HD Weights weights() const noexcept { return weights_without(folds); }

    // What the density of technique k integrates to over all that the techniques draw, as its mean over the rounds: 1, up to a
    // few standard errors. A technique of count 0 of which that is not so must not serve as a control variate.
    [[nodiscard]] LUMIS_HD double control_mean(std::size_t k) const noexcept { return control_moments(k).mean; }
    [[nodiscard]] LUMIS_HD double control_standard_error(std::size_t k) const noexcept {
        return control_moments(k).standard_error();
    }

    [[nodiscard]] LUMIS_HD std::uint64_t rounds() const noexcept { return rounds_; }
    [[nodiscard]] LUMIS_HD std::uint64_t rejected() const noexcept { return rejected_; }

  private:
    [[nodiscard]] LUMIS_HD detail::Fold<Wide, K>& fold_of(std::uint64_t round) noexcept {
        return folds_[static_cast<std::size_t>(round % folds)];
    }

    [[nodiscard]] LUMIS_HD Weights weights_without(std::size_t left_out) const noexcept {
        detail::NormalEquations<Wide, K> sum;
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
    [[nodiscard]] LUMIS_HD detail::FoldMoments<double> control_moments(std::size_t k) const noexcept {
        detail::FoldMoments<double> result;
        for (const auto& fold : folds_) result.merge(fold.control_moments(k));
        return result;
    }

    std::array<detail::Fold<Wide, K>, folds> folds_{};
    std::uint64_t rounds_{};
    std::uint64_t rejected_{};
};

}  // namespace lumis::LUMIS_ISA
