// Streams of random numbers that do not depend on each other.
#pragma once

#include <pcg_random.hpp>

#include <cstdint>

namespace tracer {

// A bijection of 64 bits that flips each bit of the result with probability 1/2 when one of its argument flips: the
// finaliser of SplitMix64 (Steele, Lea and Flood 2014; constants by Stafford, "Mix13").
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t z) noexcept {
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

// The engine of one seed, place (a pixel, an estimator) and pass. Engines that differ in one of the three are independent
// as far as statistics tell: tests/tracer/random_stream_test.cpp. Without mixing they would not be. A pcg engine is a linear
// congruential generator whose state is scrambled on output, and states in arithmetic progression stay in one.
template <class Engine = pcg32>
[[nodiscard]] Engine random_stream(std::uint64_t seed, std::uint64_t place = 0, std::uint64_t pass = 0) {
    constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15u;  // keeps mixed() away from 0, which it maps to 0
    const std::uint64_t stream = mixed(mixed(seed + golden_ratio) + place);
    return {mixed(stream + golden_ratio + pass), stream};
}

}  // namespace tracer
