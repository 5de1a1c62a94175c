// The inline namespace that every name of Lumis stands in. Files of a program that are compiled for different processors, or
// with flags that change what is computed, have functions of the same name that are not the same: without that namespace a
// linker keeps one of them for all, and a processor that lacks its instructions ends the program. See docs/platforms.md.
#pragma once

// LUMIS_ISA_NAME is put together from what tells apart the code that a compiler makes of one source: instructions that not every
// processor has, and flags that change what is computed. A host may name it itself.
#ifndef LUMIS_ISA_NAME

#if defined(__AVX512VBMI__) || defined(__AVX512IFMA__)
#define LUMIS_ISA_VECTORS avx512vbmi
#elif defined(__AVX512VL__) && defined(__AVX512DQ__) && defined(__AVX512BW__)
#define LUMIS_ISA_VECTORS avx512
#elif defined(__AVX512F__)
#define LUMIS_ISA_VECTORS avx512f
#elif defined(__AVX2__)
#define LUMIS_ISA_VECTORS avx2
#elif defined(__AVX__)
#define LUMIS_ISA_VECTORS avx
#elif defined(__SSE4_2__)
#define LUMIS_ISA_VECTORS sse42
#elif defined(__SSE4_1__)
#define LUMIS_ISA_VECTORS sse41
#elif defined(__SSE3__)
#define LUMIS_ISA_VECTORS sse3
#elif defined(__SSE2__) || defined(_M_X64)
#define LUMIS_ISA_VECTORS sse2
#elif defined(__ARM_FEATURE_SVE2)
#define LUMIS_ISA_VECTORS sve2
#elif defined(__ARM_FEATURE_SVE)
#define LUMIS_ISA_VECTORS sve
#elif defined(__ARM_NEON) || defined(_M_ARM64)
#define LUMIS_ISA_VECTORS neon
#elif defined(__wasm_relaxed_simd__)
#define LUMIS_ISA_VECTORS relaxed_simd
#elif defined(__wasm_simd128__)
#define LUMIS_ISA_VECTORS simd128
#elif defined(__VSX__)
#define LUMIS_ISA_VECTORS vsx
#elif defined(__riscv_vector)
#define LUMIS_ISA_VECTORS rvv
#else
#define LUMIS_ISA_VECTORS plain
#endif

#if defined(__FMA4__)
#define LUMIS_ISA_SUMS _fma4
#elif defined(__FMA__) || defined(__ARM_FEATURE_FMA)
#define LUMIS_ISA_SUMS _fma
#else
#define LUMIS_ISA_SUMS
#endif

#if defined(__BMI__) || defined(__BMI2__) || defined(__LZCNT__)
#define LUMIS_ISA_BITS _bmi
#elif defined(__POPCNT__)
#define LUMIS_ISA_BITS _popcnt
#else
#define LUMIS_ISA_BITS
#endif

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#define LUMIS_ISA_MATHS _fast
#else
#define LUMIS_ISA_MATHS
#endif

#ifdef LUMIS_NO_VECTORS
#define LUMIS_ISA_LANES _numbers
#else
#define LUMIS_ISA_LANES
#endif

#if defined(__CUDACC__)
#define LUMIS_ISA_NAME cuda
#else
#define LUMIS_JOIN_EXPANDED(a, b, c, d, e) a##b##c##d##e
#define LUMIS_JOIN(a, b, c, d, e) LUMIS_JOIN_EXPANDED(a, b, c, d, e)
#define LUMIS_ISA_NAME LUMIS_JOIN(LUMIS_ISA_VECTORS, LUMIS_ISA_SUMS, LUMIS_ISA_BITS, LUMIS_ISA_MATHS, LUMIS_ISA_LANES)
#endif

#endif
#define LUMIS_ISA inline LUMIS_ISA_NAME
