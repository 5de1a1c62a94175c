// The source of a sample's uniforms, of numbers in lanes.
#pragma once

#include "paths/packet.hpp"
#include "paths/random_stream.hpp"
#include "render_options.hpp"
#include <lumis/core/uniforms.hpp>
#include <lumis/qmc/sobol.hpp>

#include <cstdint>

namespace tracer {

// Uniforms of one pixel in one pass, whose first sample is `first`. All passes of a pixel take points of one Sobol sequence, with
// a randomisation of the pixel's own; random numbers are a stream of the pass's own.
template <lumis::Real R>
class PixelUniforms {
  public:
    PixelUniforms(Sampler sampler, std::uint64_t seed, std::uint64_t pixel, std::uint32_t first)
        : is_random_{sampler == Sampler::Random}, random_{random_stream(seed, pixel, first)} {
        if (!is_random_) sobol_.start(mixed(mixed(seed) + pixel), first);
    }

    // The uniforms of a sample and, in the other lanes, of those that follow.
    void start(std::uint32_t sample) {
        if (!is_random_) sobol_.start(sample);
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
