// The renderer's random numbers: Sobol points, whose digits are shifted by another amount in each pixel and dimension.
#pragma once

#include "paths/random_stream.hpp"  // tracer::mixed

#include <boost/random/sobol.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace host {

class SobolPoints {
  public:
    static constexpr std::size_t dimensions = 64;

    explicit SobolPoints(std::size_t count) : coordinates_(count * dimensions) {
        boost::random::sobol_engine<std::uint32_t, 32> engine{dimensions};
        for (std::uint32_t& coordinate : coordinates_) coordinate = engine();
    }
    [[nodiscard]] std::uint32_t at(std::size_t index, std::size_t dimension) const {
        return coordinates_[index * dimensions + dimension];
    }

  private:
    std::vector<std::uint32_t> coordinates_;
};

// The uniforms of one path, one after the other. Beyond the dimensions of the points they are merely random.
class PathSampler {
  public:
    // pixel: another one for each pixel of each image.
    PathSampler(const SobolPoints& points, std::size_t index, std::uint64_t pixel)
        : points_{points}, index_{index}, pixel_{tracer::mixed(pixel + 1)} {}

    // In [0, 1): 24 bits, which is what a float holds evenly.
    [[nodiscard]] float next() {
        const std::size_t dimension = dimension_++;
        const bool has_point = dimension < SobolPoints::dimensions;
        const std::uint64_t place = pixel_ + 0x9e3779b97f4a7c15u * (dimension + (has_point ? 0 : index_ << 20));
        const auto shift = static_cast<std::uint32_t>(tracer::mixed(place));
        return static_cast<float>((has_point ? points_.at(index_, dimension) ^ shift : shift) >> 8) * 0x1p-24f;
    }

  private:
    const SobolPoints& points_;
    std::size_t index_, dimension_ = 0;
    std::uint64_t pixel_;
};

}  // namespace host
