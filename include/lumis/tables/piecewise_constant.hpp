// Points of [0,1] and [0,1]^2 with a density that is constant in each of equally large cells, in proportion to weights.
// Lebesgue measure. In fixed point (see cumulative_counts.hpp): the density is the frequency really drawn. Tables own their
// memory; for their views see alias_table.hpp.
#pragma once

#include "lumis/core/detail/spannable.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/tables/detail/arrays.hpp"
#include "lumis/tables/detail/count_grid.hpp"
#include "lumis/tables/detail/cumulative_counts.hpp"
#include "lumis/tables/detail/guided_rows.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace lumis::LUMIS_ISA {

namespace detail {

// What PiecewiseConstant1D and its view share. Array: see arrays.hpp.
template <std::floating_point T, template <class> class Array>
class BasicPiecewiseConstant1D {
  public:
    using Scalar = T;
    using Point = T;
    using Measure = measure::Lebesgue;
    static constexpr int dimensions = 1;

    [[nodiscard]] LUMIS_HD std::size_t size() const noexcept { return size_; }

    // True if all weights are 0, or if there are none: then nothing is drawn, and the density is 0.
    [[nodiscard]] LUMIS_HD bool empty() const noexcept { return !(density_of_count_ > 0); }

    // A cell of weight 0 is never drawn.
    [[nodiscard]] LUMIS_HD Sample<Point, T> sample(glm::vec<1, T> u) const noexcept {
        const auto drawn = table_.draw(0, u.x);
        const T x = real::divide(static_cast<T>(drawn.index) + clear_of_edges(drawn.position, table_.entries()),
                                 static_cast<T>(table_.entries()));
        return {x, density(drawn.counts)};
    }

    [[nodiscard]] LUMIS_HD T pdf(Point x) const noexcept {
        return x >= 0 && x <= 1 ? density(table_.counts(0, index_of(x, table_.entries()))) : T(0);
    }

    [[nodiscard]] LUMIS_HD glm::vec<1, T> invert(Point x) const noexcept {
        const std::size_t index = index_of(x, table_.entries());
        return glm::vec<1, T>{
            table_.uniform_of(0, index, x * static_cast<T>(table_.entries()) - static_cast<T>(index))};
    }

  protected:
    BasicPiecewiseConstant1D() requires Owns<Array> : BasicPiecewiseConstant1D{std::span<const double>{no_weight}} {
        size_ = 0;
    }

    template <class Weight>
    explicit BasicPiecewiseConstant1D(std::span<const Weight> weights)
        : table_{checked_size<T>(weights.size()), 1}, size_{weights.size()} {
        const Dealt dealt = deal_checked<T>(table_, weights);
        density_of_count_ = dealt.value > 0 ? static_cast<T>(size()) / static_cast<T>(total_counts<T>) : T(0);
    }

    BasicPiecewiseConstant1D(const BasicPiecewiseConstant1D<T, Owned>& owner, auto& place)
        : table_{owner.table_, place}, size_{owner.size_}, density_of_count_{owner.density_of_count_} {}

  private:
    template <std::floating_point, template <class> class>
    friend class BasicPiecewiseConstant1D;

    [[nodiscard]] LUMIS_HD T density(std::uint32_t counts) const noexcept {
        return static_cast<T>(counts) * density_of_count_;
    }

    GuidedRows<T, Array> table_;
    std::size_t size_;
    T density_of_count_;  // 0 if nothing is drawn
};

// What PiecewiseConstant2D and its view share.
template <std::floating_point T, template <class> class Array>
class BasicPiecewiseConstant2D {
  public:
    using Scalar = T;
    using Point = glm::vec<2, T>;
    using Measure = measure::Lebesgue;
    static constexpr int dimensions = 2;

    [[nodiscard]] LUMIS_HD std::size_t width() const noexcept { return grid_.columns(); }
    [[nodiscard]] LUMIS_HD std::size_t height() const noexcept { return grid_.rows(); }

    // True if all weights are 0, or if there are none: then nothing is drawn, and the density is 0.
    [[nodiscard]] LUMIS_HD bool empty() const noexcept { return grid_.empty(); }

    // u.y draws the row, u.x the cell within it; x runs along a row.
    [[nodiscard]] LUMIS_HD Sample<Point, T> sample(glm::vec<2, T> u) const noexcept {
        if (empty()) return {};
        const auto drawn = grid_.draw(u);
        const Point x{real::divide(static_cast<T>(drawn.column) + drawn.position.x, static_cast<T>(grid_.width())),
                      real::divide(static_cast<T>(drawn.row) + drawn.position.y, static_cast<T>(grid_.height()))};
        return {x, static_cast<T>(drawn.counts) * densities_of_count_[drawn.row]};
    }

    [[nodiscard]] LUMIS_HD T pdf(const Point& x) const noexcept {
        if (empty() || !(x.x >= 0 && x.x <= 1 && x.y >= 0 && x.y <= 1)) return T(0);
        const auto cell = grid_.locate(x);
        return static_cast<T>(grid_.cell_counts(cell.column, cell.row)) * densities_of_count_[cell.row];
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& x) const noexcept {
        return grid_.invert(grid_.locate(x));
    }

  protected:
    BasicPiecewiseConstant2D() requires Owns<Array>
        : BasicPiecewiseConstant2D{1, 1, std::span<const double>{no_weight}, InOrder{}} {
        grid_.tell_no_size();
    }

    template <class Weight>
    BasicPiecewiseConstant2D(std::integral auto width, std::integral auto height, std::span<const Weight> weights,
                             const auto& for_each_row)
        : grid_{width, height, weights.size()} {
        require_weights(weights, this->width(), for_each_row);
        const auto weights_of = [&](std::size_t y, std::span<double> row) {
            for (std::size_t x = 0; x < row.size(); ++x) row[x] = static_cast<double>(weights[y * row.size() + x]);
        };
        grid_.deal(
            weights_of, [](std::size_t) { return 1.0; }, for_each_row);
        // The cells of a row have total_counts<T> in all, and so have the rows.
        constexpr double all = total_counts<T>;
        const double of_counts = static_cast<double>(this->width()) / all * (static_cast<double>(this->height()) / all);
        densities_of_count_.reserve(this->height());
        for (std::size_t y = 0; y < this->height(); ++y)
            densities_of_count_.push_back(static_cast<T>(grid_.row_counts(y) * of_counts));
    }

    BasicPiecewiseConstant2D(const BasicPiecewiseConstant2D<T, Owned>& owner, auto& place)
        : grid_{owner.grid_, place}, densities_of_count_{viewed(owner.densities_of_count_, place)} {}

  private:
    template <std::floating_point, template <class> class>
    friend class BasicPiecewiseConstant2D;

    CountGrid<T, GuidedRows, Array> grid_;
    Array<T> densities_of_count_;  // of each row: the density of a cell with a single count
};

}  // namespace detail

template <std::floating_point T>
class PiecewiseConstant1D;
template <std::floating_point T>
class PiecewiseConstant2D;

template <std::floating_point T = float>
class PiecewiseConstant1DView : public detail::BasicPiecewiseConstant1D<T, detail::Viewed> {
    friend class PiecewiseConstant1D<T>;
    using detail::BasicPiecewiseConstant1D<T, detail::Viewed>::BasicPiecewiseConstant1D;
};

template <std::floating_point T = float>
class PiecewiseConstant2DView : public detail::BasicPiecewiseConstant2D<T, detail::Viewed> {
    friend class PiecewiseConstant2D<T>;
    using detail::BasicPiecewiseConstant2D<T, detail::Viewed>::BasicPiecewiseConstant2D;
};

template <std::floating_point T = float>
class PiecewiseConstant1D : public detail::BasicPiecewiseConstant1D<T, detail::Owned> {
    using Base = detail::BasicPiecewiseConstant1D<T, detail::Owned>;

  public:
    // No weights; another table may be assigned.
    PiecewiseConstant1D() = default;

    // Throws std::invalid_argument for no weights, for one that is NaN, infinite or negative, and for more than there are
    // counts (2^24 in float), or too many dim ones (see require_enough_counts). All-zero weights are legal, see empty().
    // Keeps 6 bytes a weight.
    explicit PiecewiseConstant1D(std::span<const T> weights) : Base{weights} {}
    template <detail::RangeOfOther<T> R>
    explicit PiecewiseConstant1D(const R& weights) : Base{detail::span_of(weights)} {}

    [[nodiscard]] PiecewiseConstant1DView<T> view() const noexcept LUMIS_LIFETIME_BOUND {
        return view(detail::InPlace{});
    }
    [[nodiscard]] PiecewiseConstant1DView<T> view(auto&& place) const {
        return PiecewiseConstant1DView<T>{*this, place};
    }
};

template <std::floating_point T = float>
class PiecewiseConstant2D : public detail::BasicPiecewiseConstant2D<T, detail::Owned> {
    using Base = detail::BasicPiecewiseConstant2D<T, detail::Owned>;

  public:
    // No weights; another table may be assigned.
    PiecewiseConstant2D() = default;

    // weights: width x height values, row by row. Throws as PiecewiseConstant1D does, and for a size that does not match.
    // for_each_row: see detail::InOrder. Keeps 6 bytes a weight, and 16 more a row; 20 in double.
    template <class ForEachRow = detail::InOrder>
    PiecewiseConstant2D(std::integral auto width, std::integral auto height, std::span<const T> weights,
                        const ForEachRow& for_each_row = {})
        : Base{width, height, weights, for_each_row} {}
    template <detail::RangeOfOther<T> R, class ForEachRow = detail::InOrder>
    PiecewiseConstant2D(std::integral auto width, std::integral auto height, const R& weights,
                        const ForEachRow& for_each_row = {})
        : Base{width, height, detail::span_of(weights), for_each_row} {}

    [[nodiscard]] PiecewiseConstant2DView<T> view() const noexcept LUMIS_LIFETIME_BOUND {
        return view(detail::InPlace{});
    }
    [[nodiscard]] PiecewiseConstant2DView<T> view(auto&& place) const {
        return PiecewiseConstant2DView<T>{*this, place};
    }
};

template <detail::Spannable R>
PiecewiseConstant1D(const R&) -> PiecewiseConstant1D<detail::ElementOf<R>>;
template <std::integral W, std::integral H, detail::Spannable R, class ForEachRow = detail::InOrder>
PiecewiseConstant2D(W, H, const R&, const ForEachRow& = {}) -> PiecewiseConstant2D<detail::ElementOf<R>>;

}  // namespace lumis::LUMIS_ISA
