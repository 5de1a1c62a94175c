// Do two renderings of one image agree within their errors?
#pragma once

#include "images/image.hpp"
#include "study.hpp"

namespace convergence {

// Block by block, the difference of the two in units of its own error: the sum of the pixels' differences in luminance
// over the root of the sum of their squares. Pixels are independent, so that no variance need be known; where the
// differences are as likely positive as negative, z > t has at most the probability exp(-t^2 / 2), however heavy their
// tails (Hoeffding 1963). The limit is passed by chance with a probability of at most `significance`, over all blocks.
[[nodiscard]] Agreement agreement(const tracer::Image& a, const tracer::Image& b, double significance = 1e-4);

}  // namespace convergence
