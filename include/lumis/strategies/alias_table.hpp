// Indices in proportion to weights, in constant time whatever their number. Counting measure: the density is a probability.
// Walker 1977, built by Vose 1991, in fixed point: bins and weights are whole numbers of lattice points, so that the
// reported probability is the one drawn, exactly, and the probabilities sum to 1.
#pragma once

#include "lumis/core/strategy.hpp"
#include "lumis/strategies/cumulative_counts.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <ranges>
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

    // Throws std::invalid_argument for no weights, for one that is NaN, infinite or negative, and for more than there are
    // lattice points. All-zero weights are legal, see empty(). Keeps 12 bytes a weight.
    explicit AliasTable(std::span<const T> weights) : bins_(checked_size<T>(weights.size())) {
        require_weights(weights);
        const std::vector<double> wide(weights.begin(), weights.end());
        std::vector<std::uint32_t> starts(weights.size());
        empty_ = !(deal_counts<T>(wide, starts).value > 0);
        if (!empty_) fill(starts);
    }

    [[nodiscard]] std::size_t size() const noexcept { return bins_.size(); }

    // True if all weights are 0: then nothing is drawn, and the probability is 0.
    [[nodiscard]] bool empty() const noexcept { return empty_; }

    // An index of weight 0 is never drawn.
    [[nodiscard]] Sample<Point, T> sample(glm::vec<1, T> u) const noexcept {
        if (empty_) return {};
        const auto point = static_cast<std::uint64_t>(lattice_index(u.x) >> (uniform_bits<T> - count_bits<T>));
        const std::size_t bin = (point * bins_.size()) >> count_bits<T>;
        const std::size_t index = point < bins_[bin].split ? bin : bins_[bin].alias;
        return {index, pdf(index)};
    }

    [[nodiscard]] T pdf(Point index) const noexcept {
        return index < bins_.size() ? static_cast<T>(bins_[index].count) / static_cast<T>(total_counts<T>) : T(0);
    }

  private:
    struct Bin {
        std::uint32_t split;  // lattice points of the bin below this draw the bin's own index, the others its alias
        std::uint32_t alias;
        std::uint32_t count;  // lattice points that draw this index, in all bins
    };

    // The first lattice point of a bin.
    [[nodiscard]] std::uint32_t begin_of(std::size_t bin) const noexcept {
        const std::uint64_t n = bins_.size();
        return static_cast<std::uint32_t>(((std::uint64_t{bin} << count_bits<T>)+n - 1) / n);
    }

    [[nodiscard]] std::uint32_t capacity(std::size_t bin) const noexcept { return begin_of(bin + 1) - begin_of(bin); }

    // Bins that their own index does not fill are filled up by an index that its own bin does not hold.
    void fill(std::span<const std::uint32_t> starts) {
        std::vector<std::uint32_t> unplaced(size()), roomy, abundant;
        for (std::uint32_t i = 0; i < size(); ++i) {
            unplaced[i] = counts_of<T>(starts, i);
            bins_[i] = {begin_of(i + 1), i, unplaced[i]};
            if (unplaced[i] < capacity(i)) roomy.push_back(i);
            if (unplaced[i] > capacity(i)) abundant.push_back(i);
        }
        while (!roomy.empty()) {
            const std::uint32_t bin = roomy.back(), donor = abundant.back();
            roomy.pop_back();
            bins_[bin].split = begin_of(bin) + unplaced[bin];
            bins_[bin].alias = donor;
            unplaced[donor] -= capacity(bin) - unplaced[bin];
            if (unplaced[donor] > capacity(donor)) continue;
            abundant.pop_back();
            if (unplaced[donor] < capacity(donor)) roomy.push_back(donor);
        }
    }

    std::vector<Bin> bins_;
    bool empty_{};
};

template <std::ranges::contiguous_range R>
AliasTable(const R&) -> AliasTable<std::remove_cv_t<std::ranges::range_value_t<R>>>;

}  // namespace lumis
