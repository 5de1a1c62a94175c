// Reference images: computed once, kept in a folder, with their own error.
#pragma once

#include "images/image.hpp"
#include "renderer.hpp"
#include "study.hpp"

#include <filesystem>
#include <span>

namespace convergence {

// Red, green and blue of every pixel in a row.
[[nodiscard]] std::span<const float> values(const tracer::Image& image);

[[nodiscard]] bool is_finite(const glm::vec3& pixel);

// Pixels that are not.
[[nodiscard]] std::int64_t count_not_finite(const tracer::Image& image);

struct ReferenceImage {
    tracer::Image image, power, balance;           // the mean, and what it is the mean of
    double floor;                                  // of relative errors: a tenth of the image's mean
    double squared_error, relative_squared_error;  // of the image itself, mean over its values
    Agreement agreement;
};

// The mean of two images by two integrators, power and balance. They share no sample, so that half their difference
// tells the error of their mean. Throws std::runtime_error if they do not agree within their errors,
// are not finite everywhere, or black. One that is kept
// under `name` is used again unless the program has been built anew since. Points are Sobol's, scrambled anew for each pixel,
// so that pixels are independent.
[[nodiscard]] ReferenceImage reference_image(const tracer::Renderer& renderer, const tracer::RenderOptions& options,
                                             int width, int height, int samples, const std::filesystem::path& folder,
                                             const std::string& name, const Progress& progress);

}  // namespace convergence
