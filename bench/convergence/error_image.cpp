#include "error_image.hpp"

#include <lumis/statistics/error_metrics.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace convergence {

std::vector<unsigned char> error_levels(const tracer::Image& image, const ReferenceImage& reference) {
    const auto estimate = values(image), truth = values(reference.image);
    std::vector<unsigned char> levels;
    levels.reserve(image.pixels.size());
    for (std::size_t i = 0; i < estimate.size(); i += 3) {
        const double error =
            std::sqrt(lumis::relative_mean_squared_error(estimate.subspan(i, 3), truth.subspan(i, 3), reference.floor));
        if (!std::isfinite(error)) {
            levels.push_back(255);
            continue;
        }
        const double height = std::log(error / ErrorScale::low) / std::log(ErrorScale::high / ErrorScale::low);
        levels.push_back(static_cast<unsigned char>(std::lround(255 * std::clamp(height, 0.0, 1.0))));
    }
    return levels;
}

Pooled pool(const tracer::Image& image, const ReferenceImage& reference) {
    const auto estimate = values(image), power = values(reference.power), balance = values(reference.balance);
    const auto deviation_from = [&](double value, double truth, double scale) {
        return (value - truth) / std::max(scale, reference.floor);
    };
    double sum = 0, squares = 0;
    std::vector<double> squared;
    for (std::size_t i = 0; i < estimate.size(); i += 3) {
        double deviation = 0;
        for (std::size_t c = i; c < i + 3; ++c) {
            deviation += 0.5 * (deviation_from(estimate[c], power[c], balance[c]) +
                                deviation_from(estimate[c], balance[c], power[c]));
        }
        sum += deviation;
        squares += deviation * deviation;
        squared.push_back(deviation * deviation);
    }
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const bool no_hits = std::ranges::all_of(estimate, [](float value) { return value == 0; });
    return {unknown, unknown, squares == 0 ? 0 : sum / std::sqrt(squares), tail_share(std::move(squared)), no_hits};
}

}  // namespace convergence
