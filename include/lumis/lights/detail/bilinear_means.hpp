// The mean over each texel of the bilinear function that a host looks up in an image.
#pragma once

#include "lumis/core/platform.hpp"

#include <cstddef>
#include <span>

namespace lumis::LUMIS_ISA::detail {

// What lies beyond a row's ends: its other end, or the texel at the end once more. Beyond the first and the last row it is
// always those once more.
enum class AcrossEdges { Wrap, Clamp };

// Sets means[x] for the texels of row y. A bilinear function's mean over a cell weighs the cell's own value by 3/4 and its two
// neighbours by 1/8 in either direction: it is 0 only where the function is.
template <class Luminance>
void bilinear_means(std::span<const Luminance> luminance, std::size_t width, std::size_t y, AcrossEdges edges,
                    std::span<double> means) noexcept {
    const std::size_t height = luminance.size() / width;
    const auto texels = [&](std::size_t row) { return luminance.subspan(row * width, width); };
    const auto above = texels(y > 0 ? y - 1 : 0), here = texels(y), below = texels(y + 1 < height ? y + 1 : y);
    const auto down = [&](std::size_t x) {
        return 0.125 * static_cast<double>(above[x]) + 0.75 * static_cast<double>(here[x]) +
               0.125 * static_cast<double>(below[x]);
    };
    const auto across = [&](std::size_t left, std::size_t x, std::size_t right) {
        means[x] = 0.125 * down(left) + 0.75 * down(x) + 0.125 * down(right);
    };
    const std::size_t last = width - 1, second = last > 0 ? 1 : 0;
    const bool wraps = edges == AcrossEdges::Wrap;
    across(wraps ? last : 0, 0, second);
    for (std::size_t x = 1; x < last; ++x) across(x - 1, x, x + 1);
    if (last > 0) across(last - 1, last, wraps ? 0 : last);
}

}  // namespace lumis::LUMIS_ISA::detail
