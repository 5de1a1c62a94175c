// A technique is a strategy with its sample count (multi-sample model) or its selection probability (one-sample model).
#pragma once

#include "lumis/core/assert.hpp"
#include "lumis/core/detail/held.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/strategy.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

// Tells an integrand which technique drew its point: an index, as a constant.
template <std::size_t I>
struct technique : std::integral_constant<std::size_t, I> {};

// std::reference_wrapper of a strategy, without the header that defines it.
template <class W>
concept StrategyReference = requires(const W wrapper) {
    requires Strategy<std::remove_const_t<typename W::type>>;
    { wrapper.get() } -> std::same_as<typename W::type&>;
};

namespace detail {

// A count of samples as an int, which counts any number of them that will ever be taken.
template <std::integral Count>
[[nodiscard]] LUMIS_HD constexpr int checked_count(Count count) noexcept {
    LUMIS_ASSERT(count >= 0 && std::in_range<int>(count));
    return static_cast<int>(count);
}

}  // namespace detail

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

// `count` samples of a strategy, 0 or more; 0 leaves it out. A strategy that owns memory is kept by reference, see Held,
// and so is that in std::cref(strategy). The latter spares a copy: a third of the cost of an estimate where a large
// strategy is used once. Either must outlive the technique and what it is combined to.
template <std::integral Count, class S>
    requires Strategy<std::remove_cvref_t<S>>
[[nodiscard]] LUMIS_HD constexpr auto take(Count count, S&& strategy) {
    return Take<detail::Held<S>>{detail::checked_count(count), std::forward<S>(strategy)};
}
template <std::integral Count, class S>
    requires Strategy<S> && detail::HeldByReference<S&>
[[nodiscard]] LUMIS_HD constexpr auto take(Count count, S& strategy LUMIS_LIFETIME_BOUND) {
    return Take<detail::Held<S&>>{detail::checked_count(count), strategy};
}
template <std::integral Count, StrategyReference W>
[[nodiscard]] LUMIS_HD constexpr auto take(Count count, W wrapper) {
    return Take<const typename W::type&>{detail::checked_count(count), wrapper.get()};
}

namespace detail {

// A number, or lanes where the strategy is made of such: each then has its own.
template <class P, class S>
concept ProbabilityOf = std::convertible_to<P, double> || std::convertible_to<P, typename S::Scalar>;

template <class S, class P>
[[nodiscard]] LUMIS_HD constexpr typename S::Scalar probability_of(const P& probability) {
    using Scalar = typename S::Scalar;
    if constexpr (std::convertible_to<P, double>) {
        return Scalar(static_cast<scalar_of<Scalar>>(probability));
    } else {
        return probability;
    }
}

}  // namespace detail

// A strategy that is selected with a probability in [0, 1]; 0 leaves it out. Where the probabilities of a combination
// sum to less than 1, the rest draws nothing; they may not sum to more. Kept as by take.
template <class P, class S>
    requires Strategy<std::remove_cvref_t<S>> && detail::ProbabilityOf<P, std::remove_cvref_t<S>>
[[nodiscard]] LUMIS_HD constexpr auto choose(P probability, S&& strategy) {
    return Choose<detail::Held<S>>{detail::probability_of<std::remove_cvref_t<S>>(probability),
                                   std::forward<S>(strategy)};
}
template <class P, class S>
    requires Strategy<S> && detail::ProbabilityOf<P, S> && detail::HeldByReference<S&>
[[nodiscard]] LUMIS_HD constexpr auto choose(P probability, S& strategy LUMIS_LIFETIME_BOUND) {
    return Choose<detail::Held<S&>>{detail::probability_of<S>(probability), strategy};
}
template <class P, StrategyReference W>
    requires detail::ProbabilityOf<P, std::remove_const_t<typename W::type>>
[[nodiscard]] LUMIS_HD constexpr auto choose(P probability, W wrapper) {
    return Choose<const typename W::type&>{detail::probability_of<typename W::type>(probability), wrapper.get()};
}

namespace detail {

// Probabilities by which one can select, from what a caller gave. They are asserted to be those already. Else a negative
// one and a NaN count as 0, and what is beyond a sum of 1 is cut off, so that each is selected as often as its density says.
template <Real R, std::size_t N>
[[nodiscard]] LUMIS_HD constexpr std::array<R, N> selectable(std::array<R, N> probabilities) noexcept {
    using T = scalar_of<R>;
    constexpr T one =
        1 + static_cast<T>(N) * std::numeric_limits<T>::epsilon();  // those of ten equal parts sum to 1 + epsilon
    R sum = T(0);
    for (R& probability : probabilities) {
        LUMIS_ASSERT(real::all(probability >= 0));
        probability = real::select(probability >= 0, probability, T(0));
        LUMIS_ASSERT(real::all(sum + probability <= one));
        if (!real::all(sum + probability <= one))
            probability = real::select(sum + probability <= one, probability, real::greater(R(1 - sum), T(0)));
        sum += probability;
    }
    return probabilities;
}

}  // namespace detail

// What must agree before strategies can be combined. A compiler names the one that fails.
template <class S, class First>
concept SameScalar = std::same_as<typename S::Scalar, typename First::Scalar>;
template <class S, class First>
concept SamePoint = std::same_as<typename S::Point, typename First::Point>;
template <class S, class First>
concept SameMeasure = std::same_as<typename S::Measure, typename First::Measure>;

// Each may be a reference, see Held.
template <class First, class... Rest>
concept SameScalars = (SameScalar<std::remove_cvref_t<Rest>, std::remove_cvref_t<First>> && ...);
template <class First, class... Rest>
concept SamePoints = (SamePoint<std::remove_cvref_t<Rest>, std::remove_cvref_t<First>> && ...);
template <class First, class... Rest>
concept SameMeasures = (SameMeasure<std::remove_cvref_t<Rest>, std::remove_cvref_t<First>> && ...);

template <class First, class... Rest>
concept Composable = SameScalars<First, Rest...> && SamePoints<First, Rest...> && SameMeasures<First, Rest...>;

}  // namespace lumis::LUMIS_ISA
