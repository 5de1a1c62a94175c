// A triangle or parallelogram as seen from a reference point: points on it evenly by area, and rays that meet it.
// Vertices are taken relative to the reference point before anything else, and edges before that, so that a scene far
// from its origin loses no more than its coordinates have lost already.
#pragma once

#include "lumis/core/real.hpp"
#include "lumis/strategies/shapes.hpp"
#include "lumis/strategies/surface.hpp"

#include <glm/geometric.hpp>

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace lumis {

template <class Shape>
class FlatView {
    using T = typename Shape::Scalar;
    static constexpr bool is_triangle = std::same_as<Shape, Triangle<T>>;

  public:
    [[gnu::always_inline]] FlatView(const Shape& shape,
                                    const glm::vec<3, T>& reference_point) noexcept requires is_triangle
        : FlatView{shape.a - reference_point, shape.b - shape.a, shape.c - shape.a} {
        LUMIS_ASSERT(!detail::is_nan(shape) && !detail::is_nan(reference_point));
    }

    [[gnu::always_inline]] FlatView(const Shape& shape, const glm::vec<3, T>& reference_point) noexcept
        requires(!is_triangle)
        : FlatView{shape.corner - reference_point, shape.edge_u, shape.edge_v} {
        LUMIS_ASSERT(!detail::is_nan(shape) && !detail::is_nan(reference_point));
    }

    [[nodiscard]] T area() const noexcept { return area_; }

    // u in [0,1]^2. Triangles by the square-root map (Turk 1990), which folds nothing and so keeps strata together.
    template <RealOf<T> R = T>
    [[nodiscard, gnu::always_inline]] SurfaceSample<R> sample(glm::vec<2, R> u) const noexcept {
        R s = u.x, t = u.y;
        if constexpr (is_triangle) {
            const R root = real::sqrt(u.x);
            s = root * (1 - u.y);
            t = root * u.y;
        }
        using Vector = glm::vec<3, R>;
        return {Vector(corner_) + s * Vector(edge_u_) + t * Vector(edge_v_), height_};
    }

    // The vertex all edges start from, relative to the reference point, and the edges; in units near the longest edge.
    [[nodiscard]] glm::vec<3, T> corner() const noexcept { return corner_ * (1 / unit_); }
    [[nodiscard]] glm::vec<3, T> edge_u() const noexcept { return edge_u_ * (1 / unit_); }
    [[nodiscard]] glm::vec<3, T> edge_v() const noexcept { return edge_v_ * (1 / unit_); }
    [[nodiscard]] T unit() const noexcept { return unit_; }

    // True if the reference point lies in the plane, or the shape has no area.
    [[nodiscard]] bool edge_on() const noexcept { return !(std::abs(height_) > 0); }

    // To the plane.
    template <RealOf<T> R = T>
    [[nodiscard]] R distance_along(const Direction<R>& w) const noexcept {
        return height_ / glm::dot(w, Direction<R>(normal_));
    }

    // The u that sample maps to the point that w meets.
    [[nodiscard]] glm::vec<2, T> invert(const Direction<T>& w) const noexcept {
        const T cos_light = glm::dot(w, normal_);
        const T s = glm::dot(w, across_u_) / cos_light, t = glm::dot(w, across_v_) / cos_light;
        if constexpr (is_triangle) {
            return {(s + t) * (s + t), s + t > 0 ? t / (s + t) : T(0)};
        } else {
            return {s, t};
        }
    }

    // w: unit. By triple products (Moller and Trumbore 1997), which are compared before they are divided by the cosine. The
    // edges give way by the rounding of w, so that a direction drawn to a point on an edge meets it.
    template <RealOf<T> R = T>
    [[nodiscard]] SurfaceHit<R> intersect(const Direction<R>& w) const noexcept {
        const R cos_light = glm::dot(w, Direction<R>(normal_));
        const R distance = height_ / cos_light, far = real::abs(cos_light), sign = real::copysign(R(T(1)), cos_light);
        const R s = sign * glm::dot(w, Direction<R>(across_u_)), t = sign * glm::dot(w, Direction<R>(across_v_));
        const auto below_far_edges =
            is_triangle ? s + t <= far + (rounding_u_ + rounding_v_) : s <= far + rounding_u_ && t <= far + rounding_v_;
        return hit_if(distance > 0 && s >= -rounding_u_ && t >= -rounding_v_ && below_far_edges, distance, cos_light);
    }

  private:
    // Worked in units near the longest edge: squares of tiny or huge edges would leave float's range. A power of two
    // rounds nothing.
    [[gnu::always_inline]] FlatView(const glm::vec<3, T>& corner, const glm::vec<3, T>& edge_u,
                                    const glm::vec<3, T>& edge_v) noexcept
        : corner_{corner},
          edge_u_{edge_u},
          edge_v_{edge_v},
          unit_{power_of_two(real::max(longest_component(edge_u), longest_component(edge_v)))} {
        constexpr T rounding = 4 * std::numeric_limits<T>::epsilon();
        const glm::vec<3, T> start = this->corner(), u = this->edge_u(), v = this->edge_v(), normal = glm::cross(u, v);
        const T area = real::length(normal), inverse = 1 / area;  // of the parallelogram of the edges
        normal_ = normal * inverse;
        height_ = unit_ * (glm::dot(start, normal) * inverse);
        area_ = area * unit_ * unit_ * (is_triangle ? T(0.5) : T(1));
        across_u_ = glm::cross(v, start) * inverse;
        across_v_ = glm::cross(start, u) * inverse;
        rounding_u_ = rounding * longest_component(across_u_);
        rounding_v_ = rounding * longest_component(across_v_);
    }

    // The largest one that is not above x; of numbers too small to have all their digits, that of the least which has.
    static T power_of_two(T x) noexcept {
        using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
        constexpr auto exponent = std::bit_cast<Bits>(std::numeric_limits<T>::infinity());
        return std::bit_cast<T>(std::bit_cast<Bits>(real::max(std::numeric_limits<T>::min(), x)) & exponent);
    }

    static T longest_component(const glm::vec<3, T>& v) noexcept {
        return real::max(real::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
    }

    glm::vec<3, T> corner_, edge_u_, edge_v_;  // relative to the reference point
    T unit_;                                   // that is worked in
    glm::vec<3, T> across_u_, across_v_;       // a ray's s and t are its products with these over its cosine
    Direction<T> normal_;
    T height_;                   // of the plane over the reference point, along the normal; signed
    T area_;                     // of the shape
    T rounding_u_, rounding_v_;  // by how much those products move when w is rounded
};

}  // namespace lumis
