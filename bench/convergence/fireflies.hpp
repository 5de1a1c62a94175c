// Fireflies: what the eye sees first of an estimator whose variance is in a few samples.
#pragma once

#include "images/image.hpp"

namespace convergence {

// Lone pixels shown in white where the reference and all their neighbours are shown in less than half of it.
[[nodiscard]] int count_fireflies(const tracer::Image& image, const tracer::Image& reference);

}  // namespace convergence
