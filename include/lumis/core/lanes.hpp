// Several floating-point numbers that are worked on at once: a thin type over compiler vectors, which g++ and clang++
// turn into the machine's vector instructions from -O2 on, without flags of their own. Lanes<T, N> is a Real, and
// glm::vec<3, Lanes<T, N>> is N directions. N is a power of two. More lanes than a register has are several registers; a
// compiler without vectors works number by number.
#pragma once

#include "lumis/core/detail/vectors.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

// A truth for each lane: an integer with all of its bits set, or none.
template <std::signed_integral Bits, std::size_t N>
class LaneMask {
  public:
    using Vector = typename detail::VectorOf<Bits, N>::type;

    LaneMask() = default;
    LUMIS_INLINE LaneMask(bool everywhere) noexcept
        : v_{detail::everywhere<Vector>(static_cast<Bits>(-Bits{everywhere}))} {}
    LUMIS_INLINE explicit LaneMask(Vector v) noexcept : v_{v} {}

    LUMIS_INLINE friend LaneMask operator&&(LaneMask a, LaneMask b) noexcept { return LaneMask{a.v_ & b.v_}; }
    LUMIS_INLINE friend LaneMask operator||(LaneMask a, LaneMask b) noexcept { return LaneMask{a.v_ | b.v_}; }
    LUMIS_INLINE friend LaneMask operator!(LaneMask a) noexcept { return LaneMask{~a.v_}; }

    // Whether it holds in every lane, and whether it holds in any.
    [[nodiscard]] LUMIS_INLINE bool all() const noexcept { return !(!*this).any(); }
    [[nodiscard]] LUMIS_INLINE bool any() const noexcept { return detail::any_set(v_); }
    [[nodiscard]] LUMIS_INLINE bool operator[](std::size_t i) const noexcept { return v_[i] != 0; }
    [[nodiscard]] LUMIS_INLINE Vector vector() const noexcept { return v_; }

  private:
    Vector v_;
};

template <std::floating_point T, std::size_t N>
class Lanes {
    using Bits = detail::BitsOf<T>;
    using BitVector = typename detail::VectorOf<Bits, N>::type;

  public:
    using Lane = T;
    template <std::floating_point U>
    using Of = Lanes<U, N>;  // as many lanes, of another type
    using Vector = typename detail::VectorOf<T, N>::type;
    using Mask = LaneMask<Bits, N>;
    static constexpr std::size_t size = N;

    Lanes() = default;
    // x in every lane.
    LUMIS_INLINE Lanes(T x) noexcept : v_{detail::everywhere<Vector>(x)} {}
    LUMIS_INLINE explicit Lanes(Vector v) noexcept : v_{v} {}
    // The numbers of x, rounded to T.
    template <std::floating_point U>
        requires(!std::same_as<U, T>)
    LUMIS_INLINE explicit Lanes(Lanes<U, N> x) noexcept : v_{detail::converted_lanes<T, U, N>(x.vector())} {}

    [[nodiscard]] LUMIS_INLINE static Lanes load(const T* from) noexcept {
        Lanes result;
        std::memcpy(&result.v_, from, sizeof(Vector));
        return result;
    }
    // f(0), f(1), ..., f(N - 1), each called with its index as a constant.
    template <class F>
    [[nodiscard]] LUMIS_INLINE static Lanes of_lanes(F f) noexcept {
        const auto all = [&]<std::size_t... I>(std::index_sequence<I...>) {
            return detail::of_numbers<Vector>(f(std::integral_constant<std::size_t, I>{})...);
        };
        return Lanes{all(std::make_index_sequence<N>{})};
    }

    LUMIS_INLINE void store(T* to) const noexcept { std::memcpy(to, &v_, sizeof(Vector)); }

    [[nodiscard]] LUMIS_INLINE Vector vector() const noexcept { return v_; }
    [[nodiscard]] LUMIS_INLINE T operator[](std::size_t i) const noexcept { return v_[i]; }
    LUMIS_INLINE void set(std::size_t i, T x) noexcept { detail::set_lane(v_, i, x); }

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

    LUMIS_INLINE friend Lanes sqrt(Lanes x) noexcept { return Lanes{detail::square_roots(x.v_)}; }
    LUMIS_INLINE friend Lanes abs(Lanes x) noexcept { return of(bits(x) & ~sign_bit()); }
    LUMIS_INLINE friend Lanes copysign(Lanes magnitude, Lanes sign) noexcept {
        return of((bits(magnitude) & ~sign_bit()) | (bits(sign) & sign_bit()));
    }
    [[nodiscard]] LUMIS_INLINE static Lanes opaque(Lanes x) noexcept { return Lanes{detail::opaque_lanes(x.v_)}; }
    [[nodiscard]] LUMIS_INLINE static Lanes rounded(Lanes x) noexcept { return Lanes{detail::rounded_lanes(x.v_)}; }
    [[nodiscard]] LUMIS_INLINE static Lanes mul_add(Lanes a, Lanes b, Lanes c) noexcept {
        return Lanes{a.v_ * b.v_ + c.v_};
    }
    [[nodiscard]] LUMIS_INLINE static Lanes select(Mask condition, Lanes a, Lanes b) noexcept {
        return Lanes{detail::choose(condition.vector(), a.v_, b.v_)};
    }

  private:
    LUMIS_INLINE static Mask mask(auto comparison) noexcept { return Mask{detail::bits_as<BitVector>(comparison)}; }
    LUMIS_INLINE static BitVector bits(Lanes x) noexcept { return detail::bits_as<BitVector>(x.v_); }
    LUMIS_INLINE static Lanes of(BitVector x) noexcept { return Lanes{detail::bits_as<Vector>(x)}; }
    LUMIS_INLINE static BitVector sign_bit() noexcept {
        return detail::everywhere<BitVector>((std::numeric_limits<Bits>::min)());
    }

    Vector v_;
};

// As many lanes as the machine that is compiled for has in a vector; one where the compiler has no vectors, for arrays of
// several cost more than so many single calls.
template <std::floating_point T>
#ifdef LUMIS_HAS_VECTORS
using NativeLanes = Lanes<T, LUMIS_VECTOR_BYTES / sizeof(T)>;
#else
using NativeLanes = Lanes<T, 1>;
#endif

}  // namespace lumis::LUMIS_ISA

// GLM asks whether its numbers are floating-point ones.
template <std::floating_point T, std::size_t N>
class std::numeric_limits<lumis::Lanes<T, N>> : public std::numeric_limits<T> {};
