// Errors of an estimate against a reference, value by value (the pixels of an image, say). Both are contiguous ranges of
// floats or doubles, of one length. The mean of nothing is NaN; a value that is not finite makes the error so.
#pragma once

#include "lumis/core/assert.hpp"
#include "lumis/core/detail/spannable.hpp"
#include "lumis/core/platform.hpp"

#include <cmath>
#include <cstddef>
#include <span>

namespace lumis::LUMIS_ISA {

// Mean of (estimate - reference)^2.
template <detail::Spannable Values>
[[nodiscard]] LUMIS_HD double mean_squared_error(const Values& estimate, const Values& reference) noexcept {
    const std::span e{estimate}, r{reference};
    LUMIS_ASSERT(e.size() == r.size());
    double sum = 0;
    for (std::size_t i = 0; i < e.size(); ++i) {
        const double error = double{e[i]} - double{r[i]};
        sum += error * error;
    }
    return sum / static_cast<double>(e.size());
}

template <detail::Spannable Values>
[[nodiscard]] LUMIS_HD double root_mean_squared_error(const Values& estimate, const Values& reference) noexcept {
    return std::sqrt(mean_squared_error(estimate, reference));
}

// Mean of ((estimate - reference) / max(|reference|, floor))^2: errors as fractions of the reference, so that a dark
// region counts as much as a bright one. The floor, in the unit of the values, says from where on dark is black; with a
// floor of 0, a reference of 0 has no relative error.
template <detail::Spannable Values>
[[nodiscard]] LUMIS_HD double relative_mean_squared_error(const Values& estimate, const Values& reference,
                                                          double floor) noexcept {
    const std::span e{estimate}, r{reference};
    LUMIS_ASSERT(e.size() == r.size());
    double sum = 0;
    for (std::size_t i = 0; i < e.size(); ++i) {
        const double error = (double{e[i]} - double{r[i]}) / std::fmax(std::abs(double{r[i]}), floor);
        sum += error * error;
    }
    return sum / static_cast<double>(e.size());
}

}  // namespace lumis::LUMIS_ISA
