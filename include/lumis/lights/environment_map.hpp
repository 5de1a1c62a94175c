// Directions in proportion to the luminance of a latitude-longitude environment map. World space, density per solid
// angle, distance infinite. Row 0 is at +y: v = acos(y) / pi, u = 1/2 + atan2(z, x) / (2 pi).
//
// A row is drawn, then a texel in it, then a point of the texel, evenly by solid angle: cos(theta) is uniform between
// the row's two edges. The density is therefore constant over a texel, P(texel) / solid_angle(texel); no 1 / sin(theta)
// occurs, not even at the poles; and P(texel) is a product of whole counts, so it is the frequency really drawn.
#pragma once

#include "lumis/core/detail/spannable.hpp"
#include "lumis/core/latlong.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/lights/detail/bilinear_means.hpp"
#include "lumis/tables/detail/alias_rows.hpp"
#include "lumis/tables/detail/arrays.hpp"
#include "lumis/tables/detail/count_grid.hpp"
#include "lumis/tables/detail/cumulative_counts.hpp"
#include "lumis/tables/detail/guided_rows.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace lumis::LUMIS_ISA {

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

// A sample of a map with where on the map it is.
template <class Point, Real Scalar>
struct MapSample {
    Point value{};
    Scalar pdf{};
    Scalar distance{};
    glm::vec<2, Scalar> uv{};
};

namespace detail {

// What a map keeps of each row. Heights are versines, 1 - |cos(theta)| from the nearer pole: there 1 - cos of a 4K map's
// first row is but five units in the last place of 1 in float.
template <std::floating_point T>
struct MapRow {
    T versine;           // at the edge towards the nearer pole
    T extent;            // to the other edge
    T from_bottom;       // 1 if the nearer pole is -y; else 0
    T density_of_count;  // density of a texel with a single count; 0 if nothing is drawn
};

}  // namespace detail

// What environment maps and their views share. Rows is the kind of table within a row; for Array, see arrays.hpp.
template <std::floating_point T, template <class, template <class> class> class Rows, template <class> class Array>
class BasicEnvironmentMap {
    using Row = detail::MapRow<T>;

  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    [[nodiscard]] LUMIS_HD std::size_t width() const noexcept { return grid_.columns(); }
    [[nodiscard]] LUMIS_HD std::size_t height() const noexcept { return grid_.rows(); }
    [[nodiscard]] std::size_t memory_bytes() const noexcept requires detail::Owns<Array> {
        return grid_.memory_bytes() + rows_.size() * sizeof(Row);
    }

    // True if no texel has any luminance, or if there are none: then nothing is drawn, and the density is 0.
    [[nodiscard]] LUMIS_HD bool empty() const noexcept { return grid_.empty(); }

    // A drawn point of the map as direction_from_latlong takes it.
    template <RealOf<T> R>
    struct Drawn {
        R turn;     // u of the map
        R versine;  // 1 - |cos(theta)|
        R pole;     // the nearer one, from which the versine counts: 1 for +y, -1 for -y
        R pdf;
    };

    // The part of sampling that reads the tables: u.y draws the row, u.x the texel within it. As many of a float's 2^24
    // uniforms draw a texel as it has counts. Each yields another position along the axis, in the middle of one of as many
    // equal parts: 2048 for an average texel in a row of 8192, which is as fine as a float's direction.
    [[nodiscard]] LUMIS_INLINE Drawn<T> draw(glm::vec<2, T> u) const noexcept {
        const auto texel = grid_.draw(u);
        const Row& row = rows_[texel.row];
        return {(static_cast<T>(texel.column) + texel.position.x) * turn_of_texel_,
                row.versine + row.extent * std::abs(row.from_bottom - texel.position.y), 1 - 2 * row.from_bottom,
                static_cast<T>(texel.counts) * row.density_of_count};
    }

    // Tables are read lane by lane.
    template <Real R>
        requires(!std::same_as<R, T>)
    [[nodiscard]] LUMIS_HD Drawn<R> draw(glm::vec<2, R> u) const noexcept {
        std::array<Drawn<T>, R::size> drawn;
        for (std::size_t i = 0; i < R::size; ++i) drawn[i] = draw(glm::vec<2, T>{u.x[i], u.y[i]});
        return {R::of_lanes([&](auto i) { return drawn[i].turn; }),
                R::of_lanes([&](auto i) { return drawn[i].versine; }),
                R::of_lanes([&](auto i) { return drawn[i].pole; }), R::of_lanes([&](auto i) { return drawn[i].pdf; })};
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD LightSample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        const Drawn<R> drawn = draw(u);
        return {direction_from_latlong(drawn.turn, drawn.versine, drawn.pole), drawn.pdf,
                std::numeric_limits<T>::infinity()};
    }

    // The same with the point (u, v) of the map that was drawn, for a host that looks the radiance up there: an arc tangent
    // less than latlong_from_direction(value). It lies in the texel drawn, whose density pdf_at(uv) is.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD MapSample<Direction<R>, R> sample_uv(glm::vec<2, R> u) const noexcept {
        const Drawn<R> drawn = draw(u);
        // Twice the fraction of a turn between the direction and +y.
        const R v = 2 * signed_turn_of(R(drawn.pole * (1 - drawn.versine)), sine_of_versine(drawn.versine));
        return {direction_from_latlong(drawn.turn, drawn.versine, drawn.pole),
                drawn.pdf,
                std::numeric_limits<T>::infinity(),
                {drawn.turn, v}};
    }

    // Forced inline so that w stays in registers: loaded from where it has just been stored, it would delay every look-up,
    // see core/real.hpp.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE R pdf(const Direction<R>& w) const noexcept {
        return pdf_at(latlong_from_direction(w));
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R distance_along(const Direction<R>& /*w*/) const noexcept {
        return std::numeric_limits<T>::infinity();
    }

    // The density at a point (u, v) of the map, for hosts that have it from their own look-up of the radiance.
    // 0 for a NaN.
    [[nodiscard]] LUMIS_HD T pdf_at(glm::vec<2, T> uv) const noexcept {
        if (!(uv.x >= 0 && uv.y >= 0)) return 0;
        const auto texel = grid_.locate(uv);
        return static_cast<T>(grid_.cell_counts(texel.column, texel.row)) * rows_[texel.row].density_of_count;
    }
    template <Real R>
        requires(!std::same_as<R, T>)
    [[nodiscard]] LUMIS_HD R pdf_at(const glm::vec<2, R>& uv) const noexcept {
        // All addresses before the first look-up, which takes the longest: in large tables half of the time.
        const auto texels = grid_.locate_lanes(uv);
        const R density = R::of_lanes([&](auto i) {
            return static_cast<T>(grid_.cell_counts(texels.column[i], texels.row[i])) *
                   rows_[texels.row[i]].density_of_count;
        });
        return real::select(uv.x >= T(0) && uv.y >= T(0), density, T(0));
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& w) const noexcept requires
        requires(const detail::CountGrid<T, Rows, Array>& grid) {
        grid.invert({});
    }
    {
        auto texel = grid_.locate(latlong_from_direction(w));
        const Row& row = rows_[texel.row];
        const T pole = 1 - 2 * row.from_bottom;
        const T from_edge = real::divide(versine_of(Point{w.x, w.z, pole * w.y}) - row.versine, row.extent);
        texel.position.y = std::abs(row.from_bottom - from_edge);
        return grid_.invert(texel);
    }

  protected:
    BasicEnvironmentMap() requires detail::Owns<Array>
        : BasicEnvironmentMap{1, 1, std::span<const double>{detail::no_weight}, {}, detail::InOrder{}} {
        grid_.tell_no_size();
    }

    template <class Luminance>
    BasicEnvironmentMap(std::integral auto width, std::integral auto height, std::span<const Luminance> luminance,
                        EnvironmentOptions options, const auto& for_each_row)
        : grid_{width, height, luminance.size()} {
        detail::require_weights(luminance, this->width(), for_each_row);
        const auto weights_of = [&](std::size_t y, std::span<double> weights) {
            mean_luminance(luminance, y, options.interpolation, weights);
        };
        const double excess = options.mis_compensation ? compensation(weights_of, for_each_row) : 0.0;
        const auto compensated = [&](std::size_t y, std::span<double> weights) {
            weights_of(y, weights);
            for (double& weight : weights) weight = real::greater(weight - excess, 0.0);
        };
        grid_.deal(
            compensated, [&](std::size_t y) { return row_extent(y); }, for_each_row);
        rows_.reserve(this->height());
        for (std::size_t y = 0; y < this->height(); ++y) rows_.push_back(row(y));
    }

    BasicEnvironmentMap(const BasicEnvironmentMap<T, Rows, detail::Owned>& owner, auto& place)
        : grid_{owner.grid_, place}, rows_{detail::viewed(owner.rows_, place)}, turn_of_texel_{owner.turn_of_texel_} {}

  private:
    template <std::floating_point, template <class, template <class> class> class, template <class> class>
    friend class BasicEnvironmentMap;

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
        const double probability = empty() ? 0.0 : grid_.row_counts(y) / double{detail::total_counts<T>};
        const double texel_solid_angle = 2 * std::numbers::pi / static_cast<double>(width()) * row_extent(y);
        return {static_cast<T>(2 * sine * sine), static_cast<T>(row_extent(y)), from_top ? T(0) : T(1),
                static_cast<T>(probability / (double{detail::total_counts<T>} * texel_solid_angle))};
    }

    // What MIS compensation takes off every texel: the mean over the sphere; nothing where no texel stands out of it.
    [[nodiscard]] double compensation(const auto& weights_of, const auto& for_each_row) const {
        std::vector<double> sums(height()), largest(height());
        for_each_row(height(), [&](std::size_t y) {
            std::vector<double> weights(width());
            weights_of(y, std::span<double>{weights});
            sums[y] = std::reduce(weights.begin(), weights.end());
            largest[y] = real::largest_of(weights);
        });
        double sum = 0;
        for (std::size_t y = 0; y < height(); ++y) sum += sums[y] * row_extent(y);
        const double mean = sum / (2 * static_cast<double>(width()));  // the rows' extents sum to 2
        return real::largest_of(largest) > (1 + 1e-6) * mean ? mean : 0.0;
    }

    // Sets means[x] to the mean of the interpolated luminance over texel x of row y.
    void mean_luminance(auto luminance, std::size_t y, Interpolation interpolation,
                        std::span<double> means) const noexcept {
        if (interpolation == Interpolation::Bilinear)
            return detail::bilinear_means(luminance, width(), y, detail::AcrossEdges::Wrap, means);
        for (std::size_t x = 0; x < width(); ++x) means[x] = static_cast<double>(luminance[y * width() + x]);
    }

    detail::CountGrid<T, Rows, Array> grid_;
    Array<Row> rows_;
    T turn_of_texel_ = 1 / static_cast<T>(grid_.width());
};

template <std::floating_point T>
class EnvironmentMap;
template <std::floating_point T>
class AliasEnvironmentMap;

// A map's way to draw, without its memory: made by EnvironmentMap::view, trivially copyable.
template <std::floating_point T = float>
class EnvironmentMapView : public BasicEnvironmentMap<T, detail::GuidedRows, detail::Viewed> {
    friend class EnvironmentMap<T>;
    using BasicEnvironmentMap<T, detail::GuidedRows, detail::Viewed>::BasicEnvironmentMap;
};
template <std::floating_point T = float>
class AliasEnvironmentMapView : public BasicEnvironmentMap<T, detail::AliasRows, detail::Viewed> {
    friend class AliasEnvironmentMap<T>;
    using BasicEnvironmentMap<T, detail::AliasRows, detail::Viewed>::BasicEnvironmentMap;
};

// Monotone in u.x, so that stratified uniforms stay stratified, and invertible: the one to take unless measured otherwise.
template <std::floating_point T = float>
class EnvironmentMap : public BasicEnvironmentMap<T, detail::GuidedRows, detail::Owned> {
    using Base = BasicEnvironmentMap<T, detail::GuidedRows, detail::Owned>;

  public:
    // No texels; another map may be assigned.
    EnvironmentMap() = default;

    // luminance: width x height values, row by row from +y. Throws std::invalid_argument for a size of 0, a size that
    // does not match, and a texel that is NaN, infinite or negative. All-zero luminance is legal, see empty().
    // for_each_row: the host's own way to run the rows, on threads perhaps, see detail::InOrder.
    // Keeps 6 bytes a texel, and 28 more a row.
    template <class ForEachRow = detail::InOrder>
    EnvironmentMap(std::integral auto width, std::integral auto height, std::span<const T> luminance,
                   EnvironmentOptions options = {}, const ForEachRow& for_each_row = {})
        : Base{width, height, luminance, options, for_each_row} {}

    // Luminance of another type counts as it is.
    template <detail::RangeOfOther<T> R, class ForEachRow = detail::InOrder>
    EnvironmentMap(std::integral auto width, std::integral auto height, const R& luminance,
                   EnvironmentOptions options = {}, const ForEachRow& for_each_row = {})
        : Base{width, height, detail::span_of(luminance), options, for_each_row} {}

    // Views of the map, and of a copy that place makes of its arrays, see alias_table.hpp.
    [[nodiscard]] EnvironmentMapView<T> view() const noexcept LUMIS_LIFETIME_BOUND { return view(detail::InPlace{}); }
    [[nodiscard]] EnvironmentMapView<T> view(auto&& place) const { return EnvironmentMapView<T>{*this, place}; }
};

// Draws and evaluates a little faster in large maps, but takes neighbouring u.x to texels far apart in a row, which slows the
// convergence of low-discrepancy points (docs/guide.md), and has no inverse.
template <std::floating_point T = float>
class AliasEnvironmentMap : public BasicEnvironmentMap<T, detail::AliasRows, detail::Owned> {
    using Base = BasicEnvironmentMap<T, detail::AliasRows, detail::Owned>;

  public:
    // No texels; another map may be assigned.
    AliasEnvironmentMap() = default;

    // As EnvironmentMap's. Keeps 8 bytes a texel, and 28 more a row.
    template <class ForEachRow = detail::InOrder>
    AliasEnvironmentMap(std::integral auto width, std::integral auto height, std::span<const T> luminance,
                        EnvironmentOptions options = {}, const ForEachRow& for_each_row = {})
        : Base{width, height, luminance, options, for_each_row} {}
    template <detail::RangeOfOther<T> R, class ForEachRow = detail::InOrder>
    AliasEnvironmentMap(std::integral auto width, std::integral auto height, const R& luminance,
                        EnvironmentOptions options = {}, const ForEachRow& for_each_row = {})
        : Base{width, height, detail::span_of(luminance), options, for_each_row} {}

    [[nodiscard]] AliasEnvironmentMapView<T> view() const noexcept LUMIS_LIFETIME_BOUND {
        return view(detail::InPlace{});
    }
    [[nodiscard]] AliasEnvironmentMapView<T> view(auto&& place) const {
        return AliasEnvironmentMapView<T>{*this, place};
    }
};

template <std::integral W, std::integral H, detail::Spannable R, class ForEachRow = detail::InOrder>
EnvironmentMap(W, H, const R&, EnvironmentOptions = {}, const ForEachRow& = {}) -> EnvironmentMap<detail::ElementOf<R>>;
template <std::integral W, std::integral H, detail::Spannable R, class ForEachRow = detail::InOrder>
AliasEnvironmentMap(W, H, const R&, EnvironmentOptions = {}, const ForEachRow& = {})
    -> AliasEnvironmentMap<detail::ElementOf<R>>;

}  // namespace lumis::LUMIS_ISA
