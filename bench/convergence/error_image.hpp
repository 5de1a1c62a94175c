// Where an image is wrong: the relative error of each of its pixels, as levels of grey of which the page makes false colors.
#pragma once

#include "reference_image.hpp"

#include <vector>

namespace convergence {

// One scale for all images: `low` and less is level 0, `high` and more level 255, logarithmic between.
struct ErrorScale {
    static constexpr double low = 1e-3, high = 10;
};

// Row by row from the top. The mean of the squared errors is the image's relative mean squared error (of which the
// reference's own, here included, is taken off elsewhere).
[[nodiscard]] std::vector<unsigned char> error_levels(const tracer::Image& image, const ReferenceImage& reference);

}  // namespace convergence
