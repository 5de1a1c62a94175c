// Directions in proportion to the luminance of a latitude-longitude environment map. World space, density per solid
// angle, distance infinite. Row 0 is at +y: v = acos(y) / pi, u = 1/2 + atan2(z, x) / (2 pi).
//
// A row is drawn, then a texel in it, then a point of the texel, evenly by solid angle: cos(theta) is uniform between
// the row's two edges. The density is therefore constant over a texel, P(texel) / solid_angle(texel); no 1 / sin(theta)
// occurs, at the poles either; and P(texel) is a product of whole counts, so it is the frequency really drawn.
#pragma once

#include "lumis/core/latlong.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/strategies/cumulative_counts.hpp"

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
        : width_{size(width, "width")}, height_{size(height, "height")} {
        if (luminance.size() != width_ * height_) {
            throw std::invalid_argument("lumis: environment map of " + std::to_string(width_) + " x " +
                                        std::to_string(height_) + " got " + std::to_string(luminance.size()) +
                                        " values");
        }
        require_weights(luminance);
        build(luminance, options);
    }

    [[nodiscard]] std::size_t width() const noexcept { return width_; }
    [[nodiscard]] std::size_t height() const noexcept { return height_; }

    // True if no texel has any luminance: then nothing is drawn, and the density is 0.
    [[nodiscard]] bool empty() const noexcept { return empty_; }

    // u.y draws the row, u.x the texel within it.
    [[nodiscard]] LightSample<Point, T> sample(glm::vec<2, T> u) const noexcept {
        if (empty_) return {};
        const auto drawn_row = draw_entry<T>(row_starts_, u.y);
        const auto drawn_texel = draw_entry<T>(texel_starts(drawn_row.index), u.x);
        const Row& row = rows_[drawn_row.index];
        const T down = clear_of_edges(drawn_row.position, row_margin_);
        const T versine = row.versine + row.extent * (row.from_top ? down : 1 - down);
        const T across = clear_of_edges(drawn_texel.position, texel_margin_);
        const T turn = (static_cast<T>(drawn_texel.index) + across) / static_cast<T>(width_);
        return {direction_from_latlong(turn, versine, row.from_top), density(row, drawn_texel.counts),
                std::numeric_limits<T>::infinity()};
    }

    [[nodiscard]] T pdf(const Point& w) const noexcept {
        const auto uv = latlong_from_direction(w);
        if (empty_ || !(uv.x >= 0 && uv.y >= 0)) return T(0);
        const std::size_t row = cell(uv.y, height_), column = cell(uv.x, width_);
        return density(rows_[row], counts_of<T>(texel_starts(row), column));
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

    static std::size_t size(std::integral auto extent, const char* name) {
        if (extent <= 0 || std::cmp_greater(extent, total_counts<T>)) {
            throw std::invalid_argument(std::string("lumis: environment map ") + name + " is " +
                                        std::to_string(extent) + "; it must be from 1 to " +
                                        std::to_string(total_counts<T>));
        }
        return static_cast<std::size_t>(extent);
    }

    // The cell of [0, 1] divided into n that holds x.
    static std::size_t cell(T x, std::size_t n) noexcept {
        return std::min(static_cast<std::size_t>(x * static_cast<T>(n)), n - 1);
    }

    // Keeps a sample a few units in the last place inside its texel: rounded across the edge, it would meet the
    // radiance of one texel with the density of another.
    static T clear_of_edges(T position, T margin) noexcept { return std::clamp(position, margin, 1 - margin); }
    static T margin(std::size_t n) noexcept {
        return std::min(8 * std::numeric_limits<T>::epsilon() * static_cast<T>(n), T(0.5));
    }

    [[nodiscard]] std::span<const std::uint32_t> texel_starts(std::size_t row) const noexcept {
        return {texel_starts_.data() + row * width_, width_};
    }

    static T density(const Row& row, std::uint32_t counts) noexcept {
        return static_cast<T>(counts) * row.density_of_count;
    }

    // cos(theta) at a row's upper edge less that at its lower one; the difference itself would cancel.
    [[nodiscard]] double row_extent(std::size_t y) const noexcept {
        const double half_row = std::numbers::pi / 2 / static_cast<double>(height_);
        return 2 * std::sin(half_row * static_cast<double>(2 * y + 1)) * std::sin(half_row);
    }

    [[nodiscard]] Row row(std::size_t y) const noexcept {
        const bool from_top = 2 * y < height_;
        const std::size_t rows_to_pole = from_top ? y : height_ - 1 - y;
        const double sine =
            std::sin(std::numbers::pi / 2 * static_cast<double>(rows_to_pole) / static_cast<double>(height_));
        const double probability = counts_of<T>(row_starts_, y) / double{total_counts<T>};
        const double texel_solid_angle = 2 * std::numbers::pi / static_cast<double>(width_) * row_extent(y);
        return {static_cast<T>(2 * sine * sine), static_cast<T>(row_extent(y)),
                static_cast<T>(probability / (double{total_counts<T>} * texel_solid_angle)), from_top};
    }

    void build(std::span<const T> luminance, EnvironmentOptions options) {
        texel_starts_.resize(width_ * height_);
        row_starts_.resize(height_);
        std::vector<double> row_weights(height_), weights(width_);
        for (std::size_t y = 0; y < height_; ++y) {
            for (std::size_t x = 0; x < width_; ++x)
                weights[x] = mean_luminance(luminance, x, y, options.interpolation);
            row_weights[y] = row_extent(y) * deal_counts<T>(weights, {texel_starts_.data() + y * width_, width_});
        }
        empty_ = !(deal_counts<T>(row_weights, row_starts_) > 0);
        for (std::size_t y = 0; y < height_; ++y) rows_.push_back(row(y));
    }

    // Of the interpolated luminance over a texel. A bilinear function's mean over one cell weighs the cell's own value
    // by 3/4 and its two neighbours by 1/8 in either direction: it is 0 only where the function is.
    [[nodiscard]] double mean_luminance(std::span<const T> luminance, std::size_t x, std::size_t y,
                                        Interpolation interpolation) const noexcept {
        const auto texel = [&](std::size_t column, std::size_t row) {
            return double{luminance[row * width_ + column]};
        };
        if (interpolation == Interpolation::Nearest) return texel(x, y);
        const std::size_t left = x > 0 ? x - 1 : width_ - 1, right = x + 1 < width_ ? x + 1 : 0;
        const std::size_t above = y > 0 ? y - 1 : 0, below = std::min(y + 1, height_ - 1);
        const auto across = [&](std::size_t row) {
            return 0.125 * texel(left, row) + 0.75 * texel(x, row) + 0.125 * texel(right, row);
        };
        return 0.125 * across(above) + 0.75 * across(y) + 0.125 * across(below);
    }

    std::size_t width_, height_;
    bool empty_{};
    T texel_margin_{margin(width_)}, row_margin_{margin(height_)};
    std::vector<Row> rows_;
    std::vector<std::uint32_t> row_starts_;    // counts before each row
    std::vector<std::uint32_t> texel_starts_;  // within each row, counts before each texel
};

template <std::integral W, std::integral H, std::ranges::contiguous_range R, class... Options>
EnvironmentMap(W, H, const R&, Options...) -> EnvironmentMap<std::remove_cv_t<std::ranges::range_value_t<R>>>;

}  // namespace lumis
