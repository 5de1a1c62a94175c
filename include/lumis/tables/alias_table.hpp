// Indices in proportion to weights, in constant time whatever their number. Counting measure: the density is a probability.
// Neighbouring uniforms may draw indices far apart: see discrete_table.hpp for low-discrepancy points.
// Walker 1977 in fixed point (see alias_rows.hpp): the reported probability is the one drawn, exactly, and the
// probabilities sum to 1.
//
// A table owns its memory. A view of it is small and draws the same: view() refers to the table, which must live as long;
// view(place) refers to a copy, in a GPU's memory for instance. place(array) is called with the table's array, a std::span
// of constant elements that are trivially copyable, and returns a std::span of its copy.
#pragma once

#include "lumis/core/detail/spannable.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/tables/detail/alias_rows.hpp"
#include "lumis/tables/detail/arrays.hpp"
#include "lumis/tables/detail/index_table.hpp"

#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

namespace lumis::LUMIS_ISA {

template <std::floating_point T>
class AliasTable;

// An AliasTable's way to draw, without its memory: made by AliasTable::view, trivially copyable.
template <std::floating_point T = float>
class AliasTableView : public detail::IndexTable<T, detail::AliasRows, detail::Viewed> {
    friend class AliasTable<T>;
    using detail::IndexTable<T, detail::AliasRows, detail::Viewed>::IndexTable;
};

template <std::floating_point T = float>
class AliasTable : public detail::IndexTable<T, detail::AliasRows, detail::Owned> {
    using Base = detail::IndexTable<T, detail::AliasRows, detail::Owned>;

  public:
    // No weights; another table may be assigned.
    AliasTable() = default;

    // Throws std::invalid_argument for no weights, for one that is NaN, infinite or negative, and where the counts (2^24 in
    // float, 2^31 in double) are too few: for more weights than counts, and if those that are less than a count's worth
    // would take more than a quarter of the draws beyond their share (see require_enough_counts, and FineAliasTable).
    // All-zero weights are legal, see empty(). Keeps 8 bytes a weight.
    //
    // A probability is a whole number of counts, drawn exactly so often, but as far off its weight's share as whole counts are:
    // a count or less, so an average one of 1e6 weights in float, which has 16 counts, by up to 3 % either way, and one of a
    // single count by half. Estimates stay unbiased, and an estimator whose integrand follows the weights becomes that much
    // noisier. FineAliasTable has 128 times as many counts, for the same memory.
    explicit AliasTable(std::span<const T> weights) : Base{weights} {}

    // Weights of another type, doubles for a table in float for instance, count as they are.
    template <detail::RangeOfOther<T> R>
    explicit AliasTable(const R& weights) : Base{detail::span_of(weights)} {}

    [[nodiscard]] AliasTableView<T> view() const noexcept LUMIS_LIFETIME_BOUND { return view(detail::InPlace{}); }
    [[nodiscard]] AliasTableView<T> view(auto&& place) const { return AliasTableView<T>{*this, place}; }
};

template <detail::Spannable R>
AliasTable(const R&) -> AliasTable<detail::ElementOf<R>>;

namespace detail {

// What FineAliasTable and FineAliasTableView share. Table: an alias table in double.
template <class Table>
class BasicFineAliasTable {
  public:
    using Scalar = float;
    using Point = std::size_t;
    using Measure = measure::Counting;
    static constexpr int dimensions = 2;

    [[nodiscard]] LUMIS_HD std::size_t size() const noexcept { return table_.size(); }

    // True if all weights are 0, or if there are none: then nothing is drawn, and the probability is 0.
    [[nodiscard]] LUMIS_HD bool empty() const noexcept { return table_.empty(); }

    // An index of weight 0 is never drawn.
    [[nodiscard]] LUMIS_HD Sample<Point, float> sample(glm::vec<2, float> u) const noexcept {
        // Lattice points of a float have 24 bits: together, the first 48 of a double's 53.
        const double refined = double{u.x} + double{u.y} * 0x1p-24;
        const auto drawn = table_.sample(glm::vec<1, double>{refined});
        return {drawn.value, static_cast<float>(drawn.pdf)};
    }

    [[nodiscard]] LUMIS_HD float pdf(Point index) const noexcept { return static_cast<float>(table_.pdf(index)); }

  protected:
    BasicFineAliasTable() = default;
    explicit BasicFineAliasTable(const auto& table) : table_{table} {}

    Table table_;
};

}  // namespace detail

// A FineAliasTable's way to draw, without its memory: made by FineAliasTable::view, trivially copyable.
class FineAliasTableView : public detail::BasicFineAliasTable<AliasTableView<double>> {
    friend class FineAliasTable;
    using detail::BasicFineAliasTable<AliasTableView<double>>::BasicFineAliasTable;
};

// An AliasTable<float> with the 2^31 counts of one in double, for weights that 2^24 do not tell apart: more than four million
// lights of very unequal powers, say. It spends two uniforms: the second refines the first. Probabilities are those drawn,
// rounded to float.
class FineAliasTable : public detail::BasicFineAliasTable<AliasTable<double>> {
    using Base = detail::BasicFineAliasTable<AliasTable<double>>;

  public:
    // No weights; another table may be assigned.
    FineAliasTable() = default;

    // Throws as AliasTable<double> does. Keeps 8 bytes a weight.
    explicit FineAliasTable(std::span<const float> weights) : Base{weights} {}
    template <detail::RangeOfOther<float> R>
    explicit FineAliasTable(const R& weights) : Base{detail::span_of(weights)} {}

    [[nodiscard]] FineAliasTableView view() const noexcept LUMIS_LIFETIME_BOUND { return view(detail::InPlace{}); }
    [[nodiscard]] FineAliasTableView view(auto&& place) const { return FineAliasTableView{table_.view(place)}; }
};

}  // namespace lumis::LUMIS_ISA
