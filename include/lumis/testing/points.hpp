// What the laws need to know of a strategy's points: directions, points of [0,1]^d or of space, and indices.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <type_traits>

namespace lumis::LUMIS_ISA::testing {

namespace detail {

template <class Point>
struct Widened : std::type_identity<Point> {};
template <std::floating_point T>
struct Widened<T> : std::type_identity<double> {};
template <int N, std::floating_point T, glm::qualifier Q>
struct Widened<glm::vec<N, T, Q>> : std::type_identity<glm::vec<N, double>> {};

}  // namespace detail

// The same points in double, in which the laws do their arithmetic; indices stay what they are.
template <class Point>
using InDouble = typename detail::Widened<Point>::type;

namespace detail {

template <std::integral T>
[[nodiscard]] bool is_finite(T) noexcept {
    return true;
}
template <std::floating_point T>
[[nodiscard]] bool is_finite(T x) noexcept {
    return std::isfinite(x);
}
template <int N, class T, glm::qualifier Q>
[[nodiscard]] bool is_finite(const glm::vec<N, T, Q>& v) noexcept {
    for (int i = 0; i < N; ++i) {
        if (!std::isfinite(v[i])) return false;
    }
    return true;
}

// How far two points lie apart; indices: 0 if they are the same, else 1.
template <class Point>
[[nodiscard]] double distance(const Point& a, const Point& b) noexcept {
    if constexpr (std::integral<Point>) {
        return a == b ? 0 : 1;
    } else if constexpr (std::floating_point<Point>) {
        return std::abs(double{a} - double{b});
    } else {
        return glm::length(InDouble<Point>{a} - InDouble<Point>{b});
    }
}

}  // namespace detail

}  // namespace lumis::LUMIS_ISA::testing
