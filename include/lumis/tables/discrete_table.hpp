// Indices in proportion to weights, in their order: a larger uniform never draws a smaller index, so that Sobol points and
// strata stay spread over the indices. Counting measure: the density is a probability.
// The inverse of the cumulative distribution in fixed point, searched with a guide (see guided_rows.hpp): constant expected
// time. The reported probability is the one drawn, exactly, and the probabilities sum to 1. Views: see alias_table.hpp.
#pragma once

#include "lumis/core/detail/spannable.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/tables/detail/arrays.hpp"
#include "lumis/tables/detail/guided_rows.hpp"
#include "lumis/tables/detail/index_table.hpp"

#include <concepts>
#include <cstddef>
#include <limits>
#include <span>

namespace lumis::LUMIS_ISA {

// An index, and what is left of the uniform that drew it: a uniform of its own, in (0, 1), to be spent on something else.
template <std::floating_point T>
struct RemappedIndex {
    std::size_t value{};
    T pdf{};
    T rest{};
};

namespace detail {

template <std::floating_point T, template <class> class Array>
class BasicDiscreteTable : public IndexTable<T, GuidedRows, Array> {
  public:
    // As sample. In float the rest takes as many values as the index has counts, 2^24 times its probability; in double it is
    // as fine as a float for probabilities down to 2^-29.
    [[nodiscard]] LUMIS_HD RemappedIndex<T> sample_remapped(glm::vec<1, T> u) const noexcept {
        const auto drawn = this->table().draw(0, u.x);
        return {drawn.index, this->probability_of(drawn.counts),
                real::lesser(drawn.position, 1 - std::numeric_limits<T>::epsilon() / 2)};
    }

    // The uniform that draws the index and leaves the rest: the inverse of sample_remapped. 1 beyond the last index; that of
    // an index of probability 0 draws the one behind it.
    [[nodiscard]] LUMIS_HD glm::vec<1, T> invert(std::size_t index, T rest) const noexcept {
        return glm::vec<1, T>{index < this->size() ? this->table().uniform_of(0, index, rest) : T(1)};
    }

  protected:
    using IndexTable<T, GuidedRows, Array>::IndexTable;
};

}  // namespace detail

template <std::floating_point T>
class DiscreteTable;

// A DiscreteTable's way to draw, without its memory: made by DiscreteTable::view, trivially copyable.
template <std::floating_point T = float>
class DiscreteTableView : public detail::BasicDiscreteTable<T, detail::Viewed> {
    friend class DiscreteTable<T>;
    using detail::BasicDiscreteTable<T, detail::Viewed>::BasicDiscreteTable;
};

template <std::floating_point T = float>
class DiscreteTable : public detail::BasicDiscreteTable<T, detail::Owned> {
    using Base = detail::BasicDiscreteTable<T, detail::Owned>;

  public:
    // No weights; another table may be assigned.
    DiscreteTable() = default;

    // Throws as AliasTable does, whose probabilities it has. Keeps 6 bytes a weight.
    explicit DiscreteTable(std::span<const T> weights) : Base{weights} {}
    template <detail::RangeOfOther<T> R>
    explicit DiscreteTable(const R& weights) : Base{detail::span_of(weights)} {}

    [[nodiscard]] DiscreteTableView<T> view() const noexcept LUMIS_LIFETIME_BOUND { return view(detail::InPlace{}); }
    [[nodiscard]] DiscreteTableView<T> view(auto&& place) const { return DiscreteTableView<T>{*this, place}; }
};

template <detail::Spannable R>
DiscreteTable(const R&) -> DiscreteTable<detail::ElementOf<R>>;

}  // namespace lumis::LUMIS_ISA
