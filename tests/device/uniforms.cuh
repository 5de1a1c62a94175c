// Uniforms for kernels: a stream for each index.
#pragma once

#include <lumis/lumis.hpp>

#include <cstdint>

namespace device {

// SplitMix64 (Steele, Lea and Flood 2014). A source of uniforms is whatever has next<N>().
class Stream {
  public:
    LUMIS_HD explicit Stream(unsigned index) : state_{index * 0x9e3779b97f4a7c15u + 1} {}

    template <int N>
    LUMIS_HD glm::vec<N, float> next() {
        glm::vec<N, float> u;
        for (int i = 0; i < N; ++i) u[i] = static_cast<float>(draw() >> 40) * 0x1p-24f;
        return u;
    }

  private:
    LUMIS_HD std::uint64_t draw() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    std::uint64_t state_;
};

}  // namespace device
