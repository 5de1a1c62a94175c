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
    [[gnu::always_inline]] FlatView(const Shape& shape, const glm::vec<3, T>& reference_point) noexcept requires is_triangle
        : FlatView{shape.a - reference_point, shape.b - shape.a, shape.c - shape.a} {}

    [[gnu::always_inline]] FlatView(const Shape& shape, const glm::vec<3, T>& reference_point) noexcept requires(!is_triangle)
        : FlatView{shape.corner - reference_point, shape.edge_u, shape.edge_v} {}

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
        return {R(scale_) * (Vector(corner_) + s * Vector(edge_u_) + t * Vector(edge_v_)), height_};
    }

    // The vertex all edges start from, relative to the reference point, and the edges; in units near the longest edge.
    [[nodiscard]] const glm::vec<3, T>& corner() const noexcept { return corner_; }
    [[nodiscard]] const glm::vec<3, T>& edge_u() const noexcept { return edge_u_; }
    [[nodiscard]] const glm::vec<3, T>& edge_v() const noexcept { return edge_v_; }

    // True if the reference point lies in the plane, or the shape has no area.
    [[nodiscard]] bool edge_on() const noexcept { return !(std::abs(height_) > 0); }

    // To the plane.
    template <RealOf<T> R = T>
    [[nodiscard]] R distance_along(const Direction<R>& w) const noexcept {
        return height_ / glm::dot(w, Direction<R>(normal_));
    }

    // The u that sample maps to the point that w meets.
    [[nodiscard]] glm::vec<2, T> invert(const Direction<T>& w) const noexcept {
        const T determinant = glm::dot(w, normal_) * unit_area_;
        const T s = glm::dot(w, across_u_) / determinant, t = glm::dot(w, across_v_) / determinant;
        if constexpr (is_triangle) {
            return {(s + t) * (s + t), s + t > 0 ? t / (s + t) : T(0)};
        } else {
            return {s, t};
        }
    }

    // w: unit. By triple products (Moller and Trumbore 1997). The edges give way by the rounding of w, so that a
    // direction drawn to a point on an edge meets it.
    template <RealOf<T> R = T>
    [[nodiscard]] SurfaceHit<R> intersect(const Direction<R>& w) const noexcept {
        const R cos_light = glm::dot(w, Direction<R>(normal_));
        const R distance = height_ / cos_light;
        const R scale = 1 / (cos_light * unit_area_), precision = real::abs(scale);
        const R s = glm::dot(w, Direction<R>(across_u_)) * scale, slack_s = rounding_u_ * precision;
        const R t = glm::dot(w, Direction<R>(across_v_)) * scale, slack_t = rounding_v_ * precision;
        const auto below_far_edges =
            is_triangle ? s + t <= 1 + slack_s + slack_t : s <= 1 + slack_s && t <= 1 + slack_t;
        return hit_if(distance > 0 && s >= -slack_s && t >= -slack_t && below_far_edges, distance, cos_light);
    }

  private:
    // Worked in units near the longest edge: squares of tiny or huge edges would leave float's range. A power of two
    // rounds nothing.
    [[gnu::always_inline]] FlatView(const glm::vec<3, T>& corner, const glm::vec<3, T>& edge_u, const glm::vec<3, T>& edge_v) noexcept
        : scale_{power_of_two(real::max(longest_component(edge_u), longest_component(edge_v)))},
          corner_{corner * (1 / scale_)},
          edge_u_{edge_u * (1 / scale_)},
          edge_v_{edge_v * (1 / scale_)},
          across_u_{glm::cross(edge_v_, corner_)},
          across_v_{glm::cross(corner_, edge_u_)} {
        constexpr T rounding = 4 * std::numeric_limits<T>::epsilon();
        const glm::vec<3, T> normal = glm::cross(edge_u_, edge_v_);
        unit_area_ = glm::length(normal);
        normal_ = normal / unit_area_;
        height_ = scale_ * (glm::dot(corner_, normal) / unit_area_);
        area_ = unit_area_ * scale_ * scale_ * (is_triangle ? T(0.5) : T(1));
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

    T scale_;
    glm::vec<3, T> corner_, edge_u_, edge_v_;  // relative to the reference point, in units of scale_
    glm::vec<3, T> across_u_, across_v_;       // a ray's s and t are its triple products with these
    T unit_area_;                              // of the parallelogram of the edges, in units of scale_^2
    Direction<T> normal_;
    T height_;                   // of the plane over the reference point, along the normal; signed
    T area_;                     // of the shape
    T rounding_u_, rounding_v_;  // by how much the triple products move when w is rounded
};

}  // namespace lumis
