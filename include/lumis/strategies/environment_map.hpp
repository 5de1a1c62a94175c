// Directions in proportion to the luminance of a latitude-longitude environment map. World space, density per solid
// angle, distance infinite. Row 0 is at +y: v = acos(y) / pi, u = 1/2 + atan2(z, x) / (2 pi).
//
// A row is drawn, then a texel in it, then a point of the texel, evenly by solid angle: cos(theta) is uniform between
// the row's two edges. The density is therefore constant over a texel, P(texel) / solid_angle(texel); no 1 / sin(theta)
// occurs, at the poles either; and P(texel) is a product of whole counts, so it is the frequency really drawn.
#pragma once

#include "lumis/core/latlong.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/strategies/count_grid.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace lumis {

// How the host looks radiance up. Bilinear spreads a texel's light over its neighbours: texel centres lie at half
// integers, u wraps around, v is clamped.
enum class Interpolation { Nearest, Bilinear };

struct EnvironmentOptions {
    Interpolation interpolation = Interpolation::Nearest;

    // Takes the mean luminance off every texel, so that the density goes where BSDF sampling does not do well enough
    // (Karlik et al. 2019, "MIS Compensation", eq. 14). Texels below the mean are then left to the BSDF's technique:
    // only for combinations that have one. A map without contrast stays as it is.
    bool mis_compensation = false;
};

template <std::floating_point T = float>
class EnvironmentMap {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    // luminance: width x height values, row by row from +y. Throws std::invalid_argument for a size of 0, a size that
    // does not match, and a texel that is NaN, infinite or negative. All-zero luminance is legal, see empty().
    // Keeps 4 bytes a texel.
    EnvironmentMap(std::integral auto width, std::integral auto height, std::span<const T> luminance,
                   EnvironmentOptions options = {})
        : grid_{width, height, luminance.size()} {
        require_weights(luminance);
        const auto weight = [&](std::size_t x, std::size_t y) {
            return mean_luminance(luminance, x, y, options.interpolation);
        };
        const double excess = options.mis_compensation ? compensation(weight) : 0.0;
        grid_.deal([&](std::size_t x, std::size_t y) { return std::max(weight(x, y) - excess, 0.0); },
                   [&](std::size_t y) { return row_extent(y); });
        for (std::size_t y = 0; y < grid_.height(); ++y) rows_.push_back(row(y));
    }

    [[nodiscard]] std::size_t width() const noexcept { return grid_.width(); }
    [[nodiscard]] std::size_t height() const noexcept { return grid_.height(); }

    // True if no texel has any luminance: then nothing is drawn, and the density is 0.
    [[nodiscard]] bool empty() const noexcept { return grid_.empty(); }

    // u.y draws the row, u.x the texel within it.
    [[nodiscard]] LightSample<Point, T> sample(glm::vec<2, T> u) const noexcept {
        if (empty()) return {};
        const auto drawn = grid_.draw(u);
        const Row& row = rows_[drawn.row];
        const T versine = row.versine + row.extent * (row.from_top ? drawn.position.y : 1 - drawn.position.y);
        const T turn = (static_cast<T>(drawn.column) + drawn.position.x) / static_cast<T>(width());
        return {direction_from_latlong(turn, versine, row.from_top), density(drawn.column, drawn.row),
                std::numeric_limits<T>::infinity()};
    }

    [[nodiscard]] T pdf(const Point& w) const noexcept {
        const auto uv = latlong_from_direction(w);
        if (empty() || !(uv.x >= 0 && uv.y >= 0)) return T(0);
        const auto texel = grid_.locate(uv);
        return density(texel.column, texel.row);
    }

    [[nodiscard]] glm::vec<2, T> invert(const Point& w) const noexcept {
        auto texel = grid_.locate(latlong_from_direction(w));
        const Row& row = rows_[texel.row];
        const T down = (versine_of(Point{w.x, w.z, row.from_top ? w.y : -w.y}) - row.versine) / row.extent;
        texel.position.y = row.from_top ? down : 1 - down;
        return grid_.invert(texel);
    }

  private:
    // Heights are versines, 1 - |cos(theta)| from the nearer pole: there 1 - cos of a 4K map's first row is but five
    // units in the last place of 1 in float.
    struct Row {
        T versine;           // at the edge towards the nearer pole
        T extent;            // to the other edge
        T density_of_count;  // density of a texel with a single count
        bool from_top;       // the nearer pole is +y
    };

    [[nodiscard]] T density(std::size_t column, std::size_t row) const noexcept {
        return static_cast<T>(grid_.cell_counts(column, row)) * rows_[row].density_of_count;
    }

    // cos(theta) at a row's upper edge less that at its lower one; the difference itself would cancel.
    [[nodiscard]] double row_extent(std::size_t y) const noexcept {
        const double half_row = std::numbers::pi / 2 / static_cast<double>(height());
        return 2 * std::sin(half_row * static_cast<double>(2 * y + 1)) * std::sin(half_row);
    }

    [[nodiscard]] Row row(std::size_t y) const noexcept {
        const bool from_top = 2 * y < height();
        const std::size_t rows_to_pole = from_top ? y : height() - 1 - y;
        const double sine =
            std::sin(std::numbers::pi / 2 * static_cast<double>(rows_to_pole) / static_cast<double>(height()));
        const double probability = grid_.row_counts(y) / double{total_counts<T>};
        const double texel_solid_angle = 2 * std::numbers::pi / static_cast<double>(width()) * row_extent(y);
        return {static_cast<T>(2 * sine * sine), static_cast<T>(row_extent(y)),
                static_cast<T>(probability / (double{total_counts<T>} * texel_solid_angle)), from_top};
    }

    // What MIS compensation takes off every texel: the mean over the sphere; nothing where no texel stands out of it.
    [[nodiscard]] double compensation(auto weight) const {
        double sum = 0, largest = 0;
        for (std::size_t y = 0; y < height(); ++y) {
            for (std::size_t x = 0; x < width(); ++x) {
                sum += weight(x, y) * row_extent(y);
                largest = std::max(largest, weight(x, y));
            }
        }
        const double mean = sum / (2 * static_cast<double>(width()));  // the rows' extents sum to 2
        return largest > (1 + 1e-6) * mean ? mean : 0.0;
    }

    // Of the interpolated luminance over a texel. A bilinear function's mean over one cell weighs the cell's own value
    // by 3/4 and its two neighbours by 1/8 in either direction: it is 0 only where the function is.
    [[nodiscard]] double mean_luminance(std::span<const T> luminance, std::size_t x, std::size_t y,
                                        Interpolation interpolation) const noexcept {
        const auto texel = [&](std::size_t column, std::size_t row) {
            return double{luminance[row * width() + column]};
        };
        if (interpolation == Interpolation::Nearest) return texel(x, y);
        const std::size_t left = x > 0 ? x - 1 : width() - 1, right = x + 1 < width() ? x + 1 : 0;
        const std::size_t above = y > 0 ? y - 1 : 0, below = std::min(y + 1, height() - 1);
        const auto across = [&](std::size_t row) {
            return 0.125 * texel(left, row) + 0.75 * texel(x, row) + 0.125 * texel(right, row);
        };
        return 0.125 * across(above) + 0.75 * across(y) + 0.125 * across(below);
    }

    CountGrid<T> grid_;
    std::vector<Row> rows_;
};

template <std::integral W, std::integral H, std::ranges::contiguous_range R>
EnvironmentMap(W, H, const R&, EnvironmentOptions = {})
    -> EnvironmentMap<std::remove_cv_t<std::ranges::range_value_t<R>>>;

}  // namespace lumis
