// Several floating-point numbers that are worked on at once: a thin type over compiler vectors, which g++ and clang++
// turn into the machine's vector instructions from -O2 on, without flags of their own. Lanes<T, N> is a Real, and
// glm::vec<3, Lanes<T, N>> is N directions.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#ifndef __GNUC__
#error "lumis/batch is written in the vector extensions of g++ and clang++"
#endif

namespace lumis {

namespace detail {

template <class T, std::size_t N>
struct VectorOf {
    using type LUMIS_VECTOR(N * sizeof(T)) = T;
};

}  // namespace detail

// A truth for each lane: an integer with all of its bits set, or none.
template <std::signed_integral Bits, std::size_t N>
class LaneMask {
  public:
    using Vector = typename detail::VectorOf<Bits, N>::type;

    LaneMask() = default;
    LUMIS_INLINE LaneMask(bool everywhere) noexcept : v_{Vector{} - Bits{everywhere}} {}
    LUMIS_INLINE explicit LaneMask(Vector v) noexcept : v_{v} {}

    LUMIS_INLINE friend LaneMask operator&&(LaneMask a, LaneMask b) noexcept { return LaneMask{a.v_ & b.v_}; }
    LUMIS_INLINE friend LaneMask operator||(LaneMask a, LaneMask b) noexcept { return LaneMask{a.v_ | b.v_}; }
    LUMIS_INLINE friend LaneMask operator!(LaneMask a) noexcept { return LaneMask{~a.v_}; }

    // Whether it holds in every lane, and whether it holds in any.
    [[nodiscard]] LUMIS_INLINE bool all() const noexcept { return !(!*this).any(); }
    [[nodiscard]] LUMIS_INLINE bool any() const noexcept { return any_bit(v_); }
    [[nodiscard]] LUMIS_INLINE Vector vector() const noexcept { return v_; }

  private:
    // By the processor's instruction: g++ would take the vector apart by way of memory. Wider vectors are halved first.
    template <class V>
    LUMIS_INLINE static bool any_bit(V v) noexcept {
#if defined(__AVX__)
        constexpr std::size_t widest = 32;
        if constexpr (sizeof(V) == 32) {
            using Floats LUMIS_VECTOR(32) = float;
            return __builtin_ia32_movmskps256(reinterpret_cast<Floats>(v)) != 0;
        }
#else
        constexpr std::size_t widest = 16;
#endif
#if defined(__SSE2__)
        if constexpr (sizeof(V) == 16) {
            using Floats LUMIS_VECTOR(16) = float;
            return __builtin_ia32_movmskps(reinterpret_cast<Floats>(v)) != 0;
        }
#endif
        if constexpr (sizeof(V) > widest) {
            using Half LUMIS_VECTOR(sizeof(V) / 2) = Bits;
            Half halves[2];
            std::memcpy(halves, &v, sizeof(V));
            return any_bit(Half(halves[0] | halves[1]));
        } else {
            Bits some = v[0];
            for (std::size_t i = 1; i < sizeof(V) / sizeof(Bits); ++i) some |= v[i];
            return some != 0;
        }
    }

    Vector v_;
};

template <std::floating_point T, std::size_t N>
class Lanes {
    using Bits = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
    using BitVector = typename detail::VectorOf<Bits, N>::type;

  public:
    using Lane = T;
    using Vector = typename detail::VectorOf<T, N>::type;
    using Mask = LaneMask<Bits, N>;
    static constexpr std::size_t size = N;

    Lanes() = default;
    // x in every lane. (0 is taken off because it changes no x, -0 included.)
    LUMIS_INLINE Lanes(T x) noexcept : v_{x - Vector{}} {}
    LUMIS_INLINE explicit Lanes(Vector v) noexcept : v_{v} {}

    [[nodiscard]] LUMIS_INLINE static Lanes load(const T* from) noexcept {
        Lanes result;
        std::memcpy(&result.v_, from, sizeof(Vector));
        return result;
    }
    // f(0), f(1), ..., f(N - 1), each called with its index as a constant.
    template <class F>
    [[nodiscard]] LUMIS_INLINE static Lanes of_lanes(F f) noexcept {
        const auto all = [&]<std::size_t... I>(std::index_sequence<I...>) {
            return Vector{f(std::integral_constant<std::size_t, I>{})...};
        };
        return Lanes{all(std::make_index_sequence<N>{})};
    }

    LUMIS_INLINE void store(T* to) const noexcept { std::memcpy(to, &v_, sizeof(Vector)); }

    [[nodiscard]] LUMIS_INLINE Vector vector() const noexcept { return v_; }
    [[nodiscard]] LUMIS_INLINE T operator[](std::size_t i) const noexcept { return v_[i]; }
    LUMIS_INLINE void set(std::size_t i, T x) noexcept { v_[i] = x; }

    LUMIS_INLINE friend Lanes operator+(Lanes a, Lanes b) noexcept { return Lanes{a.v_ + b.v_}; }
    LUMIS_INLINE friend Lanes operator-(Lanes a, Lanes b) noexcept { return Lanes{a.v_ - b.v_}; }
    LUMIS_INLINE friend Lanes operator*(Lanes a, Lanes b) noexcept { return Lanes{a.v_ * b.v_}; }
    LUMIS_INLINE friend Lanes operator/(Lanes a, Lanes b) noexcept { return Lanes{a.v_ / b.v_}; }
    LUMIS_INLINE friend Lanes operator-(Lanes a) noexcept { return Lanes{-a.v_}; }
    LUMIS_INLINE Lanes& operator+=(Lanes b) noexcept { return *this = *this + b; }
    LUMIS_INLINE Lanes& operator-=(Lanes b) noexcept { return *this = *this - b; }
    LUMIS_INLINE Lanes& operator*=(Lanes b) noexcept { return *this = *this * b; }
    LUMIS_INLINE Lanes& operator/=(Lanes b) noexcept { return *this = *this / b; }

    LUMIS_INLINE friend Mask operator<(Lanes a, Lanes b) noexcept { return mask(a.v_ < b.v_); }
    LUMIS_INLINE friend Mask operator<=(Lanes a, Lanes b) noexcept { return mask(a.v_ <= b.v_); }
    LUMIS_INLINE friend Mask operator>(Lanes a, Lanes b) noexcept { return mask(a.v_ > b.v_); }
    LUMIS_INLINE friend Mask operator>=(Lanes a, Lanes b) noexcept { return mask(a.v_ >= b.v_); }
    LUMIS_INLINE friend Mask operator==(Lanes a, Lanes b) noexcept { return mask(a.v_ == b.v_); }

    LUMIS_INLINE friend Lanes sqrt(Lanes x) noexcept { return Lanes{square_roots(x.v_)}; }
    LUMIS_INLINE friend Lanes abs(Lanes x) noexcept { return of(bits(x) & ~sign_bit()); }
    LUMIS_INLINE friend Lanes copysign(Lanes magnitude, Lanes sign) noexcept {
        return of((bits(magnitude) & ~sign_bit()) | (bits(sign) & sign_bit()));
    }
    [[nodiscard]] LUMIS_INLINE static Lanes mul_add(Lanes a, Lanes b, Lanes c) noexcept {
        return Lanes{a.v_ * b.v_ + c.v_};
    }
    [[nodiscard]] LUMIS_INLINE static Lanes select(Mask condition, Lanes a, Lanes b) noexcept {
        return Lanes{condition.vector() ? a.v_ : b.v_};
    }

  private:
    LUMIS_INLINE static Mask mask(auto comparison) noexcept { return Mask{reinterpret_cast<BitVector>(comparison)}; }
    LUMIS_INLINE static BitVector bits(Lanes x) noexcept { return reinterpret_cast<BitVector>(x.v_); }
    LUMIS_INLINE static Lanes of(BitVector x) noexcept { return Lanes{reinterpret_cast<Vector>(x)}; }
    LUMIS_INLINE static BitVector sign_bit() noexcept { return BitVector{} + (std::numeric_limits<Bits>::min)(); }

    // By the processor's instructions. The compilers share no built-in function for roots of vectors, and neither makes one
    // instruction of a loop over std::sqrt, which may set errno.
    LUMIS_INLINE static Vector square_roots(Vector x) noexcept {
#ifdef __SSE2__
        if constexpr (std::same_as<T, float> && sizeof(Vector) == 16) return __builtin_ia32_sqrtps(x);
        if constexpr (std::same_as<T, double> && sizeof(Vector) == 16) return __builtin_ia32_sqrtpd(x);
#endif
#ifdef __AVX__
        if constexpr (std::same_as<T, float> && sizeof(Vector) == 32) return __builtin_ia32_sqrtps256(x);
        if constexpr (std::same_as<T, double> && sizeof(Vector) == 32) return __builtin_ia32_sqrtpd256(x);
#endif
        for (std::size_t i = 0; i < N; ++i) x[i] = std::sqrt(x[i]);
        return x;
    }

    Vector v_;
};

// As many lanes as the machine that is compiled for has in a vector, up to 32 bytes.
#ifdef __AVX__
inline constexpr std::size_t vector_bytes = 32;
#else
inline constexpr std::size_t vector_bytes = 16;
#endif

template <std::floating_point T>
using NativeLanes = Lanes<T, vector_bytes / sizeof(T)>;

}  // namespace lumis

// GLM asks whether its numbers are floating-point ones.
template <std::floating_point T, std::size_t N>
class std::numeric_limits<lumis::Lanes<T, N>> : public std::numeric_limits<T> {};
