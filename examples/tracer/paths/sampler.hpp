// The source of a sample's uniforms, of numbers in lanes.
#pragma once

#include "paths/packet.hpp"
#include "paths/random_stream.hpp"
#include "render_options.hpp"
#include <lumis/core/uniforms.hpp>
#include <lumis/qmc/sobol.hpp>

#include <cstdint>

namespace tracer {

// Uniforms of one pixel in one pass. Points of Sobol's sequence belong to one randomisation, of its own for each pixel and pass.
template <lumis::Real R>
class PixelUniforms {
  public:
    PixelUniforms(Sampler sampler, std::uint64_t seed, std::uint64_t pixel, std::uint64_t pass)
        : is_random_{sampler == Sampler::Random}, random_{random_stream(seed, pixel, pass)} {
        if (!is_random_) sobol_.start(mixed(mixed(seed + mixed(pass)) + pixel), 0);
    }

    // The uniforms of the samples `first` and, in the other lanes, of those that follow.
    void start(std::uint32_t first) {
        if (!is_random_) sobol_.start(first);
    }

    template <int N>
    [[nodiscard]] LUMIS_INLINE glm::vec<N, R> next() {
        if (!is_random_) return sobol_.template next<N>();
        glm::vec<N, R> u;
        for (int k = 0; k < N; ++k) {
            u[k] = of_lanes<R>([&](auto) { return static_cast<float>(random_() >> 8) * 0x1p-24f; });
        }
        return u;
    }

  private:
    bool is_random_;
    lumis::Sobol<R> sobol_;
    pcg32 random_;
};

}  // namespace tracer
