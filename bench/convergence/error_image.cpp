#include "error_image.hpp"

#include <lumis/statistics/error_metrics.hpp>

#include <algorithm>
#include <cmath>

namespace convergence {

std::vector<unsigned char> error_levels(const tracer::Image& image, const ReferenceImage& reference) {
    const auto estimate = values(image), truth = values(reference.image);
    std::vector<unsigned char> levels;
    levels.reserve(image.pixels.size());
    for (std::size_t i = 0; i < estimate.size(); i += 3) {
        const double error =
            std::sqrt(lumis::relative_mean_squared_error(estimate.subspan(i, 3), truth.subspan(i, 3), reference.floor));
        const double height = std::log(error / ErrorScale::low) / std::log(ErrorScale::high / ErrorScale::low);
        levels.push_back(static_cast<unsigned char>(std::lround(255 * std::clamp(height, 0.0, 1.0))));
    }
    return levels;
}

}  // namespace convergence
