// What AliasTable, DiscreteTable and their views share: indices with probabilities in whole counts, drawn from a table of a
// single row.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/tables/detail/arrays.hpp"
#include "lumis/tables/detail/cumulative_counts.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace lumis::LUMIS_ISA::detail {

// Rows, of which there is one: AliasRows or GuidedRows. Array: see arrays.hpp.
template <std::floating_point T, template <class, template <class> class> class Rows, template <class> class Array>
class IndexTable {
  public:
    using Scalar = T;
    using Point = std::size_t;
    using Measure = measure::Counting;
    static constexpr int dimensions = 1;

    [[nodiscard]] LUMIS_HD std::size_t size() const noexcept { return size_; }

    // True if all weights are 0, or if there are none: then nothing is drawn, and the probability is 0.
    [[nodiscard]] LUMIS_HD bool empty() const noexcept { return !(probability_of_count_ > 0); }

    // An index of weight 0 is never drawn.
    [[nodiscard]] LUMIS_HD Sample<Point, T> sample(glm::vec<1, T> u) const noexcept {
        const auto drawn = table_.draw(0, u.x);
        return {drawn.index, probability_of(drawn.counts)};
    }

    [[nodiscard]] LUMIS_HD T pdf(Point index) const noexcept {
        return index < size_ ? probability_of(counts(index)) : T(0);
    }

  protected:
    IndexTable() requires Owns<Array> : IndexTable{std::span<const double>{no_weight}} { size_ = 0; }

    template <class Weight>
    explicit IndexTable(std::span<const Weight> weights)
        : table_{checked_size<T>(weights.size()), 1}, size_{weights.size()} {
        const Dealt dealt = deal_checked<T>(table_, weights);
        probability_of_count_ = dealt.value > 0 ? 1 / static_cast<T>(total_counts<T>) : T(0);
    }

    IndexTable(const IndexTable<T, Rows, Owned>& owner, auto& place)
        : table_{owner.table_, place}, size_{owner.size_}, probability_of_count_{owner.probability_of_count_} {}

    [[nodiscard]] LUMIS_HD T probability_of(std::uint32_t counts) const noexcept {
        return static_cast<T>(counts) * probability_of_count_;
    }
    [[nodiscard]] LUMIS_HD const Rows<T, Array>& table() const noexcept { return table_; }

  private:
    template <std::floating_point, template <class, template <class> class> class, template <class> class>
    friend class IndexTable;

    [[nodiscard]] LUMIS_HD std::uint32_t counts(Point index) const noexcept {
        if constexpr (requires { table_.counts_unguessed(0, index); }) {
            return table_.counts_unguessed(0, index);
        } else {
            return table_.counts(0, index);
        }
    }

    Rows<T, Array> table_;
    std::size_t size_;
    T probability_of_count_;  // 0 if nothing is drawn
};

}  // namespace lumis::LUMIS_ISA::detail
