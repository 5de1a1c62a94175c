// The first four dimensions of Sobol's sequence, and its randomisation by hashes.
#pragma once

#include "lumis/core/detail/for_each_index.hpp"
#include "lumis/core/platform.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace lumis::LUMIS_ISA::detail {

// Four dimensions of a point, each of 32 binary digits: x / 2^32 is the coordinate.
inline constexpr std::size_t sobol_dimensions = 4;
using SobolPoint = std::array<std::uint32_t, sobol_dimensions>;

// The directions that the digits of an index add up to a point, the lowest digit's first. A dimension follows the recurrence of a
// primitive polynomial, v_k = a_1 v_(k-1) ^ ... ^ v_(k-s) ^ (v_(k-s) >> s); the first are 1/2, 3/4, 1/8 and the like. Polynomials and
// first directions are those of Joe and Kuo (2008), which many libraries have.
[[nodiscard]] constexpr std::array<SobolPoint, 32> sobol_directions() noexcept {
    std::array<SobolPoint, 32> v{};
    constexpr std::uint32_t half = 0x80000000u;
    for (std::size_t k = 0; k < v.size(); ++k) {
        v[k][0] = half >> k;
        v[k][1] = k < 1 ? half : v[k - 1][1] ^ v[k - 1][1] >> 1;
        v[k][2] = k < 2 ? (k < 1 ? half : half | half >> 1) : v[k - 1][2] ^ v[k - 2][2] ^ v[k - 2][2] >> 2;
        v[k][3] = k < 3 ? (k == 1 ? half | half >> 1 : half >> k) : v[k - 2][3] ^ v[k - 3][3] ^ v[k - 3][3] >> 3;
    }
    return v;
}

// The digits the other way round: what scrambling works on.
[[nodiscard]] LUMIS_INLINE constexpr std::uint32_t reversed_bits(std::uint32_t x) noexcept {
    x = x >> 16 | x << 16;
    x = (x >> 8 & 0x00ff00ffu) | (x & 0x00ff00ffu) << 8;
    x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    return (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
}

// Sums of reversed directions for each value of four digits of a reversed index, so that a point is a sum of eight.
[[nodiscard]] constexpr std::array<std::array<SobolPoint, 16>, 8> sobol_sums() noexcept {
    std::array<std::array<SobolPoint, 16>, 8> sums{};
    const auto directions = sobol_directions();
    for (std::size_t group = 0; group < sums.size(); ++group) {
        for (unsigned digits = 1; digits < 16; ++digits) {
            const auto lowest = static_cast<std::size_t>(std::countr_zero(digits));
            const SobolPoint &others = sums[group][digits & (digits - 1)],
                             &direction = directions[31 - (4 * group + lowest)];
            for (std::size_t d = 0; d < sobol_dimensions; ++d) {
                sums[group][digits][d] = others[d] ^ reversed_bits(direction[d]);
            }
        }
    }
    return sums;
}

#ifndef __CUDACC__
inline constexpr auto sums_of_directions = sobol_sums();
#endif

// Adds the directions that four digits of a reversed index select. CUDA devices have no static arrays of the host to refer to:
// there each digit's directions are constants in the code.
template <std::size_t Group>
LUMIS_INLINE constexpr void add_directions(SobolPoint& point, std::uint32_t reversed_index) noexcept {
#ifdef __CUDACC__
    for_each_index<4 * sobol_dimensions>([&point, reversed_index](auto i) {
        constexpr std::size_t digit = 4 * Group + i / sobol_dimensions, d = i % sobol_dimensions;
        constexpr std::uint32_t direction = reversed_bits(sobol_directions()[31 - digit][d]);
        point[d] ^= (reversed_index >> digit & 1) != 0 ? direction : 0;
    });
#else
    const SobolPoint& part = sums_of_directions[Group][reversed_index >> 4 * Group & 15];
    for (std::size_t d = 0; d < sobol_dimensions; ++d) point[d] ^= part[d];
#endif
}

// The points of L places, all with reversed digits. Places that differ in their first four digits alone, the last when
// reversed, as those of an aligned run do, share all other directions.
template <std::size_t L>
LUMIS_INLINE constexpr void reversed_sobol_points(const std::uint32_t (&places)[L], bool is_run,
                                                  std::uint32_t (&digits)[sobol_dimensions][L]) noexcept {
    constexpr std::size_t last = 7;
    SobolPoint shared{};
    for (std::size_t lane = 0; lane < L; ++lane) {
        if (lane == 0 || !is_run) {
            shared = {};
            for_each_index<last>([&](auto group) { add_directions<group>(shared, places[lane]); });
        }
        SobolPoint point = shared;
        add_directions<last>(point, places[lane]);
        for (std::size_t d = 0; d < sobol_dimensions; ++d) digits[d][lane] = point[d];
    }
}

// A bijection of 64 bits that flips each bit of the result with probability 1/2 when one of its argument flips: the
// finaliser of SplitMix64 (Steele, Lea and Flood 2014; constants by Stafford, "Mix13").
[[nodiscard]] LUMIS_INLINE constexpr std::uint64_t mixed(std::uint64_t z) noexcept {
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

// The n-th of many keys that one key yields.
[[nodiscard]] LUMIS_INLINE constexpr std::uint64_t derived(std::uint64_t key, std::uint64_t n) noexcept {
    return mixed(key + 0x9e3779b97f4a7c15u * (n + 1));
}

// Flips each bit of x or not as a hash of the key and of all lower bits says: what multiplications and additions modulo 2^32
// do by nature (Laine and Karras 2011). The even factors are Vegdahl's (2021), whose flips depend on lower bits more evenly.
// The key's halves are an addend, which alone makes each result equally likely, and a factor.
[[nodiscard]] LUMIS_INLINE constexpr std::uint32_t flipped_by_lower_bits(std::uint32_t x, std::uint64_t key) noexcept {
    x ^= x * 0x3d20adeau;
    x += static_cast<std::uint32_t>(key);
    x *= static_cast<std::uint32_t>(key >> 32) | 1;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// Owen's scrambling (1995): flips each digit of x / 2^32 or not as a hash of the digits before it says, so that points which
// share digits before share them after.
[[nodiscard]] LUMIS_INLINE constexpr std::uint32_t owen_scrambled(std::uint32_t x, std::uint64_t key) noexcept {
    return reversed_bits(flipped_by_lower_bits(reversed_bits(x), key));
}

}  // namespace lumis::LUMIS_ISA::detail
