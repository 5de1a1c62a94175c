// The surface of a shape by itself, seen from nowhere: its points evenly by area, and which points lie on it.
#pragma once

#include "lumis/core/frame.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/spherical.hpp"
#include "lumis/core/surface_point.hpp"
#include "lumis/lights/detail/disk_view.hpp"
#include "lumis/lights/detail/flat_view.hpp"
#include "lumis/lights/detail/sphere_view.hpp"
#include "lumis/lights/shapes.hpp"

#include <glm/geometric.hpp>

#include <limits>
#include <utility>

namespace lumis::LUMIS_ISA::detail {

// How far a rounded position may lie off its surface: some units in the last place of the largest coordinates around.
template <Real R>
[[nodiscard]] LUMIS_HD R rounding_of(const glm::vec<3, R>& x, std::type_identity_t<R> extent) noexcept {
    return 16 * std::numeric_limits<R>::epsilon() * (longest_component(x) + extent);
}

// A triangle or parallelogram. The view is that from its own corner.
template <class Shape>
class Surface {
    using T = typename Shape::Scalar;
    static constexpr bool is_triangle = FlatShape<Shape>::is_triangle;

  public:
    LUMIS_INLINE explicit Surface(const Shape& shape) noexcept : Surface{shape, corner_of(shape)} {}

    [[nodiscard]] LUMIS_HD T area() const noexcept { return view_.area(); }

    template <Real R>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> sample(const glm::vec<2, R>& u) const noexcept {
        return view_.surface(shape_, u);
    }

    [[nodiscard]] LUMIS_HD const Direction<T>& normal_at(const glm::vec<3, T>&) const noexcept {
        return view_.normal();
    }

    template <Real R>
    [[nodiscard]] LUMIS_HD MaskOf<R> contains(const glm::vec<3, R>& x) const noexcept {
        const R blur = rounding_of(x, extent_);
        const auto at = coordinates(x);
        const R blur_u = blur * slope_u_, blur_v = blur * slope_v_;
        const auto below_far_edges =
            is_triangle ? at.x + at.y <= 1 + (blur_u + blur_v) : at.x <= 1 + blur_u && at.y <= 1 + blur_v;
        const R height = glm::dot(from_corner(x), glm::vec<3, R>(view_.normal()));
        return real::abs(height) <= blur && at.x >= -blur_u && at.y >= -blur_v && below_far_edges;
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const glm::vec<3, T>& x) const noexcept {
        return flat_uniforms<Shape>(coordinates(x));
    }

  private:
    LUMIS_INLINE Surface(const Shape& shape, const glm::vec<3, T>& corner) noexcept
        : view_{shape, corner}, shape_{shape} {
        const FlatShape<Shape> edges{shape, corner};
        using W = typename FlatShape<Shape>::Wide;
        const auto& [start, u, v] = edges.in_units();
        const auto normal = cross(u, v);
        const W squared = glm::dot(normal, normal) * edges.unit,
                inverse = real::quotient_where(squared > 0, W(1), squared);
        dual_u_ = cross(v, normal) * inverse;
        dual_v_ = cross(normal, u) * inverse;
        slope_u_ = real::length(dual_u_);
        slope_v_ = real::length(dual_v_);
        const auto& in_scene = edges.in_scene;
        extent_ = longest_component(corner) +
                  static_cast<T>(longest_component(in_scene.edge_u) + longest_component(in_scene.edge_v));
    }

    [[nodiscard]] LUMIS_HD static const glm::vec<3, T>& corner_of(const Shape& shape) noexcept {
        if constexpr (is_triangle) {
            return shape.a;
        } else {
            return shape.corner;
        }
    }

    template <Real R>
    [[nodiscard]] LUMIS_HD glm::vec<3, R> from_corner(const glm::vec<3, R>& x) const noexcept {
        return real::rounded(x - glm::vec<3, R>(corner_of(shape_)));
    }

    template <Real R>
    [[nodiscard]] LUMIS_HD glm::vec<2, R> coordinates(const glm::vec<3, R>& x) const noexcept {
        const auto d = from_corner(x);
        return {glm::dot(d, glm::vec<3, R>(dual_u_)), glm::dot(d, glm::vec<3, R>(dual_v_))};
    }

    FlatView<Shape> view_;
    Shape shape_;
    glm::vec<3, T> dual_u_, dual_v_;  // a point's coordinates are its products with these
    T slope_u_, slope_v_;             // of the coordinates
    T extent_;                        // of the coordinates of all points, at most
};

template <Real T>
class Surface<Disk<T>> {
  public:
    LUMIS_INLINE explicit Surface(const Disk<T>& disk) noexcept
        : view_{disk, disk.center}, disk_{disk}, radius_{view_.radius()} {}

    [[nodiscard]] LUMIS_HD T area() const noexcept { return view_.area(); }

    template <Real R>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> sample(const glm::vec<2, R>& u) const noexcept {
        return view_.surface(disk_, u);
    }

    [[nodiscard]] LUMIS_HD const Direction<T>& normal_at(const glm::vec<3, T>&) const noexcept {
        return view_.frame().normal();
    }

    template <Real R>
    [[nodiscard]] LUMIS_HD MaskOf<R> contains(const glm::vec<3, R>& x) const noexcept {
        const auto d = real::rounded(x - glm::vec<3, R>(disk_.center));
        const R blur = rounding_of(x, longest_component(disk_.center) + radius_);
        const R height = glm::dot(d, glm::vec<3, R>(view_.frame().normal()));
        return real::abs(height) <= blur && real::length(d) <= radius_ + blur;
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const glm::vec<3, T>& x) const noexcept {
        const auto local = view_.frame().to_local(real::rounded(x - disk_.center));
        const T inverse = real::quotient_where(radius_ > 0, T(1), radius_);
        const T s = local.x * inverse, t = local.y * inverse;
        return {s * s + t * t, turn_of(s, t)};
    }

  private:
    DiskView<T> view_;
    Disk<T> disk_;
    T radius_;
};

// The view is that from the centre.
template <Real T>
class Surface<Sphere<T>> {
  public:
    LUMIS_INLINE explicit Surface(const Sphere<T>& sphere) noexcept : view_{sphere, sphere.center}, sphere_{sphere} {}

    [[nodiscard]] LUMIS_HD T area() const noexcept { return view_.area(); }

    template <Real R>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> sample(const glm::vec<2, R>& u) const noexcept {
        return view_.surface(sphere_, u);
    }

    template <Real R>
    [[nodiscard]] LUMIS_HD Direction<R> normal_at(const glm::vec<3, R>& x) const noexcept {
        const auto d = real::rounded(x - glm::vec<3, R>(sphere_.center));
        const R length = real::length(d);
        return d * real::quotient_where(length > 0, R(scalar_of<R>(1)), length);
    }

    template <Real R>
    [[nodiscard]] LUMIS_HD MaskOf<R> contains(const glm::vec<3, R>& x) const noexcept {
        const auto d = real::rounded(x - glm::vec<3, R>(sphere_.center));
        const R blur = rounding_of(x, longest_component(sphere_.center) + sphere_.radius);
        return real::abs(R(real::length(d) - sphere_.radius)) <= blur;
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const glm::vec<3, T>& x) const noexcept {
        const auto normal = normal_at(x);
        return {versine_of(normal) / 2, turn_of(normal.x, normal.y)};
    }

  private:
    SphereView<T> view_;
    Sphere<T> sphere_;
};

}  // namespace lumis::LUMIS_ISA::detail
