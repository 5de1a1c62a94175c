// Laws of means that may stop as soon as they know, of estimates with a known bound: unbiased, and agreement of two estimators.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/statistics/running_moments.hpp"
#include "lumis/testing/evidence.hpp"
#include "lumis/testing/result.hpp"
#include "lumis/testing/sequential.hpp"
#include "lumis/testing/unbiased.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

namespace lumis::LUMIS_ISA::testing {

// Estimates that lie in [low, high], every component of a colour: Bounded{0, 2, estimate}. Only their author can know that. A
// promise about means needs it: without a bound, what has not been drawn yet may be as large as it likes.
template <class Estimate>
struct Bounded {
    double low, high;
    Estimate estimate;

    decltype(auto) operator()() { return estimate(); }
};
template <class Estimate>
Bounded(double, double, Estimate) -> Bounded<Estimate>;

namespace detail {

template <class T>
inline constexpr bool is_bounded = false;
template <class Estimate>
inline constexpr bool is_bounded<Bounded<Estimate>> = true;

template <class Estimate>
using ChannelsOf = Channels<std::remove_cvref_t<std::invoke_result_t<Estimate&>>>;

// How far rounding may move a number of that size among an estimate's components.
template <class Estimate>
[[nodiscard]] double rounding_of_estimate(double number) noexcept {
    return rounding_of<typename ChannelsOf<Estimate>::Scalar>(number);
}

// What means are, if all is right: of numbers in [low, high], give or take `slack`, within `errors` of the answers.
template <std::size_t N>
struct Means {
    double low, high, slack;
    std::array<double, N> answers, errors;
};

// draw(): the next numbers.
template <std::size_t N, class Draw>
[[nodiscard]] SequentialResult means_are(const Means<N>& means, const Sequential& options, const Draw& draw) {
    SequentialResult result;
    result.decided = false;
    result.message = text("no bets can be laid on numbers from ", means.low, " to ", means.high);
    if (!(means.low < means.high && std::isfinite(means.high - means.low))) return result;

    std::vector<MeanEvidence> evidence;
    std::array<RunningMoments<double>, N> moments;
    for (std::size_t i = 0; i < N; ++i) {
        const double answer = means.answers[i], error = means.errors[i];
        result.message = text("no numbers from ", means.low, " to ", means.high, " have the mean ", answer);
        if (!(answer + error >= means.low && answer - error <= means.high)) return result;
        evidence.emplace_back(means.low, means.high, answer, error);
    }
    std::string wrong;
    bool finite = true;
    const auto take = [&] {
        const std::array<double, N> numbers = draw();
        for (std::size_t i = 0; i < N; ++i) {
            finite = finite && std::isfinite(numbers[i]);
            if (!(numbers[i] >= means.low - means.slack && numbers[i] <= means.high + means.slack)) {
                wrong = text("drew ", numbers[i], finite ? ", which is beyond the bound: from " : ", not from ",
                             means.low, " to ", means.high);
                return false;
            }
            evidence[i].add((std::min)((std::max)(numbers[i], means.low), means.high));
            moments[i].add(numbers[i]);
        }
        return true;
    };
    std::vector<double> logs(N);
    const auto log_evidence = [&] {
        for (std::size_t i = 0; i < N; ++i) logs[i] = evidence[i].log();
        return log_mean(logs);
    };
    result = watched(options, take, log_evidence);
    if (!wrong.empty()) {
        result.number = finite ? 1 : 0;
        result.decided = !finite;  // a bound that does not hold leaves nothing to promise
        result.message = wrong;
        return result;
    }
    for (std::size_t i = 0; i < N; ++i) {
        if (N > 1) result.message += text("; component ", static_cast<double>(i));
        result.message +=
            text("; mean ", moments[i].mean(), " +- ", moments[i].standard_error(), ", answer ", means.answers[i]);
    }
    return result;
}

template <class Estimate, std::size_t N = ChannelsOf<Estimate>::number>
[[nodiscard]] std::array<double, N> numbers_of(Estimate& estimate) {
    const auto value = estimate();
    std::array<double, N> numbers;
    for (std::size_t i = 0; i < N; ++i) numbers[i] = ChannelsOf<Estimate>::get(value, static_cast<int>(i));
    return numbers;
}

}  // namespace detail

// The law unbiased, looked at after every few estimates. answer_error: as in UnbiasedOptions. Undecided if an estimate lies
// beyond its bound.
template <class Estimate, class Answer, std::same_as<Sequential> Options>
[[nodiscard]] SequentialResult unbiased(Bounded<Estimate> estimate, const Answer& answer, const Options& options,
                                        double answer_error = 0) {
    constexpr std::size_t components = detail::ChannelsOf<Estimate>::number;
    static_assert(detail::Channels<Answer>::number == components, "the answer has as many components as an estimate");
    const double largest = (std::max)(std::abs(estimate.low), std::abs(estimate.high));
    detail::Means<components> means{
        estimate.low, estimate.high, detail::rounding_of_estimate<Estimate>(largest), {}, {}};
    for (std::size_t i = 0; i < components; ++i) {
        means.answers[i] = detail::Channels<Answer>::get(answer, static_cast<int>(i));
        means.errors[i] = answer_error + detail::rounding_of_estimate<Estimate>(means.answers[i]);
    }
    return detail::means_are(means, options, [&] { return detail::numbers_of(estimate.estimate); });
}

// The law that two estimators agree, looked at after every few pairs of estimates. Undecided if one lies beyond its bound.
template <class First, class Second, std::same_as<Sequential> Options>
[[nodiscard]] SequentialResult agreement(Bounded<First> first, Bounded<Second> second, const Options& options) {
    constexpr std::size_t components = detail::ChannelsOf<First>::number;
    static_assert(detail::ChannelsOf<Second>::number == components, "both estimates have as many components");
    const double low = first.low - second.high, high = first.high - second.low;
    detail::Means<components> means{low, high, 0, {}, {}};
    const double largest = (std::max)(std::abs(low), std::abs(high));
    means.slack =
        (std::max)(detail::rounding_of_estimate<First>(largest), detail::rounding_of_estimate<Second>(largest));
    means.errors.fill(means.slack);
    return detail::means_are(means, options, [&] {
        auto numbers = detail::numbers_of(first.estimate);
        const auto others = detail::numbers_of(second.estimate);
        for (std::size_t i = 0; i < components; ++i) numbers[i] -= others[i];
        return numbers;
    });
}

// No bound, no promise: say Bounded{low, high, estimate}, or leave Sequential for UnbiasedOptions.
template <class Estimate, class Answer, std::same_as<Sequential> Options>
    requires(!detail::is_bounded<std::remove_cvref_t<Estimate>>)
void unbiased(Estimate&&, const Answer&, const Options&, double = 0) = delete;
template <class First, class Second, std::same_as<Sequential> Options>
    requires(!(detail::is_bounded<std::remove_cvref_t<First>> && detail::is_bounded<std::remove_cvref_t<Second>>))
void agreement(First&&, Second&&, const Options&) = delete;

}  // namespace lumis::LUMIS_ISA::testing
