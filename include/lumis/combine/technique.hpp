// A technique is a strategy with its sample count (multi-sample model) or its selection probability (one-sample model).
#pragma once

#include "lumis/combine/held.hpp"
#include "lumis/core/strategy.hpp"

#include <concepts>
#include <type_traits>
#include <utility>

namespace lumis {

// S may be a reference, see Held.
template <class S>
struct Take {
    int count;
    S strategy;
};

template <class S>
struct Choose {
    typename std::remove_cvref_t<S>::Scalar probability;
    S strategy;
};

// `count` samples of a strategy; 0 leaves it out.
template <class S>
    requires Strategy<std::remove_cvref_t<S>>
[[nodiscard]] constexpr auto take(int count, S&& strategy) {
    return Take<Held<S>>{count, std::forward<S>(strategy)};
}

// A strategy that is selected with a probability in [0, 1]; 0 leaves it out. Where the probabilities of a combination
// sum to less than 1, the rest draws nothing.
template <class S>
    requires Strategy<std::remove_cvref_t<S>>
[[nodiscard]] constexpr auto choose(std::convertible_to<double> auto probability, S&& strategy) {
    using Scalar = typename std::remove_cvref_t<S>::Scalar;
    return Choose<Held<S>>{static_cast<Scalar>(probability), std::forward<S>(strategy)};
}

// std::reference_wrapper of a strategy, without the header that defines it.
template <class W>
concept StrategyReference = requires(const W wrapper) {
    requires Strategy<std::remove_const_t<typename W::type>>;
    { wrapper.get() } -> std::same_as<typename W::type&>;
};

// std::cref(strategy) makes either hold a reference, which spares the copy: a third of the cost of an estimate where a
// large strategy is used once. The strategy must then outlive the combination.
template <StrategyReference W>
[[nodiscard]] constexpr auto take(int count, W wrapper) {
    return Take<const typename W::type&>{count, wrapper.get()};
}
template <StrategyReference W>
[[nodiscard]] constexpr auto choose(std::convertible_to<double> auto probability, W wrapper) {
    return Choose<const typename W::type&>{static_cast<typename W::type::Scalar>(probability), wrapper.get()};
}

// What must agree before strategies can be combined. A compiler names the one that fails.
template <class S, class First>
concept SameScalar = std::same_as<typename S::Scalar, typename First::Scalar>;
template <class S, class First>
concept SamePoint = std::same_as<typename S::Point, typename First::Point>;
template <class S, class First>
concept SameMeasure = std::same_as<typename S::Measure, typename First::Measure>;

template <class S, class First>
concept ComposableWith = SameScalar<S, First> && SamePoint<S, First> && SameMeasure<S, First>;

// Each may be a reference, see Held.
template <class First, class... Rest>
concept Composable = (ComposableWith<std::remove_cvref_t<Rest>, std::remove_cvref_t<First>> && ...);

}  // namespace lumis
