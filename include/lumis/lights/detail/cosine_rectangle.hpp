// Directions towards a rectangle above a receiver's horizon, nearly in proportion to the cosine there: the spherical rectangle at
// uniforms that a bilinear warp has moved to the corners of large cosines (Hart et al. 2020). It takes half as long as a fan of
// triangles, and fits as well, unless the receiver's normal points at the rectangle.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/lights/detail/bilinear_warp.hpp"
#include "lumis/lights/detail/flat_shape.hpp"
#include "lumis/lights/detail/horizon_polygon.hpp"
#include "lumis/lights/detail/spherical_rectangle.hpp"

#include <concepts>
#include <limits>

namespace lumis::LUMIS_ISA::detail {

template <std::floating_point T>
class CosineRectangle {
    using Polygon = HorizonPolygon<Parallelogram<T>>;
    using W = Wide<T>;

  public:
    // Whether the polygon is a rectangle whose cosines between the corners are not much larger than at them.
    [[nodiscard]] LUMIS_HD static bool fits(const FlatShape<Parallelogram<T>>& shape, const Polygon& polygon,
                                            const typename Polygon::NearestPoint& nearest) noexcept {
        if (nearest.is == Polygon::Nearest::Normal || !polygon.is_parallelogram() || !is_rectangle(shape)) return false;
        W highest = 0;
        for (int i = 0; i < 4; ++i) highest = real::greater(highest, polygon[i].cosine);
        return nearest.point.cosine <= scalar_of<W>(1.3) * highest;
    }

    // The polygon fits. Empty where the spherical rectangle has no digits.
    LUMIS_INLINE CosineRectangle(const Polygon& polygon, const typename Polygon::NearestPoint& nearest) noexcept
        : CosineRectangle{polygon, 1 / nearest.point.cosine, first_corner(polygon)} {}

    [[nodiscard]] LUMIS_HD bool empty() const noexcept { return !(scale_ > 0); }

    // The direction, and its density. Not of an empty one, as below.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE Sample<Direction<R>, R> sample(const glm::vec<2, R>& u) const noexcept {
        const glm::vec<2, R> at = warp_.sample(u);
        const glm::vec<3, R> position = rectangle_.sample(at);
        return {position * real::divide(R(T(1)), real::length(position)), warp_.weight(at) * scale_};
    }

    [[nodiscard]] LUMIS_HD T pdf(const Direction<T>& w) const noexcept {
        return warp_.weight(within_square(rectangle_.invert(w))) * scale_;
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Direction<T>& w) const noexcept {
        return warp_.invert(within_square(rectangle_.invert(w)));
    }

  private:
    // The second edge, along which spherical rectangles are even in the sine of the elevation, is to be the steeper one. If that is
    // upright, the cosine is linear along it.
    [[nodiscard]] LUMIS_INLINE static int first_corner(const Polygon& polygon) noexcept {
        const W rise_01 = polygon[1].height - polygon[0].height, rise_12 = polygon[2].height - polygon[1].height;
        const W length_01 = real::length(polygon.between(polygon[0], polygon[1]));
        const W length_12 = real::length(polygon.between(polygon[1], polygon[2]));
        return real::abs(rise_01) * length_12 > real::abs(rise_12) * length_01 ? 1 : 0;
    }

    LUMIS_INLINE CosineRectangle(const Polygon& polygon, W scale, int first) noexcept
        : rectangle_{polygon[first].position, polygon.between(polygon[first], polygon[first + 1]),
                     polygon.between(polygon[first], polygon[first + 3])} {
        if (!rectangle_.has_digits()) return;
        // Positive, see CosineFan.
        const auto weight = [&](int i) {
            return static_cast<T>(real::greater(polygon[first + i].cosine * scale, scalar_of<W>(1.0 / 256)));
        };
        warp_ = BilinearWarp<T>{weight(0), weight(1), weight(3), weight(2)};
        const T sum = rectangle_.solid_angle() * warp_.mean();
        scale_ = density_or_zero(real::quotient_where(sum > 0, T(1), sum));
    }

    SphericalRectangle<T> rectangle_;
    BilinearWarp<T> warp_;
    T scale_{0};  // 1 / (solid angle times mean weight)
};

}  // namespace lumis::LUMIS_ISA::detail
