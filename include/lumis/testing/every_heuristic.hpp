// The law that multiple importance sampling is unbiased, whatever weighs its techniques: every heuristic, in both models,
// with several counts and selection probabilities.
#pragma once

#include "lumis/combine/heuristics.hpp"
#include "lumis/combine/multi_sample.hpp"
#include "lumis/combine/one_sample.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/testing/result.hpp"
#include "lumis/testing/unbiased.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace lumis::LUMIS_ISA::testing {

// Calls visit(heuristic, name) for all that weigh by densities.
template <class Visit>
void for_each_heuristic(Visit visit) {
    visit(BalanceHeuristic{}, "balance");
    visit(PowerHeuristic{}, "power 2");
    visit(PowerHeuristic{1.5}, "power 1.5");
    visit(MaximumHeuristic{}, "maximum");
    visit(CutoffHeuristic{}, "cutoff");
    visit(EqualWeights{}, "equal");
}

inline constexpr std::size_t number_of_heuristics = 6;

struct HeuristicsOptions {
    std::int64_t samples = 100'000;  // of every estimator
    Significance significance{};     // its family: how many such laws are asked; their estimators are counted in
    double answer_error = 0;         // of the answer itself, absolute
    std::uint64_t seed = 1;
};

namespace detail {

template <std::size_t N, class T>
[[nodiscard]] std::string list(const std::array<T, N>& numbers) {
    std::string result = "(";
    for (std::size_t i = 0; i < N; ++i) result += (i > 0 ? ", " : "") + text(numbers[i]);
    return result + ')';
}

// The largest magnitude among the components of a number or colour.
template <class Answer>
[[nodiscard]] double magnitude(const Answer& answer) {
    double largest = 0;
    for (int channel = 0; channel < Channels<Answer>::number; ++channel) {
        largest = std::fmax(largest, std::abs(Channels<Answer>::get(answer, channel)));
    }
    return largest;
}

// Keeps the worst of many tests.
template <class Answer>
class WorstOfFamily {
  public:
    WorstOfFamily(const Answer& answer, const HeuristicsOptions& options, std::size_t tests)
        : answer_{answer}, options_{options}, tests_{tests} {
        result_.passed = true;
        result_.number = 1;
    }

    template <class Scalar, class Estimate>
    void test(const std::string& name, const Estimate& estimate) {
        // An estimator without variance is off by its rounding.
        const double rounding = 16 * double{std::numeric_limits<Scalar>::epsilon()} * magnitude(answer_);
        UnbiasedOptions options{options_.samples, options_.significance, std::fmax(options_.answer_error, rounding)};
        options.significance.family *= tests_;
        Uniforms<std::mt19937_64, Scalar> uniforms{std::mt19937_64{options_.seed++}};
        const auto law = unbiased([&] { return estimate(uniforms); }, answer_, options);
        if (result_.message.empty() || (result_.passed && !law.passed) || law.number < result_.number) {
            result_.number = law.number;
            result_.message = name + ": " + law.message;
        }
        result_.passed = result_.passed && law.passed;
        result_.relative_standard_error = std::fmax(result_.relative_standard_error, law.relative_standard_error);
        if (!(law.smallest_bias_seen <= result_.smallest_bias_seen)) {
            result_.smallest_bias_seen = law.smallest_bias_seen;
        }
    }

    [[nodiscard]] UnbiasedResult result() const { return result_; }

  private:
    Answer answer_;
    HeuristicsOptions options_;
    std::size_t tests_;
    UnbiasedResult result_{};
};

}  // namespace detail

// For an estimator of one's own: estimate(heuristic, uniforms) yields independent estimates. number: the smallest
// p-value; smallest_bias_seen: the largest over all heuristics.
template <std::floating_point Scalar, class Estimate, class Answer>
[[nodiscard]] UnbiasedResult unbiased_under_every_heuristic(const Estimate& estimate, const Answer& answer,
                                                            const HeuristicsOptions& options = {}) {
    detail::WorstOfFamily worst{answer, options, number_of_heuristics};
    for_each_heuristic([&](const auto& heuristic, const char* name) {
        worst.template test<Scalar>(name, [&](auto& uniforms) { return estimate(heuristic, uniforms); });
    });
    return worst.result();
}

// What techniques are combined with: a list of sample counts for the multi-sample model and one of selection
// probabilities for the other. A factor of 0 leaves its technique out, and the others must cover the integrand.
template <std::size_t N>
struct Factors {
    std::vector<std::array<int, N>> counts;
    std::vector<std::array<double, N>> probabilities;
};

// For two techniques, and for two of which the first alone need not cover the integrand.
inline const Factors<2> factors_of_two{{{1, 1}, {1, 3}, {3, 1}, {0, 1}, {3, 0}},
                                       {{0.5, 0.5}, {0.2, 0.8}, {0, 1}, {1, 0}}};
inline const Factors<2> factors_of_two_with_second{{{1, 1}, {1, 3}, {3, 1}, {0, 1}}, {{0.5, 0.5}, {0.2, 0.8}, {0, 1}}};

// f is integrated by multi_sample and one_sample over strategies, and called as by them. BalanceWithFactors is tested as well,
// with the factors 1, 2, ... of the strategies.
template <class F, class Answer, class First, class... Rest>
    requires Composable<First, Rest...>
[[nodiscard]] UnbiasedResult unbiased_under_every_heuristic(const F& f, const Answer& answer,
                                                            const Factors<1 + sizeof...(Rest)>& factors,
                                                            const HeuristicsOptions& options, const First& first,
                                                            const Rest&... rest) {
    using Scalar = typename First::Scalar;
    const std::size_t tests = (number_of_heuristics + 1) * (factors.counts.size() + factors.probabilities.size());
    detail::WorstOfFamily worst{answer, options, tests};
    const auto run = [&]<std::size_t... I>(std::index_sequence<I...>) {
        const auto test_both_models = [&](const auto& heuristic, const char* name) {
            const auto test = [&](const std::string& factor, const auto& estimator) {
                worst.template test<Scalar>(name + factor,
                                            [&](auto& uniforms) { return estimator.estimate(f, uniforms); });
            };
            const auto strategies = std::tie(first, rest...);
            for (const auto& n : factors.counts) {
                test(", counts " + detail::list(n), multi_sample(heuristic, take(n[I], std::get<I>(strategies))...));
            }
            for (const auto& c : factors.probabilities) {
                test(", probabilities " + detail::list(c),
                     one_sample(heuristic, choose(c[I], std::get<I>(strategies))...));
            }
        };
        for_each_heuristic(test_both_models);
        test_both_models(BalanceWithFactors{static_cast<double>(I + 1)...}, "balance with factors");
    };
    run(std::index_sequence_for<First, Rest...>{});
    return worst.result();
}

}  // namespace lumis::LUMIS_ISA::testing
