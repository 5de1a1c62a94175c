// A triangle or parallelogram as seen from a reference point: points on it evenly by area, rays that meet it, and what the
// surface is there.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/lights/detail/flat_shape.hpp"
#include "lumis/lights/surface.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <limits>

namespace lumis::LUMIS_ISA::detail {

// The coordinates of the shape's points, evenly by area for u in [0,1]^2: of triangles by the square-root map (Turk 1990),
// which folds nothing and so keeps strata together.
template <class Shape, Real R>
[[nodiscard]] LUMIS_INLINE inline glm::vec<2, R> flat_coordinates(const glm::vec<2, R>& u) noexcept {
    if constexpr (FlatShape<Shape>::is_triangle) {
        const R root = real::sqrt(u.x);
        return {root * (1 - u.y), root * u.y};
    } else {
        return u;
    }
}

// The u of coordinates.
template <class Shape, Real R>
[[nodiscard]] LUMIS_INLINE inline glm::vec<2, R> flat_uniforms(const glm::vec<2, R>& at) noexcept {
    if constexpr (FlatShape<Shape>::is_triangle) {
        const R sum = at.x + at.y;
        return {sum * sum, real::quotient_where(sum > 0, at.y, sum)};
    } else {
        return at;
    }
}

// The point at coordinates, in world space.
template <Real R, class T>
[[nodiscard]] LUMIS_INLINE inline glm::vec<3, R> position_at(const Triangle<T>& shape,
                                                             const glm::vec<2, R>& uv) noexcept {
    using Vector = glm::vec<3, R>;
    return Vector(shape.a) + (uv.x * Vector(shape.b - shape.a) + uv.y * Vector(shape.c - shape.a));
}
template <Real R, class T>
[[nodiscard]] LUMIS_INLINE inline glm::vec<3, R> position_at(const Parallelogram<T>& shape,
                                                             const glm::vec<2, R>& uv) noexcept {
    using Vector = glm::vec<3, R>;
    return Vector(shape.corner) + (uv.x * Vector(shape.edge_u) + uv.y * Vector(shape.edge_v));
}

template <class Shape>
class FlatView {
    using T = typename Shape::Scalar;
    static constexpr bool is_triangle = FlatShape<Shape>::is_triangle;

  public:
    LUMIS_INLINE FlatView(const Shape& shape, const glm::vec<3, T>& reference_point) noexcept
        : FlatView{FlatShape<Shape>{shape, reference_point}} {}
    LUMIS_INLINE FlatView(const Shape& shape, const glm::vec<3, T>& reference_point, Sides sides) noexcept
        : FlatView{FlatShape<Shape>{shape, reference_point}.facing(sides)} {}

    LUMIS_INLINE explicit FlatView(const FlatShape<Shape>& shape) noexcept
        : corner_{shape.in_scene.corner}, edge_u_{shape.in_scene.edge_u}, edge_v_{shape.in_scene.edge_v} {
        using Wide = typename FlatShape<Shape>::Wide;
        constexpr auto rounding = 4 * std::numeric_limits<T>::epsilon();
        const auto& [start, u, v] = shape.in_units();
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
    [[nodiscard]] LUMIS_HD const Direction<T>& normal() const noexcept { return normal_; }

    // u in [0,1]^2.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE SurfaceSample<R> sample(glm::vec<2, R> u) const noexcept {
        const glm::vec<2, R> at = flat_coordinates<Shape>(u);
        using Vector = glm::vec<3, R>;
        return {Vector(corner_) + at.x * Vector(edge_u_) + at.y * Vector(edge_v_), height_};
    }

    // The surface at the point that sample draws.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface(const Shape& shape, const glm::vec<2, R>& u) const noexcept {
        return surface_at(shape, flat_coordinates<Shape>(u));
    }

    // The surface where a unit vector w meets the plane as `met` says; where rounding has put w beside the shape, that of a point
    // on its edge.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface(const Shape& shape, const Direction<R>& w,
                                                       const SurfaceHit<R>& met) const noexcept {
        const auto meets = real::abs(met.cos_light) > 0;
        const R u = real::quotient_where(meets, R(glm::dot(w, Direction<R>(across_u_))), met.cos_light);
        const R v = real::quotient_where(meets, R(glm::dot(w, Direction<R>(across_v_))), met.cos_light);
        const R s = real::clamp(u, 0, 1), most = is_triangle ? R(1 - s) : R(scalar_of<R>(1));
        return surface_at(shape, glm::vec<2, R>{s, real::clamp(v, 0, most)});
    }

    // Where w meets the plane; distance 0 parallel to it.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD SurfaceHit<R> meet_plane(const Direction<R>& w) const noexcept {
        const R cos_light = glm::dot(w, Direction<R>(normal_));
        return {real::quotient_where(real::abs(cos_light) > 0, R(height_), cos_light), cos_light};
    }

    // The u that sample maps to the point that w meets.
    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Direction<T>& w) const noexcept {
        const T cos_light = glm::dot(w, normal_);
        const auto meets = real::abs(cos_light) > 0;
        const T s = real::quotient_where(meets, T(glm::dot(w, across_u_)), cos_light);
        const T t = real::quotient_where(meets, T(glm::dot(w, across_v_)), cos_light);
        return flat_uniforms<Shape>(glm::vec<2, T>{s, t});
    }

    // w: unit. By triple products (Moller and Trumbore 1997), which are compared before they are divided by the cosine. The
    // edges give way by the rounding of w, so that a direction drawn to a point on an edge meets it: `slack` times as much for
    // directions that have been rounded more often.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD SurfaceHit<R> intersect(const Direction<R>& w, T slack = 1) const noexcept {
        const auto [distance, cos_light] = meet_plane(w);
        const R reach = real::abs(cos_light), sign = real::copysign(R(scalar_of<R>(1)), cos_light);
        const R s = sign * glm::dot(w, Direction<R>(across_u_)), t = sign * glm::dot(w, Direction<R>(across_v_));
        const T blur_u = slack * rounding_u_, blur_v = slack * rounding_v_;
        const auto below_far_edges =
            is_triangle ? s + t <= reach + (blur_u + blur_v) : s <= reach + blur_u && t <= reach + blur_v;
        return hit_if(distance > 0 && s >= -blur_u && t >= -blur_v && below_far_edges, distance, cos_light);
    }

  private:
    template <Real R>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface_at(const Shape& shape, const glm::vec<2, R>& uv) const noexcept {
        return {position_at(shape, uv), Direction<R>(normal_), uv};
    }

    glm::vec<3, T> corner_, edge_u_, edge_v_;  // relative to the reference point
    glm::vec<3, T> across_u_, across_v_;       // a ray's s and t are its products with these over its cosine
    Direction<T> normal_;
    T height_;                   // of the plane over the reference point, along the normal; signed
    T area_;                     // of the shape
    T rounding_u_, rounding_v_;  // by how much those products move when w is rounded
};

}  // namespace lumis::LUMIS_ISA::detail

namespace lumis::LUMIS_ISA {

template <Real T, std::same_as<Sides>... S>
[[nodiscard]] LUMIS_INLINE inline auto seen_from(const Triangle<T>& shape, const glm::vec<3, T>& reference_point,
                                                 S... sides) noexcept {
    return detail::FlatView<Triangle<T>>{shape, reference_point, sides...};
}
template <Real T, std::same_as<Sides>... S>
[[nodiscard]] LUMIS_INLINE inline auto seen_from(const Parallelogram<T>& shape, const glm::vec<3, T>& reference_point,
                                                 S... sides) noexcept {
    return detail::FlatView<Parallelogram<T>>{shape, reference_point, sides...};
}

}  // namespace lumis::LUMIS_ISA
