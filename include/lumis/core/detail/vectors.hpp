// What lanes are stored in: VectorOf<T, N>::type is N numbers that are worked on at once, a compiler's vector where a register
// holds them and an Array elsewhere. Comparisons set all bits of an integer as wide as T, or none. What the operators do
// not reach is a function here; each takes a vector, an array or one of an array's parts.
#pragma once

#include "lumis/core/detail/array.hpp"
#include "lumis/core/detail/registers.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA::detail {

template <class T, std::size_t N>
struct VectorOf {
    using type = Array<T, N>;
};
#ifdef LUMIS_HAS_VECTORS
template <class T, std::size_t N>
    requires(N * sizeof(T) <= LUMIS_VECTOR_BYTES)
struct VectorOf<T, N> {
    using type = typename RegisterOf<T, N>::type;
};
#endif

template <class V>
concept IsArray = std::is_class_v<V>;

// x in every lane.
template <class V, class T>
[[nodiscard]] LUMIS_INLINE inline V everywhere(T x) noexcept {
    if constexpr (std::same_as<V, T>) {
        return x;
    } else if constexpr (IsArray<V>) {
        return V::each([x] { return everywhere<Register<T>>(x); });
    } else {
        return x - V{};  // 0 is taken off because it changes no x, -0 included
    }
}

// x, y and so on, one in each lane.
template <class V, class... T>
[[nodiscard]] LUMIS_INLINE inline V of_numbers(T... x) noexcept {
    if constexpr (IsArray<V>) {
        const std::common_type_t<T...> numbers[] = {x...};
        V result;
        std::memcpy(&result, numbers, sizeof result);
        return result;
    } else {
        return V{x...};
    }
}

template <class V, class T>
LUMIS_INLINE inline void set_lane(V& v, std::size_t i, T x) noexcept {
    if constexpr (std::same_as<V, T>) {
        v = x;
    } else if constexpr (IsArray<V>) {
        set_lane(v.parts[i / lanes_of_part<T>], i % lanes_of_part<T>, x);
    } else {
        v[i] = x;
    }
}

// The same bits, read as another vector's.
template <class To, class From>
[[nodiscard]] LUMIS_INLINE inline To bits_as(const From& v) noexcept {
    static_assert(sizeof(To) == sizeof(From));
    if constexpr (IsArray<From> || std::is_arithmetic_v<From>) {
        To result;
        std::memcpy(&result, &v, sizeof result);
        return result;
    } else {
        return reinterpret_cast<To>(v);
    }
}

// a where the mask is set, else b.
template <class M, class V>
[[nodiscard]] LUMIS_INLINE inline V choose(const M& mask, const V& a, const V& b) noexcept {
    if constexpr (IsArray<V>) {
        return V::each([](auto m, auto x, auto y) { return choose(m, x, y); }, mask, a, b);
    } else {
        return mask ? a : b;
    }
}

template <class V>
[[nodiscard]] LUMIS_INLINE inline V square_roots(V x) noexcept {
    if constexpr (std::floating_point<V>) {
        return real::sqrt(x);
    } else if constexpr (IsArray<V>) {
        return V::each([](auto part) { return square_roots(part); }, x);
    } else if constexpr (requires { register_sqrt(x); }) {
        return register_sqrt(x);
    } else {
        for (std::size_t i = 0; i < sizeof x / sizeof x[0]; ++i) x[i] = std::sqrt(x[i]);
        return x;
    }
}

// Lanes that the compiler is to know nothing more of, see real.hpp.
template <class V>
[[nodiscard]] LUMIS_INLINE inline V opaque_lanes(const V& x) noexcept {
    if constexpr (IsArray<V>) {
        return V::each([](auto part) { return opaque(part); }, x);
    } else {
        return opaque(x);
    }
}

// A barrier against re-association, see real.hpp.
template <class V>
[[nodiscard]] LUMIS_INLINE inline V rounded_lanes(const V& x) noexcept {
    if constexpr (IsArray<V>) {
        return V::each([](auto part) { return rounded(part); }, x);
    } else {
        return rounded(x);
    }
}

// N numbers as those of another type, rounded.
template <class To, class From, std::size_t N>
[[nodiscard]] LUMIS_INLINE inline auto converted_lanes(const typename VectorOf<From, N>::type& x) noexcept {
    using Result = typename VectorOf<To, N>::type;
#ifdef LUMIS_HAS_VECTORS
    if constexpr (!IsArray<Result> && !IsArray<std::remove_cvref_t<decltype(x)>>) {
        return __builtin_convertvector(x, Result);
    } else {
        typename VectorOf<From, N / 2>::type from[2];
        std::memcpy(from, &x, sizeof from);
        const typename VectorOf<To, N / 2>::type to[] = {converted_lanes<To, From, N / 2>(from[0]),
                                                         converted_lanes<To, From, N / 2>(from[1])};
#if LUMIS_HAS_BUILTIN(__builtin_shufflevector)
        if constexpr (!IsArray<Result>) {  // not by way of memory
            const auto joined = [&]<std::size_t... I>(std::index_sequence<I...>) {
                return __builtin_shufflevector(to[0], to[1], static_cast<int>(I)...);
            };
            return joined(std::make_index_sequence<N>{});
        }
#endif
        Result result;
        std::memcpy(&result, to, sizeof result);
        return result;
    }
#else
    return Result::each([](From number) { return static_cast<To>(number); }, x);
#endif
}

// Whether a mask, the bits of which are integers, is set in any lane.
template <class V>
[[nodiscard]] LUMIS_INLINE inline bool any_set(const V& mask) noexcept {
    if constexpr (IsArray<V>) {
        auto some = mask.parts[0];
        for (std::size_t i = 1; i < V::size; ++i) some |= mask.parts[i];
        return any_set(some);
    } else if constexpr (std::integral<V>) {
        return mask != 0;
    } else {
#ifdef LUMIS_HAS_VECTORS
        using Floats = typename RegisterOf<float, sizeof(V) / sizeof(float)>::type;
        if constexpr (requires(Floats x) { any_sign(x); }) return any_sign(reinterpret_cast<Floats>(mask));
#endif
        auto some = mask[0];
        for (std::size_t i = 1; i < sizeof mask / sizeof mask[0]; ++i) some |= mask[i];
        return some != 0;
    }
}

}  // namespace lumis::LUMIS_ISA::detail
