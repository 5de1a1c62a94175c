// A parallelogram that emits an image, a screen or a window: points of it in proportion to the image's luminance. World space,
// density per solid angle. The table of the image is built once, the light made anew at each point:
//
//     const PiecewiseConstant2D table{width, height, luminance};            // or of bilinear_means(width, height, luminance)
//     const ImageLight light{screen, table, point};
//     const auto s = light.sample(u);                                       // radiance(s.surface.uv), as the host looks it up
//
// Column x and row y of the image lie at u = (x + 1/2) / width along the first edge and v = (y + 1/2) / height along the second.
// An image whose first row is the top one stands upright on the shape {top left corner, edge to the right, edge down}.
#pragma once

#include "lumis/core/measure.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/surface_point.hpp"
#include "lumis/lights/detail/bilinear_means.hpp"
#include "lumis/lights/detail/flat_view.hpp"
#include "lumis/lights/shapes.hpp"
#include "lumis/tables/piecewise_constant.hpp"

#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

namespace lumis::LUMIS_ISA {

// The mean over each texel of what a host sees that looks the image up bilinearly, clamped at its edges, with texel centres at
// half integers. A table of these leaves no point out that the texels beside a dark one light up. Throws
// std::invalid_argument for what PiecewiseConstant2D does.
template <std::floating_point T>
[[nodiscard]] std::vector<T> bilinear_means(std::integral auto width, std::integral auto height,
                                            std::span<const T> luminance) {
    std::vector<T> means{luminance.begin(), luminance.end()};
    const auto columns = static_cast<std::size_t>(width);
    // A wrong size is for the table to refuse.
    if (!(width > 0 && height > 0 && luminance.size() == columns * static_cast<std::size_t>(height))) return means;
    detail::require_weights(luminance);
    std::vector<double> row(columns);
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
        detail::bilinear_means(luminance, columns, y, detail::AcrossEdges::Clamp, std::span<double>{row});
        for (std::size_t x = 0; x < columns; ++x) means[y * columns + x] = static_cast<T>(row[x]);
    }
    return means;
}
template <std::integral W, std::integral H, detail::Spannable R>
[[nodiscard]] auto bilinear_means(W width, H height, const R& luminance) {
    return bilinear_means(width, height, detail::span_of(luminance));
}

// An image without light draws nothing, nor does a shape that AreaLight would not draw.
template <std::floating_point T = float>
class ImageLight {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    // The table must outlive the light.
    LUMIS_INLINE ImageLight(const Parallelogram<T>& shape, const PiecewiseConstant2DView<T>& table,
                            const glm::vec<3, T>& reference_point, Sides sides = Sides::Both) noexcept
        : view_{shape, reference_point, sides},
          shape_{shape},
          table_{table},
          pdf_area_{real::quotient_where(view_.area() > 0, T(1), view_.area())} {}
    LUMIS_INLINE ImageLight(const Parallelogram<T>& shape, const PiecewiseConstant2D<T>& table LUMIS_LIFETIME_BOUND,
                            const glm::vec<3, T>& reference_point, Sides sides = Sides::Both) noexcept
        : ImageLight{shape, table.view(), reference_point, sides} {}

    // u.y draws the row of texels, u.x the texel within it.
    [[nodiscard]] LUMIS_INLINE SurfaceLightSample<Point, T> sample(glm::vec<2, T> u) const noexcept {
        const auto drawn = table_.sample(u);
        const SurfaceSample<T> point = view_.sample(drawn.value);
        const T squared = glm::dot(point.position, point.position);
        if (!(drawn.pdf > 0 && is_squared_length(squared))) return {};
        const T distance = real::sqrt(squared), inverse = real::divide(T(1), distance);
        return {point.position * inverse, density(drawn.pdf, distance, point.cos_times_distance * inverse), distance,
                view_.surface(shape_, drawn.value)};
    }

    [[nodiscard]] LUMIS_HD T pdf(const Point& w) const noexcept {
        const SurfaceHit<T> hit = view_.intersect(w);
        return hit.distance > 0 ? pdf_from_hit(hit.distance, hit.cos_light, uv_of(w)) : T(0);
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& w) const noexcept { return table_.invert(uv_of(w)); }

    // The distance from the reference point to the light, dark texels included; infinity where w misses it.
    [[nodiscard]] LUMIS_HD T distance_along(const Point& w) const noexcept {
        return detail::distance_or_infinity(view_.intersect(w));
    }

    // The same, and what the surface is where w meets it.
    [[nodiscard]] LUMIS_HD LightHit<T> hit_along(const Point& w) const noexcept {
        const SurfaceHit<T> hit = view_.intersect(w);
        return {detail::distance_or_infinity(hit), view_.surface(shape_, w, hit)};
    }

    // The density for hosts that already know where a ray hit this light, see AreaLight; uv: the coordinates of the point.
    [[nodiscard]] LUMIS_HD T pdf_from_hit(T distance, T cos_light, const glm::vec<2, T>& uv) const noexcept {
        return density(table_.pdf(uv), distance, cos_light);
    }

    [[nodiscard]] LUMIS_HD const Parallelogram<T>& shape() const noexcept LUMIS_LIFETIME_BOUND { return shape_; }

  private:
    // pdf_uv: over [0, 1]^2, which the shape's area is stretched from evenly.
    [[nodiscard]] LUMIS_HD T density(T pdf_uv, T distance, T cos_light) const noexcept {
        return area_to_solid_angle(pdf_uv * pdf_area_, distance, cos_light);
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> uv_of(const Point& w) const noexcept {
        const glm::vec<2, T> uv = view_.invert(w);
        return {real::clamp(uv.x, 0, 1), real::clamp(uv.y, 0, 1)};
    }

    detail::FlatView<Parallelogram<T>> view_;
    Parallelogram<T> shape_;
    PiecewiseConstant2DView<T> table_;
    T pdf_area_;
};

template <std::floating_point T>
ImageLight(Parallelogram<T>, const PiecewiseConstant2D<T>&, glm::vec<3, T>, Sides = Sides::Both) -> ImageLight<T>;
template <std::floating_point T>
ImageLight(Parallelogram<T>, PiecewiseConstant2DView<T>, glm::vec<3, T>, Sides = Sides::Both) -> ImageLight<T>;

}  // namespace lumis::LUMIS_ISA
