// What differs among compilers and machines is said here, and nowhere else.
//
//   LUMIS_HD               in front of a function that is compiled for CUDA devices as well as for the host. The next three
//                          contain it
//   LUMIS_INLINE           part of its caller, whatever a compiler thinks of its size; a call in builds that are not optimised,
//                          which compile faster so
//   LUMIS_NOINLINE         a call, so that what is rare does not crowd what is frequent
//   LUMIS_COLD             the same, and rarely run
//   LUMIS_HAS_BUILTIN(f)   whether the compiler has the built-in function f
//   LUMIS_VECTOR(bytes)    in an alias of a number's type: a vector of them; only where LUMIS_HAS_VECTORS is defined. A host
//                          that defines LUMIS_NO_VECTORS does without
//   LUMIS_HAS_FENCE        whether __arithmetic_fence can be called
//   LUMIS_VECTOR_BYTES     how large the machine's registers for vectors are
//   LUMIS_HAS_EXCEPTIONS   defined unless exceptions are off (-fno-exceptions), see core/throw.hpp
//   LUMIS_ISA              the inline namespace of all that Lumis defines, as in `namespace lumis::LUMIS_ISA {`: code for different
//                          machines has different names, so that a program may hold both (docs/platforms.md)
//   LUMIS_LIFETIME_BOUND   behind a parameter that a result refers to: clang++ warns where the result outlives it
#pragma once

#include "lumis/core/detail/isa.hpp"  // LUMIS_ISA

#if defined(_MSVC_LANG) ? _MSVC_LANG < 202002L : __cplusplus < 202002L
#error "Lumis is written in C++20: compile with -std=c++20 (g++, clang++, nvcc) or /std:c++20 (MSVC)"
#include "Lumis needs C++20"  // no such file: otherwise a thousand errors follow, for only this one ends a compilation
#endif

// x87 keeps more digits than the type has, when it likes: what is written and what is computed with then differ.
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ == 2 && !defined(LUMIS_ALLOW_X87)
#error \
    "Lumis computes in float and double as they are: add -msse2 -mfpmath=sse (32-bit x86), or define LUMIS_ALLOW_X87 to accept the x87's digits"
#endif

#ifdef __CUDACC__
#define LUMIS_HD __host__ __device__
#else
#define LUMIS_HD
#endif

#if defined(__GNUC__) || defined(__clang__)
#if defined(__OPTIMIZE__) || defined(__CUDACC__)
#define LUMIS_INLINE [[gnu::always_inline]] LUMIS_HD
#else
#define LUMIS_INLINE LUMIS_HD
#endif
#define LUMIS_NOINLINE [[gnu::noinline]] LUMIS_HD
#define LUMIS_COLD [[gnu::noinline, gnu::cold]] LUMIS_HD
#elif defined(_MSC_VER)
#define LUMIS_INLINE [[msvc::forceinline]] LUMIS_HD
#define LUMIS_NOINLINE [[msvc::noinline]] LUMIS_HD
#define LUMIS_COLD [[msvc::noinline]] LUMIS_HD
#else
#define LUMIS_INLINE LUMIS_HD
#define LUMIS_NOINLINE LUMIS_HD
#define LUMIS_COLD LUMIS_HD
#endif

#ifdef __has_builtin
#define LUMIS_HAS_BUILTIN(name) __has_builtin(name)
#else
#define LUMIS_HAS_BUILTIN(name) 0
#endif

// clang++ says that it has __arithmetic_fence, and rejects it on other machines than these.
#if defined(__clang__) && LUMIS_HAS_BUILTIN(__arithmetic_fence)
#if defined(__x86_64__) || defined(__i386__) || (defined(__aarch64__) && __clang_major__ >= 19)
#define LUMIS_HAS_FENCE
#endif
#endif

// The vector extensions of g++ and clang++ (clang-cl too, which is no __GNUC__). nvcc's device code has none, and a type must
// not change between its two passes.
#if (defined(__GNUC__) || defined(__clang__)) && !defined(__CUDACC__) && !defined(LUMIS_NO_VECTORS)
#define LUMIS_HAS_VECTORS
#define LUMIS_VECTOR(bytes) [[gnu::vector_size(bytes)]]
#endif
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define LUMIS_VECTOR_BYTES 64
#elif defined(__AVX__)
#define LUMIS_VECTOR_BYTES 32
#else
#define LUMIS_VECTOR_BYTES 16
#endif

#define LUMIS_LIFETIME_BOUND
#if defined(__has_cpp_attribute)
#if __has_cpp_attribute(clang::lifetimebound)
#undef LUMIS_LIFETIME_BOUND
#define LUMIS_LIFETIME_BOUND [[clang::lifetimebound]]
#endif
#endif

#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
#define LUMIS_HAS_EXCEPTIONS
#endif
