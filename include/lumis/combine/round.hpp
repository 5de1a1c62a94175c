// One round of samples, every technique drawn as often as it is taken (or one technique selected and drawn once), and what
// optimal weights need to know of it.
#pragma once

#include "lumis/combine/detail/normal_equations.hpp"
#include "lumis/core/platform.hpp"

#include <glm/vec2.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace lumis::LUMIS_ISA {

namespace detail {

// What values are summed in: a double for a number, a glm::vec of doubles for a vector of numbers.
template <class Value>
struct DoubleOf {};
template <class Value>
    requires std::is_arithmetic_v<Value>
struct DoubleOf<Value> : std::type_identity<double> {
};
template <int N, class T, glm::qualifier Q>
    requires std::is_arithmetic_v<T>
struct DoubleOf<glm::vec<N, T, Q>> : std::type_identity<glm::vec<N, double, Q>> {
};

}  // namespace detail

template <class Value>
concept SumsInDouble = requires {
    typename detail::DoubleOf<Value>::type;
};

template <SumsInDouble Value>
using InDouble = typename detail::DoubleOf<Value>::type;

// The weights alpha of K control variates, the techniques' densities: an alpha for each component of a value.
template <SumsInDouble Value, std::size_t K>
using ControlWeights = std::array<InDouble<Value>, K>;

template <SumsInDouble Value, std::size_t K>
struct Round {
    InDouble<Value> balanced{};        // sum over the samples of f / S: the balance heuristic's estimate
    std::array<double, K> controls{};  // sums of p_k / S, each 1 in expectation
    detail::NormalEquations<InDouble<Value>, K> equations;

    // The estimate with these weights: unbiased if they do not depend on the round. All zeros: the balance heuristic's.
    [[nodiscard]] LUMIS_HD constexpr InDouble<Value> estimate(const ControlWeights<Value, K>& alpha) const noexcept {
        InDouble<Value> result = balanced;
        for (std::size_t k = 0; k < K; ++k) result -= alpha[k] * (controls[k] - 1);
        return result;
    }

    LUMIS_INLINE constexpr void add_sample(const InDouble<Value>& g, const std::array<double, K>& q) noexcept {
        balanced += g;
        for (std::size_t k = 0; k < K; ++k) controls[k] += q[k];
        equations.add_sample(g, q);
    }

    // A sample of technique k where all other densities are 0, so that S is factor p_k.
    LUMIS_INLINE constexpr void add_alone(std::size_t k, double factor, const InDouble<Value>& g) noexcept {
        const double q = 1 / factor;
        balanced += g;
        controls[k] += q;
        equations.a(k, k) += q * q;
        equations.b[k] += g * q;
    }
};

}  // namespace lumis::LUMIS_ISA
