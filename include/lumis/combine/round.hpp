// One round of samples (every technique drawn as often as it is taken, or one technique selected and drawn once) as optimal
// weights see it: the balance heuristic's estimate and the techniques' densities, which serve as control variates.
#pragma once

#include "lumis/combine/detail/normal_equations.hpp"
#include "lumis/core/platform.hpp"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <type_traits>

namespace lumis::LUMIS_ISA {

namespace detail {

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

// A number, or a glm::vec of numbers: what is summed in doubles.
template <class Value>
concept SumsInDouble = requires {
    typename detail::DoubleOf<Value>::type;
};
template <SumsInDouble Value>
using InDouble = typename detail::DoubleOf<Value>::type;

// Wide is double or a glm::vec of doubles, K the number of techniques. The default is a round that drew nothing at all.
template <class Wide, std::size_t K>
struct Round {
    Wide balanced{};                   // sum over the samples of f / S: the balance heuristic's estimate
    std::array<double, K> controls{};  // sums of p_k / S, each 1 in expectation
    detail::NormalEquations<Wide, K> equations;

    // A sample: g = f / S and q_k = p_k / S.
    LUMIS_INLINE constexpr void add_sample(const Wide& g, const std::array<double, K>& q) noexcept {
        balanced += g;
        for (std::size_t k = 0; k < K; ++k) controls[k] += q[k];
        equations.add_sample(g, q);
    }

    // A sample of technique k where all other densities are 0, so that S is factor p_k. A draw that yielded nothing is one,
    // with g = 0: to draw nothing is a point that technique k has to itself.
    LUMIS_INLINE constexpr void add_alone(std::size_t k, double factor, const Wide& g) noexcept {
        const double q = 1 / factor;
        balanced += g;
        controls[k] += q;
        equations.a(k, k) += q * q;
        equations.b[k] += g * q;
    }

    // The estimate with weights alpha: unbiased if they do not depend on the round. All 0: the balance heuristic's.
    [[nodiscard]] LUMIS_HD constexpr Wide estimate(const std::array<Wide, K>& alpha) const noexcept {
        Wide result = balanced;
        for (std::size_t k = 0; k < K; ++k) result -= alpha[k] * (controls[k] - 1);
        return result;
    }
};

}  // namespace lumis::LUMIS_ISA
