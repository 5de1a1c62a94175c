// What a rendering gathers pixel by pixel, and what it tells: the picture, the error of the picture, and what a denoiser
// asks for.
#pragma once

#include "images/image.hpp"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tracer {

// Samples of a pixel in a rendering: with more, a sum in float, of an albedo, stops growing.
inline constexpr int max_samples = 1 << 24;

// The error is read off the spread of passes, not of samples: those of a pass may be points of a low-discrepancy sequence. Where
// passes continue one sequence, their errors cancel in part, and the error of the image is less than what their spread says.
struct Pixel {
    glm::dvec3 sum{0};      // of the samples' radiance
    glm::dvec3 squares{0};  // sum over passes of (sum of the pass)^2 / (samples of the pass)
    std::uint32_t passes{}, samples{};
    glm::vec3 albedo{0}, normal{0};  // sums over samples, of the first surface that each sees

    void add_pass(const glm::dvec3& sum_of_pass, std::uint32_t samples_of_pass) noexcept {
        sum += sum_of_pass;
        squares += sum_of_pass * sum_of_pass / static_cast<double>(samples_of_pass);
        samples += samples_of_pass;
        ++passes;
    }

    // 0 without samples.
    [[nodiscard]] glm::dvec3 mean() const noexcept { return sum / static_cast<double>(samples > 0 ? samples : 1); }

    // The variance of mean(), unbiased if passes are independent; infinite before the second pass. If a pass of n samples has
    // variance v / n, the sum over passes of n (mean of the pass - mean)^2 has expectation (passes - 1) v.
    [[nodiscard]] glm::dvec3 variance() const noexcept;
};

struct Film {
    int width, height;
    std::vector<Pixel> pixels;  // row by row from the top

    Film(int width_, int height_)
        : width{width_},
          height{height_},
          pixels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}

    // All pixels have the same.
    [[nodiscard]] int samples() const { return static_cast<int>(pixels.front().samples); }
    [[nodiscard]] std::uint32_t passes() const { return pixels.front().passes; }

    // Adds the passes of `other`, a film of the same size, to the bit as if they had been added here.
    void merge(const Film& other);

    [[nodiscard]] Image image() const;
    [[nodiscard]] Image standard_error() const;  // of each pixel of image()
    [[nodiscard]] Image albedo() const;
    [[nodiscard]] Image normal() const;  // means of unit vectors: shorter than 1 where a pixel sees several

    // What an .exr keeps beside image(): albedo.R to .B and normal.X to .Z, which a denoiser reads, variance.R to .B (that of
    // the pixel, the square of standard_error()), and samples. They refer to this film.
    [[nodiscard]] std::vector<Layer> layers() const;

    // The estimated error of image() without a reference: the root of the mean, over pixels and channels, of
    // variance / max(value, floor)^2, where floor is a tenth of the image's mean. Its square estimates the
    // lumis::relative_mean_squared_error that image() has against the true image. A pixel counts as no brighter than the third
    // brightest of its neighbours, unless its value less two standard errors is: a lone pixel that is a hundred times too
    // bright has an error of 100 % of itself, and of 10,000 % of what it should be. A light that no sample has found yet is
    // missing here as it is in the image. Infinite before the second pass and while all is black.
    [[nodiscard]] double relative_error() const;
};

}  // namespace tracer
