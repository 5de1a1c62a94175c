// Estimators that learn from samples, over the same integrand and strategies as the rest: optimal weights, and numbers of samples
// by a pilot.
#pragma once

#include "thread_clock.hpp"
#include <lumis/combine/allocate.hpp>
#include <lumis/combine/multi_sample.hpp>
#include <lumis/combine/optimal.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace convergence {

// Each sum is the estimate of `count` rounds, one sample of each technique a round, by weights that are learnt from them.
template <class F, class... S>
struct OptimalWeights {
    F f;
    std::tuple<S...> strategies;

    void operator()(std::span<double> sums, std::int64_t count, auto& uniforms) const {
        for (double& sum : sums) {
            auto best = std::apply([](const auto&... s) { return lumis::optimal(lumis::take(1, s)...); }, strategies);
            for (std::int64_t i = 0; i < count; ++i) best.add(f, uniforms);
            // The study is to see what is not finite, which the estimator leaves out and counts.
            const bool is_spoilt = best.rejected() > 0;
            sum = is_spoilt ? std::numeric_limits<double>::quiet_NaN() : best.estimate() * static_cast<double>(count);
        }
    }
};

// Each sum is that of `count` estimates by the counts that a pilot advises. A pilot serves all sums of a call, and is not averaged
// in. What samples and densities cost is measured in the first call, which no study counts.
template <class F, class... S>
class AllocatedSamples {
    static constexpr std::size_t size = sizeof...(S);
    using Heuristic = lumis::BalanceHeuristic;

  public:
    // covers: which technique draws all points where the integrand is not 0.
    AllocatedSamples(const F& f, const std::array<bool, size>& covers, const S&... strategies)
        : f_{f}, covers_{covers}, strategies_{strategies...} {}

    void operator()(std::span<double> sums, std::int64_t count, auto& uniforms) const {
        if (!costs_) costs_ = measured_costs(uniforms);
        auto plan = new_plan();
        for (int i = 0; i < pilot_rounds; ++i) (void)plan.add(f_, uniforms);
        const auto estimator = taking(plan.counts(*costs_, {.covers = covers_}));
        for (double& sum : sums) {
            sum = 0;
            for (std::int64_t i = 0; i < count; ++i) sum += estimator.estimate(f_, uniforms);
        }
    }

  private:
    using Counts = std::array<int, size>;
    using Costs = lumis::SamplingCosts<size>;
    static constexpr int pilot_rounds = 256;  // enough to leave a technique out

    [[nodiscard]] auto new_plan() const {
        return std::apply([](const auto&... s) { return lumis::allocate(Heuristic{}, lumis::take(1, s)...); },
                          strategies_);
    }
    [[nodiscard]] auto taking(const Counts& counts) const { return taking(counts, std::index_sequence_for<S...>{}); }
    template <std::size_t... I>
    [[nodiscard]] auto taking(const Counts& counts, std::index_sequence<I...>) const {
        return multi_sample(Heuristic{}, lumis::take(counts[I], std::get<I>(strategies_))...);
    }

    [[nodiscard]] Costs measured_costs(auto& uniforms) const {
        Counts once_each;
        once_each.fill(1);
        std::array<double, size> alone, one_more;
        for (std::size_t i = 0; i < size; ++i) {
            Counts only{}, more = once_each;
            only[i] = 1;
            more[i] = 2;
            alone[i] = seconds_of_estimate(only, uniforms);
            one_more[i] = seconds_of_estimate(more, uniforms);
        }
        return decltype(new_plan())::costs_from_times(alone, seconds_of_estimate(once_each, uniforms), one_more);
    }

    // CPU time; the least of several batches, which nothing else has interrupted.
    [[nodiscard]] double seconds_of_estimate(const Counts& counts, auto& uniforms) const {
        const auto estimator = taking(counts);
        constexpr int batches = 8, estimates = 1000;
        double least = std::numeric_limits<double>::infinity();
        volatile double sink = 0;
        for (int batch = 0; batch < batches; ++batch) {
            const tracer::ThreadClock clock;
            double sum = 0;
            for (int i = 0; i < estimates; ++i) sum += estimator.estimate(f_, uniforms);
            sink = sum;
            least = std::min(least, clock.seconds() / estimates);
        }
        static_cast<void>(sink);
        return least;
    }

    F f_;
    std::array<bool, size> covers_;
    std::tuple<S...> strategies_;
    mutable std::optional<Costs> costs_;
};

}  // namespace convergence
