// How to divide samples among techniques: the counts, or probabilities, of the least variance times cost (Grittmann et al.
// 2022, "Efficiency-Aware Multiple Importance Sampling for Bidirectional Rendering Algorithms"). Allocations make forecasts
// from pilot samples, see allocate.hpp.
#pragma once

#include "lumis/combine/detail/pilot_equations.hpp"
#include "lumis/combine/detail/pilot_moments.hpp"
#include "lumis/combine/detail/splits.hpp"
#include "lumis/combine/sampling_costs.hpp"
#include "lumis/core/assert.hpp"
#include "lumis/core/detail/for_each_index.hpp"
#include "lumis/core/platform.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

namespace lumis::LUMIS_ISA {

// The variances of estimators that divide their samples among techniques in different ways, as predicted for one integral or
// for several; is_delta tells which of the techniques are delta strategies. With neither pilot samples nor limits all
// techniques are treated alike.
template <bool... is_delta>
class Forecast {
  public:
    static constexpr std::size_t size = sizeof...(is_delta);
    using Costs = SamplingCosts<size>;
    using Limits = AllocationLimits<size>;
    using Counts = std::array<int, size>;
    using Probabilities = std::array<double, size>;

  private:
    static constexpr std::size_t deltas = (std::size_t{is_delta} + ... + 0), smooth = size - deltas;
    static_assert(smooth <= detail::most_to_split,
                  "samples are divided among at most five techniques with a density; a Mixture or a LightSet is one");
    static constexpr std::size_t splits = detail::Splits<smooth>::size;

  public:
    LUMIS_HD Forecast() = default;

    // Made of so many pilot rounds. Sums: PilotMoments, or PilotEquations, which ask every density even of count 0.
    template <class Sums>
    LUMIS_HD Forecast(const Sums& sums, const std::array<detail::FirstAndSecond, deltas>& delta_sums,
                      double rounds) noexcept
        : rounds_{rounds}, asks_all_{std::same_as<Sums, detail::PilotEquations<smooth>>} {
        if (!(rounds > 0)) return;
        double delta_mean = 0;
        detail::for_each_index<deltas>([&](auto d) {
            const double mean = delta_sums[d].first / rounds, second = delta_sums[d].second / rounds;
            delta_variances_[d] = second - mean * mean;
            // Optimal weights take the mean off, as if it were known.
            delta_seconds_[d] = asks_all_ ? delta_variances_[d] : second;
            if (!asks_all_) delta_mean += mean;
        });
        misses_ = sums.misses;
        std::size_t k = 0;
        detail::for_each_split<smooth>([&](const auto& split) {
            const detail::SplitOutcome outcome = sums.outcome(k, split, rounds);
            variances_[k] = outcome.variance;
            seconds_[k] = outcome.second;
            squared_means_[k] = (outcome.mean + delta_mean) * (outcome.mean + delta_mean);
            ++k;
        });
    }

    // Costs from measured times of multi-sample estimates: by one sample of technique i alone, by one sample of each technique,
    // and by one more of technique i. What times do not tell is a cost of the estimate itself: that is in `alone`, and so in
    // of_sample.
    [[nodiscard]] LUMIS_HD static Costs costs_from_times(const std::array<double, size>& alone, double together,
                                                         const std::array<double, size>& one_more) noexcept {
        Costs costs{.of_sample = alone};
        // A sample more costs the densities of the others besides: summed over techniques, all densities smooth - 1 times.
        std::array<double, size> others{};
        double sum = 0;
        for (std::size_t i = 0; i < size; ++i) {
            if (kind(i)) continue;
            others[i] = one_more[i] - together - alone[i];
            sum += others[i];
        }
        for (std::size_t i = 0; i < size; ++i) {
            const double density = smooth > 1 && !kind(i) ? sum / static_cast<double>(smooth - 1) - others[i] : 0;
            costs.of_density[i] = density > 0 ? density : 0;
        }
        return costs;
    }

    // Adds the variances for other integrals: of pixels, or of points that a material covers. Their sum tells which counts are
    // best for all of them.
    LUMIS_HD Forecast& operator+=(const Forecast& other) noexcept {
        const auto add = [](auto& mine, const auto& theirs) {
            for (std::size_t i = 0; i < mine.size(); ++i) mine[i] += theirs[i];
        };
        rounds_ += other.rounds_;
        asks_all_ = asks_all_ || other.asks_all_;
        for (std::size_t k = 0; k < splits; ++k) misses_[k] |= other.misses_[k];
        add(variances_, other.variances_);
        add(seconds_, other.seconds_);
        add(squared_means_, other.squared_means_);
        add(delta_variances_, other.delta_variances_);
        add(delta_seconds_, other.delta_seconds_);
        return *this;
    }

    // The counts for multi_sample that have the least variance times cost. The fewest where several do: twice the samples are
    // worth twice the estimates, unless an estimate has a cost of its own. One sample of each technique where the limits leave
    // no choice.
    [[nodiscard]] LUMIS_HD Counts counts(const Costs& costs = {}, const Limits& limits = {}) const noexcept {
        Best best = all_alike();
        for_each_allowed(limits, [&](std::size_t k, const auto& split) {
            const int largest = smooth > 0 ? limits.most_samples / sum_of(split) : 1;
            // The score without delta strategies falls all the way, or is the same: the largest scale tells.
            const int step = deltas == 0 && largest > 2 ? largest - 1 : 1;
            for (int scale = 1;; scale += step) {
                const auto score = [&](const Amounts& n) {
                    return multi_sample_variance(k, scale, n) * cost(n, costs);
                };
                Best local{arranged(split, scale)};
                int left = limits.most_samples - static_cast<int>(sum_of(local.amounts));
                if (left < 0) break;
                local.score = score(local.amounts);
                // Delta strategies do not know of each other: one more sample goes to where it helps most.
                for (bool improves = true; improves && left > 0; --left) {
                    const Amounts before = local.amounts;
                    improves = false;
                    for_each_delta([&](std::size_t i) {
                        Amounts more = before;
                        more[i] += 1;
                        improves |= local.offer(score(more), more);
                    });
                }
                best.offer(local.score, local.amounts);
                if (scale > largest - step) break;
            }
        });
        Counts counts{};
        for (std::size_t i = 0; i < size; ++i) counts[i] = static_cast<int>(best.amounts[i]);
        return counts;
    }

    // The probabilities for one_sample that have the least variance times cost. They sum to 1.
    [[nodiscard]] LUMIS_HD Probabilities probabilities(const Costs& costs = {},
                                                       const Limits& limits = {}) const noexcept {
        Best best = all_alike();
        for_each_allowed(limits, [&](std::size_t k, const auto& split) {
            const double scale = smooth > 0 ? 1.0 / sum_of(split) : 1.0;
            const auto score = [&](const Amounts& odds) {
                return one_sample_variance(k, scale, odds) * cost(normalised(odds), costs);
            };
            Best local{arranged(split, scale)};
            local.score = score(local.amounts);
            // Each delta strategy in turn: the score has one minimum along each.
            for (int turn = 0; turn < 4 && deltas > 0; ++turn) {
                for_each_delta([&](std::size_t i) {
                    Amounts odds = local.amounts;
                    for (int step = -24; step <= 24; ++step) {
                        odds[i] = std::exp2(step / 4.0);
                        local.offer(score(odds), odds);
                    }
                });
            }
            best.offer(local.score, local.amounts);
        });
        return normalised(best.amounts);
    }

    // The variance of a multi-sample estimate with such counts; NaN if none of the compared splits is in proportion to them.
    [[nodiscard]] LUMIS_HD double multi_sample_variance(const Counts& counts) const noexcept {
        return at(counts,
                  [&](std::size_t k, double scale, const Amounts& n) { return multi_sample_variance(k, scale, n); });
    }

    // The same of a one-sample estimate with probabilities in proportion to such counts.
    [[nodiscard]] LUMIS_HD double one_sample_variance(const Counts& counts) const noexcept {
        return at(counts,
                  [&](std::size_t k, double scale, const Amounts& n) { return one_sample_variance(k, scale, n); });
    }

  private:
    using Amounts = std::array<double, size>;  // samples of each technique, or odds

    struct Best {
        Amounts amounts{};
        double score = (std::numeric_limits<double>::max)();

        // A better score is better by more than rounding: else the first stays, which is the smaller.
        LUMIS_HD constexpr bool offer(double new_score, const Amounts& new_amounts) noexcept {
            if (!(new_score < score * (1 - 1e-9))) return false;
            score = new_score;
            amounts = new_amounts;
            return true;
        }
    };

    [[nodiscard]] LUMIS_HD static constexpr Best all_alike() noexcept { return {detail::ones<size>()}; }

    // Whether technique i is a delta strategy, and its place among those of its kind.
    [[nodiscard]] LUMIS_HD static constexpr bool kind(std::size_t i) noexcept {
        constexpr bool kinds[]{is_delta...};
        return kinds[i];
    }
    [[nodiscard]] LUMIS_HD static constexpr std::size_t place(std::size_t i) noexcept {
        std::size_t result = 0;
        for (std::size_t k = 0; k < i; ++k) result += kind(k) == kind(i);
        return result;
    }

    template <class Visit>
    LUMIS_HD static void for_each_delta(Visit visit) noexcept {
        for (std::size_t i = 0; i < size; ++i) {
            if (kind(i)) visit(i);
        }
    }

    template <class Number, std::size_t N>
    [[nodiscard]] LUMIS_HD static constexpr Number sum_of(const std::array<Number, N>& numbers) noexcept {
        Number sum{};
        for (const Number number : numbers) sum += number;
        return sum;
    }
    [[nodiscard]] LUMIS_HD static constexpr Amounts normalised(Amounts amounts) noexcept {
        const double sum = sum_of(amounts);
        for (double& amount : amounts) amount /= sum;
        return amounts;
    }

    // A multiple of a split, and one sample of each delta strategy.
    [[nodiscard]] LUMIS_HD static constexpr Amounts arranged(const std::array<int, smooth>& split,
                                                             double scale) noexcept {
        Amounts amounts = detail::ones<size>();
        for (std::size_t i = 0; i < size; ++i) {
            if (!kind(i)) amounts[i] = scale * split[place(i)];
        }
        return amounts;
    }

    // A floor under each technique's share, for what the pilot may have missed: one sample in as many as there were pilot
    // rounds. Without it, four rounds that miss the broad one of two bumps leave it to a Gaussian in the other, at 1e8 times
    // the variance.
    static constexpr double rounds_to_leave_out = 256;

    // Calls visit(k, split) for those that the limits and the number of pilot rounds allow.
    template <class Visit>
    LUMIS_HD void for_each_allowed(const Limits& limits, Visit visit) const noexcept {
        std::size_t k = 0;
        detail::for_each_split<smooth>([&](const auto& split) {
            bool complete = true, covered = false, founded = true;
            for (std::size_t i = 0; i < size; ++i) {
                if (kind(i)) continue;
                const int count = split[place(i)];
                complete = complete && count > 0;
                covered = covered || (count > 0 && limits.covers[i]);
                founded = founded && (count > 0 ? count * rounds_ >= sum_of(split) : rounds_ >= rounds_to_leave_out);
            }
            if ((complete || covered) && (founded || k == 0) && !misses_[k]) visit(k, split);
            ++k;
        });
    }

    [[nodiscard]] LUMIS_HD double cost(const Amounts& n, const Costs& costs) const noexcept {
        double densities = 0;  // of all techniques that take part
        for (std::size_t i = 0; i < size; ++i) {
            LUMIS_ASSERT(costs.of_sample[i] > 0 && costs.of_density[i] >= 0);
            if (!kind(i) && (asks_all_ || n[i] > 0)) densities += costs.of_density[i];
        }
        double sum = costs.of_estimate;
        for (std::size_t i = 0; i < size; ++i) {
            sum += n[i] * (kind(i) ? costs.of_sample[i] : costs.of_sample[i] + densities - costs.of_density[i]);
        }
        return sum;
    }

    // Split k times a scale, and any samples of delta strategies: as n has them.
    [[nodiscard]] LUMIS_HD double multi_sample_variance(std::size_t k, double scale, const Amounts& n) const noexcept {
        double sum = variances_[k] / scale;
        for_each_delta([&](std::size_t i) { sum += delta_variances_[place(i)] / n[i]; });
        return sum;
    }
    [[nodiscard]] LUMIS_HD double one_sample_variance(std::size_t k, double scale, const Amounts& odds) const noexcept {
        double sum = seconds_[k] / scale;
        for_each_delta([&](std::size_t i) { sum += delta_seconds_[place(i)] / odds[i]; });
        return sum * sum_of(odds) - squared_means_[k];
    }

    // What function(k, scale, n) returns for the split that counts are a multiple of.
    template <class Function>
    [[nodiscard]] LUMIS_HD double at(const Counts& counts, Function function) const noexcept {
        double result = std::numeric_limits<double>::quiet_NaN();
        Amounts n{};
        for (std::size_t i = 0; i < size; ++i) n[i] = counts[i];
        std::size_t k = 0;
        detail::for_each_split<smooth>([&](const auto& split) {
            const double scale = smooth > 0 ? (sum_of(n) - deltas_of(n)) / sum_of(split) : 1;
            Amounts multiple = arranged(split, scale);
            for_each_delta([&](std::size_t i) { multiple[i] = n[i]; });
            if (multiple == n) result = misses_[k] ? std::numeric_limits<double>::infinity() : function(k, scale, n);
            ++k;
        });
        return result;
    }
    [[nodiscard]] LUMIS_HD static double deltas_of(const Amounts& n) noexcept {
        double sum = 0;
        for_each_delta([&](std::size_t i) { sum += n[i]; });
        return sum;
    }

    // One entry a split: the sum over techniques of the variance, and of the second moment, of one contribution over the count;
    // and the square of the integral. The integral is estimated with each split anew: so its error cancels that of the second
    // moment, where both are nearly equal.
    double rounds_ = 0;
    bool asks_all_ = false;
    std::array<bool, splits> misses_{};
    std::array<double, splits> variances_{}, seconds_{}, squared_means_{};
    std::array<double, deltas> delta_variances_{}, delta_seconds_{};  // of one sample
};

}  // namespace lumis::LUMIS_ISA
