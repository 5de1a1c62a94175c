// The zero of what is summed: the result of an estimate that has drawn nothing.
#pragma once

#include "lumis/core/platform.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

// zero<T>::value() is the zero of T. It is known for every T that the language sets to zeros in T(), one whose default
// constructor is trivial: numbers, Lanes, structs of such without default member initialisers. It is known for a glm::vec and
// a std::array of what has a zero. Any other type says what its zero is, for its default constructor may set nothing:
//
//   template <>
//   struct lumis::zero<Spectrum> {
//       static Spectrum value() { return Spectrum{0.0f}; }
//   };
//
// and a class template by a partial specialisation:
//
//   template <class T, int N>
//   struct lumis::zero<Color<T, N>> {
//       static Color<T, N> value() { return Color<T, N>::constant(T(0)); }
//   };
//
// Neither has to be constexpr. Code for CUDA devices marks them __host__ __device__.
template <class T>
struct zero {
    // At compile time: a call, even one that is inlined, would have g++ lay out the code around it in another way.
    [[nodiscard]] LUMIS_HD static consteval T value() noexcept requires std::is_trivially_default_constructible_v<T> {
        return T();
    }
};

template <class T>
concept HasZero = requires {
    { zero<T>::value() } -> std::same_as<T>;
};

// GLM's constructor is trivial or, by GLM_FORCE_CTOR_INIT and of other numbers than the language's, is not.
template <int N, HasZero T, glm::qualifier Q>
    requires(!std::is_trivially_default_constructible_v<glm::vec<N, T, Q>>)
struct zero<glm::vec<N, T, Q>> {
    [[nodiscard]] LUMIS_HD static constexpr glm::vec<N, T, Q> value() { return glm::vec<N, T, Q>(zero<T>::value()); }
};

template <HasZero T, std::size_t N>
    requires(!std::is_trivially_default_constructible_v<std::array<T, N>>)
struct zero<std::array<T, N>> {
    [[nodiscard]] LUMIS_HD static constexpr std::array<T, N> value() {
        const auto all = []<std::size_t... I>(std::index_sequence<I...>) {
            return std::array<T, N>{(static_cast<void>(I), zero<T>::value())...};
        };
        return all(std::make_index_sequence<N>{});
    }
};

}  // namespace lumis::LUMIS_ISA
