// Discrete distributions in fixed point. A table divides the lattice of uniforms into runs of whole lattice points: a
// run's length over the lattice's size is the probability with which it is drawn, exactly, and no difference of rounded
// sums stands in for it (in float those are off by 1 to 4 % in the worst texel of a 4K environment map).
#pragma once

#include "lumis/core/uniforms.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>

namespace lumis {

// log2 of the number of counts that a table deals out: every lattice point of a float, 2^31 for double, whose remaining
// bits place the sample within the entry.
template <std::floating_point T>
inline constexpr int count_bits = std::min(uniform_bits<T>, 31);

template <std::floating_point T>
inline constexpr std::uint32_t total_counts = std::uint32_t{1} << count_bits<T>;

// Throws std::invalid_argument naming the index and the value of the first weight that is NaN, infinite or negative.
template <std::floating_point T>
void require_weights(std::span<const T> weights) {
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (!(weights[i] >= 0 && weights[i] <= std::numeric_limits<T>::max())) {
            throw std::invalid_argument("lumis: weight " + std::to_string(i) + " is " + std::to_string(weights[i]) +
                                        "; weights must be finite and not negative");
        }
    }
}

// value 2^exponent: sums of weights of any magnitude that neither overflow nor underflow.
struct ScaledSum {
    double value{};
    int exponent{};

    [[nodiscard]] double relative_to(int other_exponent) const noexcept {
        return std::scalbn(value, exponent - other_exponent);
    }
};

// Deals the counts out: starts[i] becomes the number of counts before entry i. Every entry with a weight above 0 gets
// one count, and its share of the rest; entries of weight 0 get none. weights: finite, not negative, not more than there
// are counts; all 0 deals nothing. Returns the sum of the weights.
template <std::floating_point T>
ScaledSum deal_counts(std::span<const double> weights, std::span<std::uint32_t> starts) {
    const double largest = *std::max_element(weights.begin(), weights.end());
    if (!(largest > 0)) {
        std::fill(starts.begin(), starts.end(), 0u);
        return {};
    }
    // In units of a power of two near the largest weight.
    const int exponent = std::ilogb(largest);
    const auto scaled = [&](double weight) { return std::scalbn(weight, -exponent); };
    double sum = 0;
    std::uint32_t positive = 0;
    for (const double weight : weights) {
        sum += scaled(weight);
        positive += weight > 0;
    }
    const double shared = total_counts<T> - positive;
    double before = 0;
    std::uint32_t positive_before = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double share = std::min(before / sum, 1.0) * shared;
        starts[i] = positive_before + static_cast<std::uint32_t>(share + 0.5);
        before += scaled(weights[i]);
        positive_before += weights[i] > 0;
    }
    return {sum, exponent};
}

// The number of counts of entry i.
template <std::floating_point T>
[[nodiscard]] std::uint32_t counts_of(std::span<const std::uint32_t> starts, std::size_t i) noexcept {
    return (i + 1 < starts.size() ? starts[i + 1] : total_counts<T>)-starts[i];
}

// An entry drawn by a uniform, its number of counts, and where within the entry's run the uniform lies, in (0, 1].
template <std::floating_point T>
struct DrawnEntry {
    std::size_t index;
    std::uint32_t counts;
    T position;
};

// u in [0, 1]. An entry of weight 0 is never drawn.
template <std::floating_point T>
[[nodiscard]] DrawnEntry<T> draw_entry(std::span<const std::uint32_t> starts, T u) noexcept {
    constexpr int within_bits = uniform_bits<T> - count_bits<T>;
    const std::uint64_t lattice = lattice_index(u);
    const auto count = static_cast<std::uint32_t>(lattice >> within_bits);
    const auto index =
        static_cast<std::size_t>(std::upper_bound(starts.begin(), starts.end(), count) - starts.begin()) - 1;
    // The middle of the lattice cell: centred even where an entry has a single count.
    constexpr std::uint64_t mask = (std::uint64_t{1} << within_bits) - 1;
    const T within = (static_cast<T>(lattice & mask) + T(0.5)) / static_cast<T>(mask + 1);
    const std::uint32_t counts = counts_of<T>(starts, index);
    return {index, counts, (static_cast<T>(count - starts[index]) + within) / static_cast<T>(counts)};
}

// The uniform that draws an entry at a position within its run: the inverse of draw_entry.
template <std::floating_point T>
[[nodiscard]] T uniform_of(std::span<const std::uint32_t> starts, std::size_t index, T position) noexcept {
    return (static_cast<T>(starts[index]) + position * static_cast<T>(counts_of<T>(starts, index))) /
           static_cast<T>(total_counts<T>);
}

// The one of n equal cells of [0, 1] that holds x; beyond them the nearest, and the first for a NaN.
template <std::floating_point T>
[[nodiscard]] std::size_t index_of(T x, std::size_t n) noexcept {
    const T scaled = x * static_cast<T>(n);
    if (!(scaled > 0)) return 0;
    return scaled < static_cast<T>(n) ? static_cast<std::size_t>(scaled) : n - 1;
}

// A position within one of n equal cells of [0, 1], moved a few units in the last place of 1 away from the cell's edges:
// rounded across one, a point would be given the density of one cell and belong to another.
template <std::floating_point T>
[[nodiscard]] T clear_of_edges(T position, std::size_t n) noexcept {
    const T margin = std::min(8 * std::numeric_limits<T>::epsilon() * static_cast<T>(n), T(0.5));
    return std::clamp(position, margin, 1 - margin);
}

// The number of entries of a table, if counts can be dealt to them; throws std::invalid_argument if not.
template <std::floating_point T>
[[nodiscard]] std::size_t checked_size(std::size_t size) {
    if (size == 0 || size > total_counts<T>) {
        throw std::invalid_argument("lumis: a table of " + std::to_string(size) + " weights; there must be from 1 to " +
                                    std::to_string(total_counts<T>));
    }
    return size;
}

}  // namespace lumis
