// Errors of an estimate against a reference, value by value (the pixels of an image, say).
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace lumis {

// Mean of (estimate - reference)^2. NaN for empty spans; not finite if any value is not.
template <std::floating_point T>
[[nodiscard]] double mean_squared_error(std::span<const T> estimate, std::span<const T> reference) noexcept {
    assert(estimate.size() == reference.size());
    double sum = 0;
    for (std::size_t i = 0; i < estimate.size(); ++i) {
        const double error = double{estimate[i]} - double{reference[i]};
        sum += error * error;
    }
    return sum / static_cast<double>(estimate.size());
}

template <std::floating_point T>
[[nodiscard]] double root_mean_squared_error(std::span<const T> estimate, std::span<const T> reference) noexcept {
    return std::sqrt(mean_squared_error(estimate, reference));
}

// Mean of ((estimate - reference) / max(|reference|, floor))^2: errors as fractions of the reference, so that a dark
// region counts as much as a bright one; the floor, in the unit of the values, says from where on dark is black.
template <std::floating_point T>
[[nodiscard]] double relative_mean_squared_error(std::span<const T> estimate, std::span<const T> reference,
                                                 double floor) noexcept {
    assert(estimate.size() == reference.size());
    double sum = 0;
    for (std::size_t i = 0; i < estimate.size(); ++i) {
        const double error =
            (double{estimate[i]} - double{reference[i]}) / std::fmax(std::abs(double{reference[i]}), floor);
        sum += error * error;
    }
    return sum / static_cast<double>(estimate.size());
}

}  // namespace lumis
