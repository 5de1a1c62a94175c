// The arithmetic that kernels are written in. A kernel is written once, for a Real: a floating-point type for the single
// call, or several lanes of one (see core/lanes.hpp). Where lanes may differ, a kernel selects instead of branching.
//
// A kernel keeps two rules, so that a host may trap floating-point exceptions and may compile with -ffast-math:
// 1. It never divides 0 by 0, a number by 0, or takes the root of a negative number, not even to discard the result.
//    Divisions are divide or quotient_where, divisors that may be 0 are divisor_where, and roots that rounding can make
//    negative are sqrt_or_zero.
// 2. A difference or sum whose rounding matters is rounded(a - b). Otherwise -fassociative-math may rewrite it together
//    with what it enters, and the digits that the difference was formed to keep are lost.
//
// Constructors and sample functions of strategies are forced inline (LUMIS_INLINE). Otherwise compilers pass vectors
// through memory: they are stored by component and loaded whole, and such a load waits until all stores before it are
// done (no store forwarding).
#pragma once

// -ffinite-math-only, which -ffast-math implies, lets a compiler assume that no NaN or infinity occurs.
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ && !defined(LUMIS_ALLOW_FINITE_MATH_ONLY)
#pragma GCC warning \
    "Lumis cannot detect NaN and infinity under -ffinite-math-only (-ffast-math): add -fno-finite-math-only, or define LUMIS_ALLOW_FINITE_MATH_ONLY to accept that"
#endif

#include "lumis/core/platform.hpp"
#include "lumis/core/scalar.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <concepts>
#include <type_traits>

namespace lumis::LUMIS_ISA {

namespace detail {

template <class R>
struct ScalarOf {};
template <FloatOrDouble T>
struct ScalarOf<T> {
    using type = T;
};
template <class R>
    requires requires {
        typename R::Lane;
    }
struct ScalarOf<R> {
    using type = typename R::Lane;
};

// x, of which the compiler is to know nothing more. A number, or a compiler's vector no larger than a register.
template <class V>
[[nodiscard]] LUMIS_INLINE constexpr V opaque(V x) noexcept {
    if (!std::is_constant_evaluated()) {
#if defined(__CUDA_ARCH__) || !(defined(__GNUC__) || defined(__clang__))
        // The device traps nothing; MSVC has no such statement.
#elif defined(__AVX512F__)
        asm("" : "+v"(x));
#elif defined(__SSE2__)
        asm("" : "+x"(x));
#elif defined(__aarch64__)
        asm("" : "+w"(x));
#else
        asm("" : "+m"(x));
#endif
    }
    return x;
}

// A barrier against re-association, for a number or a compiler vector of them. Both compilers' built-in functions are
// nothing without -fassociative-math, but g++'s keeps multiplications and additions from being fused all the same, and takes
// vectors apart: it is left out where the flags make arithmetic IEEE 754's, and for registers.
template <class V>
[[nodiscard]] LUMIS_INLINE constexpr V rounded(V x) noexcept {
#if defined(__CUDA_ARCH__)
    // The device re-associates nothing.
#elif defined(LUMIS_HAS_FENCE)
    if (!std::is_constant_evaluated()) return __arithmetic_fence(x);
#elif defined(__clang__) && (defined(__FAST_MATH__) || __FINITE_MATH_ONLY__)
    if constexpr (sizeof(V) <= LUMIS_VECTOR_BYTES) return opaque(x);
#elif defined(__GNUC__) && __GNUC__ >= 12 && __GCC_IEC_559 == 0
    if constexpr (!std::is_arithmetic_v<V> && sizeof(V) >= 16 && sizeof(V) <= LUMIS_VECTOR_BYTES) return opaque(x);
    if (!std::is_constant_evaluated()) return __builtin_assoc_barrier(x);
#endif
    return x;
}

}  // namespace detail

// The floating-point type that R is, or is made of lanes of.
template <class R>
using scalar_of = typename detail::ScalarOf<R>::type;

// A T or, where T is a number, lanes of it: what the kernel of a strategy with parameters T takes.
template <class R, class T>
concept RealOf = Real<R> &&(std::same_as<R, T> || std::same_as<scalar_of<R>, T>);

// What a comparison of two R yields: bool, or one for each lane.
template <Real R>
using MaskOf = decltype(R{} < R{});

namespace real {

// The square root by the processor's instruction. std::sqrt compares its argument first, and calls a function that sets
// errno if it is negative. g++ has only a built-in function that takes a vector, which costs as much without AVX.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline R sqrt(R x) noexcept {
#if defined(__clang__) && defined(__SSE2__) && !defined(__CUDACC__) && __FINITE_MATH_ONLY__
    // clang++ would estimate the root of a float (rsqrtss), which costs up to two units in the last place.
    if constexpr (std::same_as<R, float>) {
#ifdef __AVX__
        asm("vsqrtss %0, %0, %0" : "+x"(x));
#else
        asm("sqrtss %0, %0" : "+x"(x));
#endif
        return x;
    }
#endif
#if LUMIS_HAS_BUILTIN(__builtin_elementwise_sqrt) && !defined(__CUDACC__)
    if constexpr (std::floating_point<R>) return __builtin_elementwise_sqrt(x);
#elif defined(__AVX__) && defined(LUMIS_HAS_VECTORS) && LUMIS_HAS_BUILTIN(__builtin_ia32_sqrtss)
    if constexpr (std::same_as<R, float>) {
        using Vector LUMIS_VECTOR(16) = float;
        return __builtin_ia32_sqrtss(Vector{x})[0];
    } else if constexpr (std::same_as<R, double>) {
        using Vector LUMIS_VECTOR(16) = double;
        return __builtin_ia32_sqrtsd(Vector{x})[0];
    }
#endif
    using std::sqrt;
    return sqrt(x);
}

template <Real R>
[[nodiscard]] LUMIS_INLINE inline R length(const glm::vec<3, R>& v) noexcept {
    return sqrt(R(v.x * v.x + v.y * v.y + v.z * v.z));
}

// x as rounded, fl(x) in Higham's notation: no expression that uses it is re-associated with the one that formed it.
// Does nothing unless the compiler has leave to re-associate (-fassociative-math, which -ffast-math implies).
// g++ < 12 has no such barrier.
template <Real R>
[[nodiscard]] LUMIS_INLINE constexpr R rounded(R x) noexcept {
    if constexpr (std::floating_point<R>) {
        return detail::rounded(x);
    } else {
        return R::rounded(x);
    }
}
template <Real R>
[[nodiscard]] LUMIS_INLINE constexpr glm::vec<2, R> rounded(const glm::vec<2, R>& v) noexcept {
    return {rounded(v.x), rounded(v.y)};
}
template <Real R>
[[nodiscard]] LUMIS_INLINE constexpr glm::vec<3, R> rounded(const glm::vec<3, R>& v) noexcept {
    return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

// a b as rounded, whatever it is added to. Where the machine can, compilers fuse one of two products into their difference:
// that of equal products is then what rounding took from the other, and not 0.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline R product(R a, std::type_identity_t<R> b) noexcept {
#ifdef __CUDA_ARCH__
    if constexpr (std::same_as<R, float>) return __fmul_rn(a, b);
    if constexpr (std::same_as<R, double>) return __dmul_rn(a, b);
#endif
    if constexpr (std::floating_point<R>) {
        return detail::opaque(a * b);
    } else {
        return R::opaque(a * b);
    }
}

// The dot product, summed in the order of its terms whatever the flags are: x and y first, which are the small ones where
// both vectors are near +z.
template <Real R>
[[nodiscard]] LUMIS_INLINE constexpr R dot(const glm::vec<3, R>& a, const glm::vec<3, R>& b) noexcept {
    return rounded(R(a.x * b.x + a.y * b.y)) + a.z * b.z;
}

template <Real R>
[[nodiscard]] LUMIS_HD constexpr R abs(R x) noexcept {
    if constexpr (std::floating_point<R>) {
        if (std::is_constant_evaluated()) return x < 0 ? -x : x;  // std::abs is not for constants before C++23
    }
    using std::abs;
    return abs(x);
}

template <Real R>
[[nodiscard]] LUMIS_HD R copysign(R magnitude, R sign) noexcept {
    using std::copysign;
    return copysign(magnitude, sign);
}

// a b + c in one expression, which a compiler may fuse.
template <Real R>
[[nodiscard]] LUMIS_HD constexpr R mul_add(R a, std::type_identity_t<R> b, std::type_identity_t<R> c) noexcept {
    if constexpr (std::floating_point<R>) {
        return a * b + c;
    } else {
        return R::mul_add(a, b, c);
    }
}

// a where the condition holds, else b.
template <Real R>
[[nodiscard]] LUMIS_HD constexpr R select(const MaskOf<R>& condition, R a, std::type_identity_t<R> b) noexcept {
    if constexpr (std::floating_point<R>) {
        return condition ? a : b;
    } else {
        return R::select(condition, a, b);
    }
}

template <Real R>
[[nodiscard]] LUMIS_HD constexpr glm::vec<3, R> select(const MaskOf<R>& condition, const glm::vec<3, R>& a,
                                                       const glm::vec<3, R>& b) noexcept {
    return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}

// a / b. clang++ would gather several divisions of numbers into one of a vector, unused lanes of which divide 0 by 0 and
// so raise FE_INVALID.
template <Real R>
[[nodiscard]] LUMIS_INLINE constexpr R divide(R a, std::type_identity_t<R> b) noexcept {
#ifdef __clang__
    if constexpr (std::floating_point<R>) return detail::opaque(a / detail::opaque(b));
#endif
    return a / b;
}
template <Real R>
[[nodiscard]] LUMIS_INLINE constexpr glm::vec<2, R> divide(const glm::vec<2, R>& a,
                                                           std::type_identity_t<R> b) noexcept {
    return {divide(a.x, b), divide(a.y, b)};
}
template <Real R>
[[nodiscard]] LUMIS_INLINE constexpr glm::vec<3, R> divide(const glm::vec<3, R>& a,
                                                           std::type_identity_t<R> b) noexcept {
    return {divide(a.x, b), divide(a.y, b), divide(a.z, b)};
}

// x where the condition holds, else 1: a divisor that raises no floating-point exception where x would.
// Compilers turn a / select(condition, x, 1) into select(condition, a / x, a), which divides by x after all; a number is
// hidden from them, so that they cannot.
template <Real R>
[[nodiscard]] LUMIS_INLINE constexpr R divisor_where(const MaskOf<R>& condition, R x) noexcept {
    if constexpr (std::floating_point<R>) {
        return detail::opaque(condition ? x : R(1));
    } else {
        return R::select(condition, x, R(scalar_of<R>(1)));
    }
}

// a / b where the condition holds, else 0: for a number without a floating-point exception, if a is finite.
template <Real R>
[[nodiscard]] LUMIS_INLINE constexpr R quotient_where(const MaskOf<R>& condition, R a,
                                                      std::type_identity_t<R> b) noexcept {
    if constexpr (std::floating_point<R>) {
        return condition ? divide(a, divisor_where(condition, b)) : R(0);
    } else {
        return R::select(condition, a / b, R(scalar_of<R>(0)));
    }
}

// sqrt(x), and 0 for a negative x, without a floating-point exception.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline R sqrt_or_zero(R x) noexcept {
    if constexpr (std::floating_point<R>) {
        return sqrt(detail::opaque(x > 0 ? x : R(0)));
    } else {
        return sqrt(select(x > 0, x, 0));
    }
}

// a() where the condition holds, else b(); a number asks for just one of them.
template <class Condition, class A, class B>
[[nodiscard]] LUMIS_HD constexpr auto either(const Condition& condition, A a, B b) noexcept {
    if constexpr (std::same_as<Condition, bool>) {
        return condition ? a() : b();
    } else {
        return select(condition, a(), b());
    }
}

// As std::min and std::max: a NaN in b yields a.
template <Real R>
[[nodiscard]] LUMIS_HD constexpr R lesser(R a, std::type_identity_t<R> b) noexcept {
    return select(b < a, b, a);
}
template <Real R>
[[nodiscard]] LUMIS_HD constexpr R greater(R a, std::type_identity_t<R> b) noexcept {
    return select(a < b, b, a);
}

template <Real R>
[[nodiscard]] LUMIS_HD constexpr R clamp(R x, std::type_identity_t<R> low, std::type_identity_t<R> high) noexcept {
    return greater(lesser(x, high), low);
}

// The largest of a range of numbers, of which there is at least one.
[[nodiscard]] LUMIS_HD constexpr auto largest_of(const auto& numbers) noexcept {
    auto largest = *numbers.begin();
    for (const auto number : numbers) largest = largest < number ? number : largest;
    return largest;
}

// Whether a condition holds in every lane.
[[nodiscard]] LUMIS_HD constexpr bool all(bool condition) noexcept {
    return condition;
}
template <class Mask>
[[nodiscard]] LUMIS_HD constexpr bool all(const Mask& condition) noexcept {
    return condition.all();
}

// Whether it holds in any.
[[nodiscard]] LUMIS_HD constexpr bool any(bool condition) noexcept {
    return condition;
}
template <class Mask>
[[nodiscard]] LUMIS_HD constexpr bool any(const Mask& condition) noexcept {
    return condition.any();
}

}  // namespace real

}  // namespace lumis::LUMIS_ISA
