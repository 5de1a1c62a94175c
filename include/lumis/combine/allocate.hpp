// Pilot samples tell how many samples to take of which technique: counts for multi_sample, probabilities for one_sample.
//
// A few rounds are enough. Each sample tells of all splits of samples at once, by importance weights, so that nothing has to
// be drawn with each. Moments are kept as sums: nothing is allocated, and plans of several threads merge.
#pragma once

#include "lumis/combine/combination.hpp"
#include "lumis/combine/detail/pilot_moments.hpp"
#include "lumis/combine/detail/rounds_in_lanes.hpp"
#include "lumis/combine/forecast.hpp"
#include "lumis/core/assert.hpp"
#include "lumis/core/detail/for_each_index.hpp"
#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

// What the noise of an estimate is judged by: a number itself, and the luminance of a colour (Rec. 709).
struct Luminance {
    template <class Number>
        requires std::is_arithmetic_v<Number>
    [[nodiscard]] LUMIS_HD constexpr double operator()(Number x) const noexcept { return static_cast<double>(x); }

    template <class Number, glm::qualifier Q>
    [[nodiscard]] LUMIS_HD constexpr double operator()(const glm::vec<3, Number, Q>& rgb) const noexcept {
        return 0.2126 * static_cast<double>(rgb.x) + 0.7152 * static_cast<double>(rgb.y) +
               0.0722 * static_cast<double>(rgb.z);
    }
};

// Stands in place of a heuristic: the counts are for optimal(take(n, s)...), where a technique of count 0 is a control variate.
struct OptimalWeights {};

namespace detail {

template <class... S>
using ForecastOf = Forecast<DeltaStrategy<std::remove_cvref_t<S>>...>;

template <class H, std::size_t smooth>
using PilotSums = std::conditional_t<std::same_as<H, OptimalWeights>, PilotEquations<smooth>, PilotMoments<smooth>>;

// What a round yields in one lane; R is a number, or lanes of it.
template <Real R, class X>
[[nodiscard]] LUMIS_HD auto value_in([[maybe_unused]] std::size_t lane, const X& x) noexcept {
    if constexpr (std::floating_point<R>) {
        return x;
    } else {
        return lane_of(x, lane);
    }
}

}  // namespace detail

// Made by allocate(). H is the heuristic of the estimators to come.
template <class H, class... S>
class Allocation : private Combination<BalanceHeuristic, S...> {
    using Base = Combination<BalanceHeuristic, S...>;
    static constexpr std::size_t size = sizeof...(S), smooth = detail::number_of_smooth<S...>;

  public:
    using typename Base::Scalar;
    using Costs = SamplingCosts<size>;
    using Limits = AllocationLimits<size>;

    static_assert(std::floating_point<Scalar>,
                  "pilot samples are drawn by strategies of numbers, from numbers or from lanes");

    static_assert(
        smooth <= 1 || DensityHeuristic<H, Scalar, smooth> || std::same_as<H, OptimalWeights>,
        "an allocation weighs by densities alone: it does not tell how a partition by points, or weights that ask for "
        "counts too, divide samples");

    LUMIS_HD explicit constexpr Allocation(const H& heuristic, Take<S>&&... techniques)
        : Base{BalanceHeuristic{}, {static_cast<Scalar>(techniques.count)...}, std::move(techniques)...},
          heuristic_{heuristic},
          counts_{techniques.count...} {
        LUMIS_ASSERT(real::largest_of(std::array{-techniques.count...}) < 0);
    }

    // A pilot round: draws as many samples of each technique as was given to allocate, and returns the estimate that they make,
    // by the balance heuristic. f is called as by MultiSample::estimate. norm(f(x)) is the number whose variance counts; it may
    // be negative, and scales with f(x). A sample of which it, or the density, is not finite is counted in rejected() and enters
    // nothing but the estimate.
    //
    // A source that yields lanes makes a round in each of them.
    template <class F, class U, class Norm = Luminance>
    requires UniformSource<U, RealFrom<U, Scalar>> LUMIS_HD auto add(F&& f, U&& uniforms, Norm norm = {}) {
        using R = RealFrom<U, Scalar>;
        using First = typename Base::template Nth<0>;
        using Value = decltype(this->template draw<0, R>(f, detail::next_for<First, R>(uniforms)));
        Value sum = zero<Value>::value();
        static_assert(std::invocable<Norm&, decltype(detail::value_in<R>(0, sum))>,
                      "what is neither a number nor a colour of three components comes with a norm: "
                      "add(f, uniforms, norm)");
        constexpr std::size_t lanes = sizeof(R) / sizeof(Scalar);
        const auto add_up = [&](const Value& value) { sum = Value(sum + value); };
        detail::for_each_index<size>([&](auto i) {
            for (int k = 0; k < counts_[i]; ++k) {
                const auto u = detail::next_for<typename Base::template Nth<i>, R>(uniforms);
                if constexpr (Base::template is_delta<i>) {
                    const Value value = Base::template as_value<Value>(this->template draw<i, R>(f, u));
                    add_up(value);
                    for (std::size_t lane = 0; lane < lanes; ++lane) {
                        record_delta<i>(norm(detail::value_in<R>(lane, value)));
                    }
                } else {
                    const auto seen = this->template observe<i, R>(f, u);
                    R p = Scalar(0);
                    for (std::size_t t = 0; t < size; ++t) p += this->factor(t) * seen.densities[t];
                    const R divisor = detail::positive_divisor(seen.drawn, p);
                    if (real::any(seen.drawn)) {
                        add_up(detail::selected(seen.drawn, detail::quotient<Value>(seen.value, divisor)));
                    }
                    for (std::size_t lane = 0; lane < lanes; ++lane) {
                        if (detail::number_in(lane, seen.drawn)) {
                            record(norm(detail::value_in<R>(lane, seen.value)), seen.densities, lane);
                        } else {
                            sums_.add_nothing(place<i>(), static_cast<double>(counts_[i]));
                        }
                    }
                }
            }
        });
        rounds_ += static_cast<double>(lanes);
        return sum;
    }

    // As if the rounds of `other` had been added here: another thread's, for the same integral.
    LUMIS_HD void merge(const Allocation& other) noexcept {
        sums_.merge(other.sums_);
        detail::for_each_index<size - smooth>([&](auto d) {
            delta_sums_[d].first += other.delta_sums_[d].first;
            delta_sums_[d].second += other.delta_sums_[d].second;
        });
        rounds_ += other.rounds_;
        rejected_ += other.rejected_;
    }

    [[nodiscard]] LUMIS_HD std::uint64_t rejected() const noexcept { return rejected_; }

    // See Forecast.
    [[nodiscard]] LUMIS_HD static Costs costs_from_times(const std::array<double, size>& alone, double together,
                                                         const std::array<double, size>& one_more) noexcept {
        return detail::ForecastOf<S...>::costs_from_times(alone, together, one_more);
    }

    // The variance of each split of samples. Those for several integrals add up.
    [[nodiscard]] LUMIS_HD detail::ForecastOf<S...> forecast() const noexcept { return {sums_, delta_sums_, rounds_}; }

    // What the forecast for this integral advises: see there.
    [[nodiscard]] LUMIS_HD auto counts(const Costs& costs = {}, const Limits& limits = {}) const noexcept {
        return forecast().counts(costs, limits);
    }
    [[nodiscard]] LUMIS_HD auto probabilities(const Costs& costs = {}, const Limits& limits = {}) const noexcept {
        return forecast().probabilities(costs, limits);
    }

  private:
    // The place of technique I among those of its kind.
    template <std::size_t I>
    [[nodiscard]] LUMIS_HD static constexpr std::size_t place() noexcept {
        std::size_t result = 0;
        detail::for_each_index<I>([&](auto k) { result += Base::template is_delta<k> == Base::template is_delta<I>; });
        return result;
    }

    // What one sample of a delta strategy contributes to a round.
    template <std::size_t I>
    LUMIS_HD void record_delta(double contribution) noexcept {
        if (!std::isfinite(contribution)) {
            ++rejected_;
            return;
        }
        auto& sums = delta_sums_[place<I>()];
        sums.first += contribution;
        sums.second += contribution * contribution * static_cast<double>(counts_[I]);
    }

    template <Real R>
    LUMIS_HD void record(double f, const std::array<R, size>& densities_in_lanes, std::size_t lane) noexcept {
        std::array<double, smooth> densities{};
        double p = 0;
        detail::for_each_index<size>([&](auto k) {
            if constexpr (!Base::template is_delta<k>) {
                double& own = densities[place<k>()];
                own = static_cast<double>(detail::number_in(lane, densities_in_lanes[k]));
                p += counts_[k] * own;
            }
        });
        if (!std::isfinite(f) || !std::isfinite(p)) {
            ++rejected_;
            return;
        }
        sums_.template add<Scalar>(heuristic_, f, densities, p);
    }

    [[no_unique_address]] H heuristic_;
    std::array<int, size> counts_;
    detail::PilotSums<H, smooth> sums_;
    std::array<detail::FirstAndSecond, size - smooth> delta_sums_{};
    double rounds_ = 0;
    std::uint64_t rejected_ = 0;
};

// A plan for estimators by a heuristic that is told densities: allocate(PowerHeuristic{}, take(1, bsdf), take(1, light)). A
// pilot round draws these counts, 1 or more.
//
//   for (int i = 0; i < 16; ++i) plan.add(f, uniforms);
//   const auto n = plan.counts({.of_sample = {1, 4}});
//   const auto direct = multi_sample(PowerHeuristic{}, take(n[0], bsdf), take(n[1], light));
//
// The estimate stays unbiased as the counts depend on no sample that enters it. The pilot's own estimates may be averaged in by
// weights that were fixed before: the pilot's share of the time, or of the rounds if their number does not depend on the plan.
// Weights by variances, or by a number of rounds that the plan decides, see the samples and bias the mean.
template <class H, class First, class... Rest>
    requires(HeuristicFor<H, First, Rest...> || std::same_as<H, OptimalWeights>)
&&Composable<First, Rest...> [[nodiscard]] LUMIS_HD constexpr auto allocate(const H& heuristic,
                                                                            Take<First> first LUMIS_LIFETIME_BOUND,
                                                                            Take<Rest>... rest LUMIS_LIFETIME_BOUND) {
    return Allocation<H, First, Rest...>{heuristic, std::move(first), std::move(rest)...};
}

template <class... S>
void allocate(Take<S>... the_first_argument_must_be_a_heuristic) = delete;

}  // namespace lumis::LUMIS_ISA
