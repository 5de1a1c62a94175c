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
#include <type_traits>
#include <utility>
#include <vector>

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

// Each sum is that of `count` estimates by the counts that a pilot advises. The pilot is made anew for each, and is not averaged
// in. What samples and densities cost is measured in the first call, which no study counts.
template <class F, class... S>
class AllocatedSamples {
    static constexpr std::size_t size = sizeof...(S);

  public:
    // covers: which technique draws all points where the integrand is not 0.
    AllocatedSamples(const F& f, const std::array<bool, size>& covers, const S&... strategies)
        : f_{f}, covers_{covers}, strategies_{strategies...} {}

    void operator()(std::span<double> sums, std::int64_t count, auto& uniforms) const {
        if (!costs_) costs_ = measured_costs(std::index_sequence_for<S...>{}, uniforms);
        for (double& sum : sums) {
            const auto counts = advised(pilot_rounds(count), uniforms);
            sum = 0;
            take(counts, std::index_sequence_for<S...>{}, [&](const auto& estimator) {
                for (std::int64_t i = 0; i < count; ++i) sum += estimator.estimate(f_, uniforms);
            });
        }
    }

  private:
    using Costs = lumis::SamplingCosts<size>;

    [[nodiscard]] static std::int64_t pilot_rounds(std::int64_t count) { return std::max<std::int64_t>(4, count / 16); }

    [[nodiscard]] std::array<int, size> advised(std::int64_t rounds, auto& uniforms) const {
        auto plan = std::apply(
            [](const auto&... s) { return lumis::allocate(lumis::BalanceHeuristic{}, lumis::take(1, s)...); },
            strategies_);
        for (std::int64_t i = 0; i < rounds; ++i) (void)plan.add(f_, uniforms);
        return plan.counts(*costs_, {.covers = covers_});
    }

    template <std::size_t... I>
    void take(const std::array<int, size>& counts, std::index_sequence<I...>, const auto& use) const {
        use(multi_sample(lumis::BalanceHeuristic{}, lumis::take(counts[I], std::get<I>(strategies_))...));
    }

    template <std::size_t... I>
    [[nodiscard]] Costs measured_costs(std::index_sequence<I...>, auto& uniforms) const {
        Costs costs;
        ((costs.of_sample[I] = cost_of_sample<I>(uniforms), costs.of_density[I] = cost_of_density<I>(uniforms)), ...);
        return costs;
    }

    // Seconds of CPU time that work() takes, over so many calls that the clock tells.
    [[nodiscard]] static double seconds_of(const auto& work) {
        for (std::int64_t calls = 1;; calls *= 2) {
            const tracer::ThreadClock clock;
            for (std::int64_t i = 0; i < calls; ++i) work();
            if (const double seconds = clock.seconds(); seconds >= 2e-4) return seconds / static_cast<double>(calls);
        }
    }

    template <std::size_t I>
    [[nodiscard]] double cost_of_sample(auto& uniforms) const {
        const auto alone = multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, std::get<I>(strategies_)));
        volatile double sink = 0;
        return seconds_of([&] { sink = sink + alone.estimate(f_, uniforms); });
    }

    // Of technique I's density at points that the next technique draws.
    template <std::size_t I>
    [[nodiscard]] double cost_of_density(auto& uniforms) const {
        const auto& other = std::get<(I + 1) % size>(strategies_);
        using Other = std::remove_cvref_t<decltype(other)>;
        using Point = typename Other::Point;
        std::vector<Point> points;
        while (points.size() < 256) {
            const auto drawn = other.sample(uniforms.template next<Other::dimensions>());
            if (drawn.pdf > 0) points.push_back(drawn.value);
        }
        volatile double sink = 0;
        const double seconds = seconds_of([&] {
            double sum = 0;
            for (const Point& point : points) sum += std::get<I>(strategies_).pdf(point);
            sink = sum;
        });
        return seconds / static_cast<double>(points.size());
    }

    F f_;
    std::array<bool, size> covers_;
    std::tuple<S...> strategies_;
    mutable std::optional<Costs> costs_;
};

}  // namespace convergence
