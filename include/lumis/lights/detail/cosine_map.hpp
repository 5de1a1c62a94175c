// How a triangle or parallelogram is drawn by solid angle and cosine: as a rectangle where it fits one, else as a fan of triangles.
// Both densities integrate to 1 over what is above the horizon.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/lights/detail/cosine_fan.hpp"
#include "lumis/lights/detail/cosine_rectangle.hpp"
#include "lumis/lights/detail/flat_shape.hpp"
#include "lumis/lights/detail/horizon_polygon.hpp"

#include <optional>
#include <type_traits>

namespace lumis::LUMIS_ISA::detail {

template <class Shape>
class CosineMap {
    using T = typename Shape::Scalar;
    static constexpr bool is_triangle = FlatShape<Shape>::is_triangle;

  public:
    LUMIS_INLINE CosineMap(const FlatShape<Shape>& shape, const Direction<T>& normal) noexcept {
        using W = typename FlatShape<Shape>::Wide;
        const HorizonPolygon<Shape> polygon{shape, glm::vec<3, W>{normal}};
        if (polygon.size() < 3) return;
        const auto nearest = polygon.nearest_to_normal();
        if (!(nearest.point.cosine > 0)) return;
        if constexpr (!is_triangle) {
            if (CosineRectangle<T>::fits(shape, polygon, nearest)) {
                rectangle_.emplace(polygon, nearest);
                if (!rectangle_->empty()) return;
                rectangle_.reset();
            }
        }
        fan_.emplace(polygon, nearest);
        if (fan_->empty()) fan_.reset();
    }

    // Nothing is seen above the horizon.
    [[nodiscard]] LUMIS_HD bool empty() const noexcept { return !fan_ && !has_rectangle(); }

    // The direction, and its density. Not of an empty one, as below.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE Sample<Direction<R>, R> sample(const glm::vec<2, R>& u) const noexcept {
        if constexpr (!is_triangle) {
            if (rectangle_) return rectangle_->sample(u);
        }
        return fan_->sample(u);
    }

    // w: towards the part of the shape that is above the horizon.
    [[nodiscard]] LUMIS_HD T pdf(const Direction<T>& w) const noexcept {
        if constexpr (!is_triangle) {
            if (rectangle_) return rectangle_->pdf(w);
        }
        return fan_->pdf(w);
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Direction<T>& w) const noexcept {
        if constexpr (!is_triangle) {
            if (rectangle_) return rectangle_->invert(w);
        }
        return fan_->invert(w);
    }

  private:
    [[nodiscard]] LUMIS_HD bool has_rectangle() const noexcept {
        if constexpr (is_triangle) {
            return false;
        } else {
            return rectangle_.has_value();
        }
    }

    struct None {};
    std::conditional_t<is_triangle, None, std::optional<CosineRectangle<T>>> rectangle_;
    std::optional<CosineFan<Shape>> fan_;
};

}  // namespace lumis::LUMIS_ISA::detail
