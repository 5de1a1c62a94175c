// The numbers that kernels are made for, and their parameters.
#pragma once

#include "lumis/core/platform.hpp"

#include <concepts>
#include <cstdint>
#include <type_traits>

namespace lumis::LUMIS_ISA {

// long double is refused: lattices of uniforms, polynomials and tolerances are those of 24 and of 53 bits.
template <class T>
concept FloatOrDouble = std::same_as<T, float> || std::same_as<T, double>;

// What kernels are written for: a number, or lanes of numbers (see real.hpp and lanes.hpp).
template <class R>
concept Real = FloatOrDouble<R> || requires {
    typename R::Lane;
};

namespace detail {

// The signed integer of T's size.
template <class T>
using BitsOf = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;

}  // namespace detail

}  // namespace lumis::LUMIS_ISA
