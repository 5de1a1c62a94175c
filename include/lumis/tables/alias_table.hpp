// Indices in proportion to weights, in constant time whatever their number. Counting measure: the density is a probability.
// Walker 1977 in fixed point (see alias_rows.hpp): the reported probability is the one drawn, exactly, and the
// probabilities sum to 1.
#pragma once

#include "lumis/core/detail/spannable.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/tables/detail/alias_rows.hpp"
#include "lumis/tables/detail/cumulative_counts.hpp"

#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace lumis {

template <std::floating_point T = float>
class AliasTable {
  public:
    using Scalar = T;
    using Point = std::size_t;
    using Measure = measure::Counting;
    static constexpr int dimensions = 1;

    // Throws std::invalid_argument for no weights, for one that is NaN, infinite or negative, and where the counts (2^24 in
    // float, 2^31 in double) are too few: for more weights than counts, and if those that are less than a count's worth
    // would take more than a quarter of the draws beyond their share (see require_enough_counts, and FineAliasTable).
    // All-zero weights are legal, see empty(). Keeps 8 bytes a weight.
    LUMIS_HD explicit AliasTable(std::span<const T> weights) : table_{detail::checked_size<T>(weights.size()), 1} {
        detail::require_weights(weights);
        const detail::Dealt dealt = table_.deal(0, std::vector<double>(weights.begin(), weights.end()));
        detail::require_enough_counts<T>(dealt);
        probability_of_count_ = dealt.value > 0 ? 1 / static_cast<T>(detail::total_counts<T>) : T(0);
    }

    [[nodiscard]] LUMIS_HD std::size_t size() const noexcept { return table_.entries(); }

    // True if all weights are 0: then nothing is drawn, and the probability is 0.
    [[nodiscard]] LUMIS_HD bool empty() const noexcept { return !(probability_of_count_ > 0); }

    // An index of weight 0 is never drawn.
    [[nodiscard]] LUMIS_HD Sample<Point, T> sample(glm::vec<1, T> u) const noexcept {
        const auto drawn = table_.draw(0, u.x);
        return {drawn.index, static_cast<T>(drawn.counts) * probability_of_count_};
    }

    [[nodiscard]] LUMIS_HD T pdf(Point index) const noexcept {
        return index < size() ? static_cast<T>(table_.counts(0, index)) * probability_of_count_ : T(0);
    }

  private:
    detail::AliasRows<T> table_;
    T probability_of_count_;  // 0 if nothing is drawn
};

template <detail::Spannable R>
AliasTable(const R&) -> AliasTable<detail::ElementOf<R>>;

// An AliasTable<float> with the 2^31 counts of one in double, for weights that 2^24 do not tell apart: more than four million
// lights of very unequal powers, say. It spends two uniforms: the second refines the first. Probabilities are those drawn,
// rounded to float.
class FineAliasTable {
  public:
    using Scalar = float;
    using Point = std::size_t;
    using Measure = measure::Counting;
    static constexpr int dimensions = 2;

    // Throws as AliasTable<double> does. Keeps 8 bytes a weight.
    LUMIS_HD explicit FineAliasTable(std::span<const float> weights)
        : table_{std::vector<double>(weights.begin(), weights.end())} {}

    [[nodiscard]] LUMIS_HD std::size_t size() const noexcept { return table_.size(); }

    // True if all weights are 0: then nothing is drawn, and the probability is 0.
    [[nodiscard]] LUMIS_HD bool empty() const noexcept { return table_.empty(); }

    // An index of weight 0 is never drawn.
    [[nodiscard]] LUMIS_HD Sample<Point, float> sample(glm::vec<2, float> u) const noexcept {
        // Lattice points of a float have 24 bits: together, the first 48 of a double's 53.
        const double refined = double{u.x} + double{u.y} * 0x1p-24;
        const auto drawn = table_.sample(glm::vec<1, double>{refined});
        return {drawn.value, static_cast<float>(drawn.pdf)};
    }

    [[nodiscard]] LUMIS_HD float pdf(Point index) const noexcept { return static_cast<float>(table_.pdf(index)); }

  private:
    AliasTable<double> table_;
};

}  // namespace lumis
