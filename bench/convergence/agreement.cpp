#include "agreement.hpp"

#include <algorithm>
#include <cmath>

namespace convergence {

Agreement agreement(const tracer::Image& a, const tracer::Image& b, double significance) {
    Agreement result{16, 0, 0, 0};
    for (int top = 0; top < a.height; top += result.block) {
        for (int left = 0; left < a.width; left += result.block) {
            double sum = 0, squares = 0;
            for (int y = top; y < std::min(top + result.block, a.height); ++y) {
                for (int x = left; x < std::min(left + result.block, a.width); ++x) {
                    const auto i = static_cast<std::size_t>(y * a.width + x);
                    const double difference = double{tracer::luminance(a.pixels[i])} - tracer::luminance(b.pixels[i]);
                    sum += difference;
                    squares += difference * difference;
                }
            }
            ++result.blocks;
            if (squares == 0) continue;
            const double z = std::abs(sum) / std::sqrt(squares);
            if (std::isnan(z) || z > result.worst_z) result.worst_z = z;  // NaN stays
        }
    }
    result.limit = std::sqrt(2 * std::log(2 * result.blocks / significance));
    return result;
}

}  // namespace convergence
