// A triangle or parallelogram as seen from a reference point: points on it evenly by area, and rays that meet it.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/lights/detail/flat_shape.hpp"
#include "lumis/lights/surface.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace lumis::LUMIS_ISA::detail {

template <class Shape>
class FlatView {
    using T = typename Shape::Scalar;
    static constexpr bool is_triangle = FlatShape<Shape>::is_triangle;

  public:
    LUMIS_INLINE FlatView(const Shape& shape, const glm::vec<3, T>& reference_point) noexcept
        : FlatView{FlatShape<Shape>{shape, reference_point}} {}

    LUMIS_INLINE explicit FlatView(const FlatShape<Shape>& shape) noexcept
        : corner_{shape.in_scene.corner}, edge_u_{shape.in_scene.edge_u}, edge_v_{shape.in_scene.edge_v} {
        using Wide = typename FlatShape<Shape>::Wide;
        constexpr auto rounding = 4 * std::numeric_limits<T>::epsilon();
        const auto& [start, u, v] = shape.in_units;
        const auto normal = cross(u, v);
        const Wide area = real::length(normal);  // of the parallelogram of the edges
        const Wide inverse = real::quotient_where(area > 0, Wide(1), area);
        normal_ = normal * inverse;
        height_ = static_cast<T>(Wide(glm::dot(start, normal) * inverse * shape.unit));
        area_ = static_cast<T>(area * shape.unit * shape.unit * scalar_of<Wide>(is_triangle ? 0.5 : 1));
        across_u_ = cross(v, start) * inverse;
        across_v_ = cross(start, u) * inverse;
        rounding_u_ = rounding * longest_component(across_u_);
        rounding_v_ = rounding * longest_component(across_v_);
    }

    [[nodiscard]] LUMIS_HD T area() const noexcept { return area_; }

    // u in [0,1]^2. Triangles by the square-root map (Turk 1990), which folds nothing and so keeps strata together.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE SurfaceSample<R> sample(glm::vec<2, R> u) const noexcept {
        R s = u.x, t = u.y;
        if constexpr (is_triangle) {
            const R root = real::sqrt(u.x);
            s = root * (1 - u.y);
            t = root * u.y;
        }
        using Vector = glm::vec<3, R>;
        return {Vector(corner_) + s * Vector(edge_u_) + t * Vector(edge_v_), height_};
    }

    // To the plane; 0 parallel to it.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R distance_along(const Direction<R>& w) const noexcept {
        const R cos_light = glm::dot(w, Direction<R>(normal_));
        return real::quotient_where(real::abs(cos_light) > 0, R(height_), cos_light);
    }

    // The u that sample maps to the point that w meets.
    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Direction<T>& w) const noexcept {
        const T cos_light = glm::dot(w, normal_);
        const auto meets = real::abs(cos_light) > 0;
        const T s = real::quotient_where(meets, T(glm::dot(w, across_u_)), cos_light);
        const T t = real::quotient_where(meets, T(glm::dot(w, across_v_)), cos_light);
        if constexpr (is_triangle) {
            return {(s + t) * (s + t), real::quotient_where(s + t > 0, t, T(s + t))};
        } else {
            return {s, t};
        }
    }

    // w: unit. By triple products (Moller and Trumbore 1997), which are compared before they are divided by the cosine. The
    // edges give way by the rounding of w, so that a direction drawn to a point on an edge meets it.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD SurfaceHit<R> intersect(const Direction<R>& w) const noexcept {
        const R cos_light = glm::dot(w, Direction<R>(normal_));
        const R distance = real::quotient_where(real::abs(cos_light) > 0, R(height_), cos_light);
        const R reach = real::abs(cos_light), sign = real::copysign(R(scalar_of<R>(1)), cos_light);
        const R s = sign * glm::dot(w, Direction<R>(across_u_)), t = sign * glm::dot(w, Direction<R>(across_v_));
        const auto below_far_edges = is_triangle ? s + t <= reach + (rounding_u_ + rounding_v_)
                                                 : s <= reach + rounding_u_ && t <= reach + rounding_v_;
        return hit_if(distance > 0 && s >= -rounding_u_ && t >= -rounding_v_ && below_far_edges, distance, cos_light);
    }

  private:
    glm::vec<3, T> corner_, edge_u_, edge_v_;  // relative to the reference point
    glm::vec<3, T> across_u_, across_v_;       // a ray's s and t are its products with these over its cosine
    Direction<T> normal_;
    T height_;                   // of the plane over the reference point, along the normal; signed
    T area_;                     // of the shape
    T rounding_u_, rounding_v_;  // by how much those products move when w is rounded
};

}  // namespace lumis::LUMIS_ISA::detail

namespace lumis::LUMIS_ISA {

template <Real T>
[[nodiscard]] LUMIS_INLINE inline auto seen_from(const Triangle<T>& shape,
                                                 const glm::vec<3, T>& reference_point) noexcept {
    return detail::FlatView<Triangle<T>>{shape, reference_point};
}
template <Real T>
[[nodiscard]] LUMIS_INLINE inline auto seen_from(const Parallelogram<T>& shape,
                                                 const glm::vec<3, T>& reference_point) noexcept {
    return detail::FlatView<Parallelogram<T>>{shape, reference_point};
}

}  // namespace lumis::LUMIS_ISA
