// Where an image is wrong: the relative error of each of its pixels, as levels of grey of which the page makes false colors.
#pragma once

#include "reference_image.hpp"

#include <vector>

namespace convergence {

// One scale for all images: `low` and less is level 0, `high` and more level 255, logarithmic between.
struct ErrorScale {
    static constexpr double low = 1e-3, high = 10;
};

// Row by row from the top. A pixel that is not finite is as wrong as the scale goes. The mean of the squared errors is the
// image's relative mean squared error (of which the reference's own, here included, is taken off elsewhere).
[[nodiscard]] std::vector<unsigned char> error_levels(const tracer::Image& image, const ReferenceImage& reference);

// Whether the mean image is off the reference, and what rules its error: from each pixel's relative deviation. It is taken
// from either half of the reference, relative to the other: divided by its own noise, what is too dark would count for
// more than what is too bright, and the reference would seem to be biased. Pixels are independent, and so their sum has the
// root of the sum of their squares for its error (both images' noise is in it).
[[nodiscard]] Pooled pool(const tracer::Image& image, const ReferenceImage& reference);

}  // namespace convergence
