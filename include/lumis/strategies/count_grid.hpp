// A grid of cells of [0,1]^2 drawn in proportion to weights: a row first, then a cell in it, both in fixed point (see
// cumulative_counts.hpp). What the environment map and PiecewiseConstant2D are made of.
#pragma once

#include "lumis/strategies/cumulative_counts.hpp"

#include <glm/vec2.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace lumis {

template <std::floating_point T>
class CountGrid {
  public:
    // A drawn cell, and where in it, in units of the cell.
    struct Drawn {
        std::size_t column, row;
        glm::vec<2, T> position;
    };

    // An empty grid. Throws std::invalid_argument for a size of 0 or beyond the number of counts, and if `values`, the
    // number of weights that there are, is not width x height.
    CountGrid(std::integral auto width, std::integral auto height, std::size_t values)
        : width_{checked(width, "width")}, height_{checked(height, "height")} {
        if (values != width_ * height_) {
            throw std::invalid_argument("lumis: a grid of " + std::to_string(width_) + " x " + std::to_string(height_) +
                                        " got " + std::to_string(values) + " values");
        }
        row_starts_.resize(height_);
        cell_starts_.resize(width_ * height_);
    }

    // weight(column, row): of a cell, finite and not negative. scale(row): what a row's sum of weights is multiplied by.
    void deal(auto weight, auto scale) {
        std::vector<double> weights(std::max(width_, height_));
        std::vector<ScaledSum> row_sums(height_);
        for (std::size_t row = 0; row < height_; ++row) {
            for (std::size_t column = 0; column < width_; ++column) weights[column] = weight(column, row);
            row_sums[row] = deal_counts<T>({weights.data(), width_}, {cell_starts_.data() + row * width_, width_});
        }
        const auto positive = [](const ScaledSum& sum) { return sum.value > 0; };
        empty_ = std::ranges::none_of(row_sums, positive);
        // In units of the brightest row; what would vanish beside it keeps the least weight that there is.
        const int exponent = std::ranges::max(row_sums, {}, &ScaledSum::exponent).exponent;
        for (std::size_t row = 0; row < height_; ++row) {
            weights[row] = positive(row_sums[row]) ? std::max(scale(row) * row_sums[row].relative_to(exponent),
                                                              std::numeric_limits<double>::denorm_min())
                                                   : 0.0;
        }
        deal_counts<T>({weights.data(), height_}, row_starts_);
    }

    [[nodiscard]] std::size_t width() const noexcept { return width_; }
    [[nodiscard]] std::size_t height() const noexcept { return height_; }
    [[nodiscard]] bool empty() const noexcept { return empty_; }

    // Not of an empty grid. Positions stay a few units in the last place clear of the cell's edges: a point rounded
    // across one would be given the density of one cell and belong to another.
    [[nodiscard]] Drawn draw(glm::vec<2, T> u) const noexcept {
        const auto row = draw_entry<T>(row_starts_, u.y);
        const auto column = draw_entry<T>(cells_of(row.index), u.x);
        return {
            column.index, row.index, {clear_of_edges(column.position, width_), clear_of_edges(row.position, height_)}};
    }

    // The u that draw a point, position in units of the cell.
    [[nodiscard]] glm::vec<2, T> invert(const Drawn& point) const noexcept {
        return {uniform_of<T>(cells_of(point.row), point.column, point.position.x),
                uniform_of<T>(row_starts_, point.row, point.position.y)};
    }

    // The probability of a row, and of a cell given its row, in counts.
    [[nodiscard]] std::uint32_t row_counts(std::size_t row) const noexcept { return counts_of<T>(row_starts_, row); }
    [[nodiscard]] std::uint32_t cell_counts(std::size_t column, std::size_t row) const noexcept {
        return counts_of<T>(cells_of(row), column);
    }

    // The cell that holds a point of [0, 1]^2, and where in it.
    [[nodiscard]] Drawn locate(glm::vec<2, T> x) const noexcept {
        const std::size_t column = index_of(x.x, width_), row = index_of(x.y, height_);
        return {column,
                row,
                {x.x * static_cast<T>(width_) - static_cast<T>(column),
                 x.y * static_cast<T>(height_) - static_cast<T>(row)}};
    }

  private:
    static std::size_t checked(std::integral auto extent, const char* name) {
        if (extent <= 0 || std::cmp_greater(extent, total_counts<T>)) {
            throw std::invalid_argument(std::string("lumis: a grid's ") + name + " is " + std::to_string(extent) +
                                        "; it must be from 1 to " + std::to_string(total_counts<T>));
        }
        return static_cast<std::size_t>(extent);
    }

    [[nodiscard]] std::span<const std::uint32_t> cells_of(std::size_t row) const noexcept {
        return {cell_starts_.data() + row * width_, width_};
    }

    std::size_t width_, height_;
    bool empty_ = true;
    std::vector<std::uint32_t> row_starts_;   // counts before each row
    std::vector<std::uint32_t> cell_starts_;  // within each row, counts before each cell
};

}  // namespace lumis
