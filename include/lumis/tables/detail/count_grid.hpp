// A grid of cells of [0,1]^2 drawn in proportion to weights: a row first, then a cell in it, both in fixed point (see
// cumulative_counts.hpp). What the environment map and PiecewiseConstant2D are made of. Rows, the kind of the tables
// within rows, is GuidedRows or AliasRows; the row itself is always drawn by a guided table. Array: see arrays.hpp.
#pragma once

#include "lumis/core/detail/vectors.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/throw.hpp"
#include "lumis/tables/detail/arrays.hpp"
#include "lumis/tables/detail/cumulative_counts.hpp"
#include "lumis/tables/detail/guided_rows.hpp"

#include <glm/vec2.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lumis::LUMIS_ISA::detail {

template <std::floating_point T, template <class, template <class> class> class Rows = GuidedRows,
          template <class> class Array = Owned>
class CountGrid {
  public:
    // A drawn cell, its counts within its row, and where in it, in units of the cell.
    struct Drawn {
        std::size_t column, row;
        std::uint32_t counts;
        glm::vec<2, T> position;
    };

    // A point of [0, 1]^2 as the cell that holds it, and where in it.
    struct Located {
        std::size_t column, row;
        glm::vec<2, T> position;
    };

    // A grid yet to be dealt. Throws std::invalid_argument for a size of 0 or beyond the number of counts, and if `values`, the
    // number of weights that there are, is not width x height.
    CountGrid(std::integral auto width, std::integral auto height, std::size_t values)
        : width_{checked(width, "width")},
          height_{checked(height, "height", width_, values)},
          rows_{height_, 1},
          cells_{width_, height_} {}

    // A view of the owner's arrays where place puts them, see viewed.
    CountGrid(const CountGrid<T, Rows, Owned>& owner, auto& place)
        : width_{owner.width_},
          height_{owner.height_},
          empty_{owner.empty_},
          tells_size_{owner.tells_size_},
          rows_{owner.rows_, place},
          cells_{owner.cells_, place} {}

    // weights_of(row, weights) sets the weights of a row's cells, finite and not negative. scale(row), at most 4, is what a
    // row's sum of weights is multiplied by. for_each_row runs the rows, see InOrder. Throws if counts are too few for the weights, see
    // require_enough_counts.
    void deal(auto weights_of, auto scale, const auto& for_each_row) {
        std::vector<Dealt> sums(height_);
        for_each_row(height_, [&](std::size_t row) {
            std::vector<double> weights(width_);
            weights_of(row, std::span<double>{weights});
            sums[row] = cells_.deal(row, weights);
        });
        empty_ = true;
        int exponent = (std::numeric_limits<int>::min)();
        for (const Dealt& sum : sums) {
            require_enough_counts<T>(sum);
            empty_ = empty_ && !(sum.value > 0);
            exponent = sum.exponent > exponent ? sum.exponent : exponent;
        }
        // In units of the brightest row, or four of them: so a scale of up to 4 overflows nothing. A row that would vanish
        // beside it keeps the least weight that there is.
        constexpr double least = std::numeric_limits<double>::denorm_min();
        std::vector<double> weights(height_);
        for (std::size_t row = 0; row < height_; ++row) {
            if (sums[row].value > 0)
                weights[row] = real::greater(scale(row) * sums[row].relative_to(exponent + 2), least);
        }
        require_enough_counts<T>(rows_.deal(0, weights));
    }

    [[nodiscard]] LUMIS_HD std::size_t width() const noexcept { return width_; }
    [[nodiscard]] LUMIS_HD std::size_t height() const noexcept { return height_; }
    [[nodiscard]] LUMIS_HD bool empty() const noexcept { return empty_; }

    // The size that is told to the world: 0 x 0 of a default-constructed table, see no_weight.
    [[nodiscard]] LUMIS_HD std::size_t columns() const noexcept { return tells_size_ ? width_ : 0; }
    [[nodiscard]] LUMIS_HD std::size_t rows() const noexcept { return tells_size_ ? height_ : 0; }
    void tell_no_size() noexcept { tells_size_ = false; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return rows_.memory_bytes() + cells_.memory_bytes(); }

    // u.y draws the row, u.x the cell within it. The position stays a few units in the last place clear of the cell's edges:
    // a point rounded across one would be given the density of one cell and belong to another. An empty grid draws its
    // last cell.
    [[nodiscard]] LUMIS_HD Drawn draw(glm::vec<2, T> u) const noexcept {
        const auto row = rows_.draw(0, u.y);
        const auto column = cells_.draw(row.index, u.x);
        return {column.index,
                row.index,
                column.counts,
                {clear_of_edges(column.position, width_), clear_of_edges(row.position, height_)}};
    }

    // The u that draws a point.
    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Located& point) const noexcept requires
        requires(const Rows<T, Array>& rows) {
        rows.uniform_of(0, 0, T(0));
    }
    {
        return {cells_.uniform_of(point.row, point.column, point.position.x),
                rows_.uniform_of(0, point.row, point.position.y)};
    }

    // The probability of a row, and of a cell given its row, in counts.
    [[nodiscard]] LUMIS_HD std::uint32_t row_counts(std::size_t row) const noexcept { return rows_.counts(0, row); }
    [[nodiscard]] LUMIS_HD std::uint32_t cell_counts(std::size_t column, std::size_t row) const noexcept {
        return cells_.counts(row, column);
    }

    [[nodiscard]] LUMIS_HD Located locate(glm::vec<2, T> x) const noexcept {
        const std::size_t column = index_of(x.x, width_), row = index_of(x.y, height_);
        return {column,
                row,
                {x.x * static_cast<T>(width_) - static_cast<T>(column),
                 x.y * static_cast<T>(height_) - static_cast<T>(row)}};
    }

    // The cells that hold the points of all lanes.
    template <std::size_t N>
    struct LocatedLanes {
        std::array<std::uint32_t, N> column, row;
    };
    template <class R>
    [[nodiscard]] LUMIS_INLINE LocatedLanes<R::size> locate_lanes(const glm::vec<2, R>& x) const noexcept {
        return {indices_of(x.x, width_), indices_of(x.y, height_)};
    }

  private:
    template <std::floating_point, template <class, template <class> class> class, template <class> class>
    friend class CountGrid;

    // As index_of.
    template <class R>
    [[nodiscard]] LUMIS_INLINE static std::array<std::uint32_t, R::size> indices_of(R x, std::size_t n) noexcept {
        const R scaled = x * static_cast<T>(n);
        const R index = real::select(scaled > T(0), real::lesser(scaled, static_cast<T>(n - 1)), T(0));
        const auto whole = converted_lanes<std::int32_t, T, R::size>(index.vector());
        std::array<std::uint32_t, R::size> result;
        std::memcpy(result.data(), &whole, sizeof result);
        return result;
    }

    static std::size_t checked(std::integral auto extent, const char* name) {
        if (extent <= 0 || std::cmp_greater(extent, total_counts<T>)) {
            refuse(std::string("lumis: a grid's ") + name + " is " + std::to_string(extent) +
                   "; it must be from 1 to " + std::to_string(total_counts<T>));
        }
        return static_cast<std::size_t>(extent);
    }

    static std::size_t checked(std::integral auto extent, const char* name, std::size_t width, std::size_t values) {
        const std::size_t height = checked(extent, name);
        if (values != std::uint64_t{width} * height) {  // a std::size_t of 32 bits may be too small for the product
            refuse("lumis: a grid of " + std::to_string(width) + " x " + std::to_string(height) + " got " +
                   std::to_string(values) + " values");
        }
        return height;
    }

    std::size_t width_, height_;
    bool empty_ = true, tells_size_ = true;
    GuidedRows<T, Array> rows_;  // one table of all rows
    Rows<T, Array> cells_;       // a table of each row's cells
};

}  // namespace lumis::LUMIS_ISA::detail
