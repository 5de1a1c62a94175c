#include "fireflies.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace convergence {

int count_fireflies(const tracer::Image& image, const tracer::Image& reference) {
    const auto shown = [](const tracer::Image& from, int x, int y) {
        if (x < 0 || y < 0 || x >= from.width || y >= from.height) return 0.0f;
        return std::min(tracer::luminance(from.pixels[static_cast<std::size_t>(y * from.width + x)]), 1.0f);
    };
    int count = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            float expected = shown(reference, x, y);
            for (const auto& [right, down] :
                 {std::pair{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}) {
                expected = std::max(expected, shown(image, x + right, y + down));
            }
            count += shown(image, x, y) == 1 && expected < 0.5f;
        }
    }
    return count;
}

}  // namespace convergence
