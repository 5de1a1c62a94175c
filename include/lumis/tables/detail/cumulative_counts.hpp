// Discrete distributions in fixed point. A table divides the lattice of uniforms into runs of whole lattice points: a
// run's length over the lattice's size is the probability with which it is drawn, exactly, and no difference of rounded
// sums stands in for it (in float those are off by 1 to 4 % in the worst texel of a 4K environment map).
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/throw.hpp"
#include "lumis/core/uniforms.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace lumis::LUMIS_ISA::detail {

// log2 of the number of counts that a table deals out: every lattice point of a float, 2^31 for double, whose remaining
// bits place the sample within the entry.
template <std::floating_point T>
inline constexpr int count_bits = uniform_bits<T> < 31 ? uniform_bits<T> : 31;

template <std::floating_point T>
inline constexpr std::uint32_t total_counts = std::uint32_t{1} << count_bits<T>;

// How tables are built unless the host brings threads of its own: f(0), f(1), ..., f(n - 1), one after the other. A
// host's own loop may call f in any order and at the same time; the tables come out the same.
struct InOrder {
    void operator()(std::size_t n, auto f) const {
        for (std::size_t i = 0; i < n; ++i) f(i);
    }
};

// What a default-constructed table holds: one weight of 0, from which nothing is drawn. Only its size is told as 0.
inline constexpr double no_weight[] = {0};

template <class Weight>
[[nodiscard]] constexpr bool is_weight(Weight weight) noexcept {
    return (weight >= 0) &
           (weight <= (std::numeric_limits<Weight>::max)());  // no branch: several are looked at at once
}

// Throws std::invalid_argument naming the index and the value of the first weight that is NaN, infinite or negative.
// They are looked at in rows of the given size, see InOrder.
template <class Weight>
void require_weights(std::span<const Weight> weights, std::size_t row_size, const auto& for_each_row) {
    std::vector<char> is_bad(weights.size() / row_size);
    for_each_row(is_bad.size(), [&](std::size_t row) {
        int bad = 0;  // counted, not searched for: that is done several at a time
        for (const Weight weight : weights.subspan(row * row_size, row_size)) bad |= !is_weight(weight);
        is_bad[row] = static_cast<char>(bad);
    });
    if (real::largest_of(is_bad) == 0) return;
    std::size_t i = 0;
    while (is_weight(weights[i])) ++i;
    refuse("lumis: weight " + std::to_string(i) + " is " + std::to_string(weights[i]) +
           "; weights must be finite and not negative");
}
template <class Weight>
void require_weights(std::span<const Weight> weights) {
    if (!weights.empty()) require_weights(weights, weights.size(), InOrder{});
}

// value 2^exponent: sums of weights of any magnitude that neither overflow nor underflow.
struct ScaledSum {
    double value{};
    int exponent{};

    [[nodiscard]] double relative_to(int other_exponent) const noexcept {
        return std::scalbn(value, exponent - other_exponent);
    }
};

// What deal_counts has to say: the sum of the weights, how many of them are less than one count's worth, and which part
// of all counts those have beyond their share, for each keeps a whole one.
struct Dealt : ScaledSum {
    std::uint32_t dim{};
    double excess{};
};

// Deals the counts out: start_of(i) becomes the number of counts before entry i. An entry's counts are its share, rounded,
// but at least one for every weight above 0, and none for weight 0. weights: finite, not negative, not more than there are
// counts; all 0 leaves every count to the last entry. They are overwritten.
//
// Sums are added up one after the other, whatever the machine, so that tables are the same everywhere. The loops between
// them are kept free of sums, so that compilers work on several entries at once.
template <std::floating_point T>
Dealt deal_counts(std::span<double> weights, auto start_of) {
    // 1. The sum, in units of a power of two near the largest weight where it would leave double's range.
    double sum = 0, scale = 1;
    int exponent = 0;
    std::uint32_t positive = 0;
    for (const double weight : weights) {
        sum += weight;
        positive += weight > 0;
    }
    if (!(sum > 0x1p-900 && sum <= (std::numeric_limits<double>::max)())) {
        const double largest = real::largest_of(weights);
        exponent = largest > 0 ? std::ilogb(real::clamp(largest, 0x1p-1022, 0x1p1022)) : 0;
        scale = std::scalbn(1.0, -exponent);
        sum = 0;
        for (const double weight : weights) sum += weight * scale;
    }

    // 2. The weight that one count is worth. A dim entry, one of less than that, takes a whole count. Each of those left is
    // then worth more, which may make further entries dim. A few rounds settle it; where 20 do not, step 3 still gives every
    // entry its count.
    constexpr double all = total_counts<T>;
    Dealt result{{sum, exponent}};
    double worth = sum / all;
    const auto is_bright = [&](double weight) { return weight * scale >= worth; };
    for (std::uint32_t round = 0, bright = positive; round < 20 && bright > 0; ++round) {
        std::uint64_t number = 0;  // as wide as a weight, so that it is counted several at a time
        for (const double weight : weights) number += std::uint64_t{is_bright(weight)};
        const auto brighter = static_cast<std::uint32_t>(number);
        if (brighter == bright) break;
        double weight_of_bright = 0;
        for (const double weight : weights) weight_of_bright += is_bright(weight) ? weight * scale : 0.0;
        if (round == 0) {
            result.dim = positive - brighter;
            result.excess = (result.dim - (sum - weight_of_bright) / worth) / all;
        }
        if (brighter == 0) break;
        bright = brighter;
        worth = weight_of_bright / (all - (positive - bright));
    }

    // 3. One count to every positive weight, and the others in proportion to what the weights are beyond one count's worth.
    // What lies before an entry takes the place of its weight, and the number of positive ones before it that of its start.
    double before = 0;
    std::uint32_t positive_before = 0;
    std::size_t end = 0;  // of the positive weights
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double weight = weights[i];
        weights[i] = before;
        start_of(i) = positive_before;
        before += real::greater(weight * scale - worth, 0.0);
        positive_before += weight > 0;
        end = weight > 0 ? i + 1 : end;
    }
    const double others = all - positive, others_of_weight = before > 0 ? others / before : 0;
    for (std::size_t i = 0; i < end; ++i) {
        const double share = real::lesser(weights[i] * others_of_weight, others);
        // Truncated, not rounded by a call: a share is never negative. NOLINTNEXTLINE(bugprone-incorrect-roundings)
        start_of(i) += static_cast<std::uint32_t>(static_cast<std::int32_t>(share + 0.5));
    }
    // Behind the last positive weight none is left, whatever has been rounded on the way there.
    for (std::size_t i = end; i < weights.size(); ++i) start_of(i) = positive > 0 ? total_counts<T> : 0;
    return result;
}

// The largest part of the draws that may go to dim entries beyond their share. An estimator whose integrand follows the
// weights then has at most 1 / (1 - 1/4) times the second moment that it would have with exact shares.
inline constexpr double largest_excess = 0.25;

// Throws std::invalid_argument if the counts are too few for the weights: so many of them are dim that what they take is
// missing elsewhere. Up to a quarter of total_counts<T> weights (4 million in float) are never too many.
template <std::floating_point T>
void require_enough_counts(const Dealt& dealt) {
    if (dealt.excess <= largest_excess) return;
    refuse("lumis: " + std::to_string(dealt.dim) + " weights are less than 1/" + std::to_string(total_counts<T>) +
           " of the sum, the least probability of a table in this precision, and would take " +
           std::to_string(100 * dealt.excess) + " % of the draws beyond their share; at most 25 % are allowed. " +
           (total_counts<T> < total_counts<double> ? "AliasTable<double> and FineAliasTable have 2^31. " : "") +
           "Draw such weights from a table of their own, or merge them");
}

// Deals a table's only row, and throws std::invalid_argument for weights that are none, and for too few counts.
template <std::floating_point T, class Weight>
Dealt deal_checked(auto& table, std::span<const Weight> weights) {
    require_weights(weights);
    std::vector<double> as_doubles(weights.begin(), weights.end());
    const Dealt dealt = table.deal(0, as_doubles);
    require_enough_counts<T>(dealt);
    return dealt;
}

// An entry drawn by a uniform, its number of counts, and where within the run of counts the uniform lies, in (0, 1].
template <std::floating_point T>
struct DrawnEntry {
    std::size_t index;
    std::uint32_t counts;
    T position;
};

// A lattice point as a count, and where it lies within the count, in (0, 1): a float's has no bits left for that and
// lies in the middle.
template <std::floating_point T>
struct LatticePoint {
    std::uint32_t count;
    T within;
};

// u in [0, 1].
template <std::floating_point T>
[[nodiscard]] LUMIS_HD LatticePoint<T> lattice_point(T u) noexcept {
    constexpr int within_bits = uniform_bits<T> - count_bits<T>;
    constexpr std::uint64_t size = std::uint64_t{1} << within_bits;
    const std::uint64_t lattice = lattice_index(u);
    return {static_cast<std::uint32_t>(lattice >> within_bits),
            (static_cast<T>(static_cast<std::int64_t>(lattice & (size - 1))) + T(0.5)) / static_cast<T>(size)};
}

// The one of n equal cells of [0, 1] that holds x; beyond them the nearest, and the first for a NaN.
template <std::floating_point T>
[[nodiscard]] LUMIS_HD std::size_t index_of(T x, std::size_t n) noexcept {
    const T scaled = x * static_cast<T>(n);
    if (!(scaled > 0)) return 0;
    return scaled < static_cast<T>(n) ? static_cast<std::size_t>(scaled) : n - 1;
}

// A position within one of n equal cells of [0, 1], moved a few units in the last place of 1 away from the cell's edges:
// rounded across one, a point would be given the density of one cell and belong to another.
template <std::floating_point T>
[[nodiscard]] LUMIS_HD T clear_of_edges(T position, std::size_t n) noexcept {
    const T margin = real::lesser(8 * std::numeric_limits<T>::epsilon() * static_cast<T>(n), T(0.5));
    return real::clamp(position, margin, 1 - margin);
}

// The number of entries of a table, if counts can be dealt to them; throws std::invalid_argument if not.
template <std::floating_point T>
[[nodiscard]] std::size_t checked_size(std::size_t size) {
    if (size == 0 || size > total_counts<T>) {
        refuse("lumis: a table of " + std::to_string(size) + " weights; there must be from 1 to " +
               std::to_string(total_counts<T>));
    }
    return size;
}

}  // namespace lumis::LUMIS_ISA::detail
