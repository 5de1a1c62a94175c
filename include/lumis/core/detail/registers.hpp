// Compilers' vectors of at most a register, and what takes an instruction of the processor's own. Compilers share no built-in
// functions for these. Each is used only where the compiler says that it has it; vectors.hpp does without where not.
#pragma once

#include "lumis/core/platform.hpp"

#include <cstddef>

#ifdef LUMIS_HAS_VECTORS

namespace lumis::LUMIS_ISA::detail {

template <class T, std::size_t N>
struct RegisterOf {
    using type LUMIS_VECTOR(N * sizeof(T)) = T;
};

// The square roots of a whole register, by the processor's instruction: neither g++ nor clang++ makes one of a loop over
// std::sqrt, which may set errno.
#if LUMIS_HAS_BUILTIN(__builtin_elementwise_sqrt)
template <class V>
[[nodiscard]] LUMIS_INLINE inline V register_sqrt(V x) noexcept {
    return __builtin_elementwise_sqrt(x);
}
#else
template <class V>
void register_sqrt(V) = delete;
#if defined(__SSE2__) && LUMIS_HAS_BUILTIN(__builtin_ia32_sqrtps)
LUMIS_INLINE inline RegisterOf<float, 4>::type register_sqrt(RegisterOf<float, 4>::type x) noexcept {
    return __builtin_ia32_sqrtps(x);
}
LUMIS_INLINE inline RegisterOf<double, 2>::type register_sqrt(RegisterOf<double, 2>::type x) noexcept {
    return __builtin_ia32_sqrtpd(x);
}
#endif
#if defined(__AVX__) && LUMIS_HAS_BUILTIN(__builtin_ia32_sqrtps256)
LUMIS_INLINE inline RegisterOf<float, 8>::type register_sqrt(RegisterOf<float, 8>::type x) noexcept {
    return __builtin_ia32_sqrtps256(x);
}
LUMIS_INLINE inline RegisterOf<double, 4>::type register_sqrt(RegisterOf<double, 4>::type x) noexcept {
    return __builtin_ia32_sqrtpd256(x);
}
#endif
#if defined(__AVX512F__) && LUMIS_HAS_BUILTIN(__builtin_ia32_sqrtps512)
#ifdef __clang__
#define LUMIS_ROUNDING , 4  // the current mode
#else
#define LUMIS_ROUNDING
#endif
LUMIS_INLINE inline RegisterOf<float, 16>::type register_sqrt(RegisterOf<float, 16>::type x) noexcept {
    return __builtin_ia32_sqrtps512(x LUMIS_ROUNDING);
}
LUMIS_INLINE inline RegisterOf<double, 8>::type register_sqrt(RegisterOf<double, 8>::type x) noexcept {
    return __builtin_ia32_sqrtpd512(x LUMIS_ROUNDING);
}
#undef LUMIS_ROUNDING
#endif
#if LUMIS_HAS_BUILTIN(__builtin_aarch64_sqrtv4sf)
LUMIS_INLINE inline RegisterOf<float, 4>::type register_sqrt(RegisterOf<float, 4>::type x) noexcept {
    return __builtin_aarch64_sqrtv4sf(x);
}
LUMIS_INLINE inline RegisterOf<double, 2>::type register_sqrt(RegisterOf<double, 2>::type x) noexcept {
    return __builtin_aarch64_sqrtv2df(x);
}
#endif
#endif

// Whether any bit is set, in a vector of floats that stands for a mask: g++ would take a mask apart by way of memory.
template <class V>
void any_sign(V) = delete;
#if defined(__SSE2__) && LUMIS_HAS_BUILTIN(__builtin_ia32_movmskps)
LUMIS_INLINE inline bool any_sign(RegisterOf<float, 4>::type x) noexcept {
    return __builtin_ia32_movmskps(x) != 0;
}
#endif
#if defined(__AVX__) && LUMIS_HAS_BUILTIN(__builtin_ia32_movmskps256)
LUMIS_INLINE inline bool any_sign(RegisterOf<float, 8>::type x) noexcept {
    return __builtin_ia32_movmskps256(x) != 0;
}
#endif
#if defined(__AVX512DQ__) && LUMIS_HAS_BUILTIN(__builtin_ia32_cvtd2mask512)
LUMIS_INLINE inline bool any_sign(RegisterOf<float, 16>::type x) noexcept {
    return __builtin_ia32_cvtd2mask512(reinterpret_cast<RegisterOf<int, 16>::type>(x)) != 0;
}
#endif

}  // namespace lumis::LUMIS_ISA::detail

#endif
