// What resampling makes of techniques: how many candidates there are, what is kept of each, and what integrands are asked.
#pragma once

#include "lumis/combine/detail/nearest.hpp"
#include "lumis/combine/detail/select_item.hpp"
#include "lumis/combine/integrand.hpp"
#include "lumis/combine/zero.hpp"
#include "lumis/core/detail/for_each_index.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/surface_point.hpp"

#include <glm/vec3.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace lumis::LUMIS_ISA::detail {

// A technique is no target: else the one before it would be taken for a heuristic.
template <class Target>
concept MayBeTarget = !requires(const Target target) {
    target.strategy;
};

// A concept: of a function that takes any point, it is not asked whether it takes a sample.
template <class F, class Drawn, std::size_t I>
concept TakesDrawn = Takes<F, decltype(Drawn::value), false, I> || Takes<F, Drawn, false, I>;

// How many candidates there are: from every technique its count, or as many of techniques that are selected one by one.
template <class Scalar, std::size_t N>
struct TakenCandidates {
    std::array<int, N> counts;

    [[nodiscard]] LUMIS_HD constexpr std::array<Scalar, N> factors() const noexcept {
        std::array<Scalar, N> result{};
        for_each_index<N>([&](auto i) { result[i] = Scalar(static_cast<scalar_of<Scalar>>(counts[i])); });
        return result;
    }
};
template <class Scalar, std::size_t N>
struct ChosenCandidates {
    int count;
    std::array<Scalar, N> probabilities;

    // How many candidates each technique may expect.
    [[nodiscard]] LUMIS_HD constexpr std::array<Scalar, N> factors() const noexcept {
        std::array<Scalar, N> result = probabilities;
        for (Scalar& factor : result) factor *= Scalar(static_cast<scalar_of<Scalar>>(count));
        return result;
    }
};

// A candidate, and what its f is multiplied or, if the only technique drew it, divided by in an estimate that takes all of them.
template <class Drawn, Real R>
struct Candidate {
    Drawn sample{};
    R scale{};
};
template <class Mask, class Drawn, class R>
[[nodiscard]] LUMIS_HD Candidate<Drawn, R> select(const Mask& condition, const Candidate<Drawn, R>& a,
                                                  const Candidate<Drawn, R>& b) noexcept {
    return {select_item(condition, a.sample, b.sample), real::select(condition, a.scale, b.scale)};
}

// The sample that several techniques have in common: that of each, if these are of one type.
template <class Several, class First, class... Rest>
struct CommonSample : std::conditional<(std::same_as<First, Rest> && ...), First, Several> {};

template <class Common, class Drawn>
[[nodiscard]] LUMIS_INLINE inline decltype(auto) as_common(const Drawn& drawn) noexcept {
    if constexpr (std::same_as<Common, Drawn>) {
        return (drawn);
    } else {
        Common result{};
        result.value = drawn.value;
        result.pdf = drawn.pdf;
        if constexpr (HasDistance<Common>) result.distance = drawn.distance;
        if constexpr (HasSurface<Common>) result.surface = drawn.surface;
        return result;
    }
}

// Whether an integrand's value is 0, as far as its type can be compared.
template <class Value>
[[nodiscard]] LUMIS_HD bool is_zero(const Value& value) {
    if constexpr (requires { real::all(value == zero<Value>::value()); }) {
        return real::all(value == zero<Value>::value());
    } else {
        return true;
    }
}
template <int N, class R, glm::qualifier Q>
[[nodiscard]] LUMIS_HD bool is_zero(const glm::vec<N, R, Q>& value) {
    bool result = true;
    for (int i = 0; i < N; ++i) result = result && is_zero(value[i]);
    return result;
}

}  // namespace lumis::LUMIS_ISA::detail
