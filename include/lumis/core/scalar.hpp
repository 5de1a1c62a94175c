// The floating-point types that kernels are made for.
#pragma once

#include <concepts>

namespace lumis {

// long double is refused: lattices of uniforms, polynomials and tolerances are those of 24 and of 53 bits.
template <class T>
concept FloatOrDouble = std::same_as<T, float> || std::same_as<T, double>;

}  // namespace lumis
