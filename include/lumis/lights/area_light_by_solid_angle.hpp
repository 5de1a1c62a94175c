// Triangles, parallelograms and spheres by the directions in which they are seen, evenly: the density is 1 / solid angle over
// the light. World space. A light that subtends nothing (no area, edge-on, reference point at a vertex) draws nothing.
// pdf_from_hit takes what AreaLight<Shape, ByArea>::pdf_from_hit does and needs none of it: any hit has that density.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/lights/area_light.hpp"
#include "lumis/lights/detail/spherical_rectangle.hpp"
#include "lumis/lights/detail/spherical_triangle.hpp"

#include <concepts>
#include <limits>
#include <optional>
#include <type_traits>

namespace lumis::LUMIS_ISA {

namespace detail {

// What was drawn, or nothing where rounding has put the direction beside the light, or has left no unit vector: slivers no
// wider than the last place of their coordinates are seen so.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline LightSample<Direction<R>, R> seen_if(const MaskOf<R>& meets, const Direction<R>& w,
                                                                       std::type_identity_t<R> pdf,
                                                                       R distance) noexcept {
    constexpr auto rounding = 64 * std::numeric_limits<R>::epsilon();
    const auto seen = real::abs(real::rounded(R(glm::dot(w, w) - 1))) <= rounding && meets &&
                      distance <= (std::numeric_limits<R>::max)();
    return {real::select(seen, w, Direction<R>{}), real::select(seen, pdf, 0), real::select(seen, distance, 0)};
}

// The distance is 0 on a sphere's surface.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline LightSample<Direction<R>, R> seen_on_sphere(const Direction<R>& w,
                                                                              std::type_identity_t<R> pdf,
                                                                              R distance) noexcept {
    return seen_if<R>(distance >= 0, w, pdf, distance);
}

// The distance is 0 parallel to the plane, which is not met there: the far corners of huge lights are rounded to such directions.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline LightSample<Direction<R>, R> seen_on_plane(const Direction<R>& w,
                                                                             std::type_identity_t<R> pdf,
                                                                             R distance) noexcept {
    return seen_if<R>(distance > 0, w, pdf, distance);
}

// The density that is even over a solid angle; 0 over none, and over one so small that its inverse is out of range.
template <Real T>
[[nodiscard]] LUMIS_HD T uniform_density(T solid_angle) noexcept {
    return density_or_zero(real::quotient_where(solid_angle > 0, T(1), solid_angle));
}

}  // namespace detail

// The sphere's cone of directions evenly (Shirley, Wang and Zimmerman 1996); from inside, all directions evenly.
template <Real T>
class AreaLight<Sphere<T>, BySolidAngle> {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    LUMIS_INLINE AreaLight(const Sphere<T>& sphere, const glm::vec<3, T>& reference_point,
                           Sides sides = Sides::Both) noexcept
        : view_{sphere, reference_point, sides}, pdf_{detail::uniform_density(view_.solid_angle())} {}

    // u.x = 0 is the centre of the cone.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE LightSample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        const auto [direction, distance] = view_.direction(u);
        return detail::seen_on_sphere(direction, pdf_, distance);
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& w) const noexcept { return view_.invert_direction(w); }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& w) const noexcept {
        return real::select(view_.contains(w), R(pdf_), 0);
    }

    // From the reference point to the light; infinity where w misses it.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R distance_along(const Direction<R>& w) const noexcept {
        return detail::distance_or_infinity(view_.intersect(w));
    }

    // What the surface of the light's shape is where w meets it; for w that misses it the distance is infinite.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD LightHit<R> hit_along(const Sphere<T>& shape, const Direction<R>& w) const noexcept {
        const SurfaceHit<R> hit = view_.intersect(w);
        return {detail::distance_or_infinity(hit), view_.surface(shape, w, hit)};
    }

    // What it is where sample(u) has drawn `drawn`.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface(const Sphere<T>& shape, const glm::vec<2, R>& u,
                                                       const LightSample<Direction<R>, R>& /*drawn*/) const noexcept {
        return view_.surface_of_direction(shape, u);
    }

    [[nodiscard]] LUMIS_HD T pdf_from_hit(T /*distance*/, T /*cos_light*/) const noexcept { return pdf_; }

    [[nodiscard]] LUMIS_HD T solid_angle() const noexcept { return view_.solid_angle(); }

  private:
    detail::SphereView<T> view_;
    T pdf_;
};

// A triangle by Arvo 1995, in a form that keeps its digits, see spherical_triangle.hpp.
template <std::floating_point T>
class AreaLight<Triangle<T>, BySolidAngle> {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    LUMIS_INLINE AreaLight(const Triangle<T>& triangle, const glm::vec<3, T>& reference_point) noexcept
        : AreaLight{detail::FlatShape<Triangle<T>>{triangle, reference_point}} {}
    LUMIS_INLINE AreaLight(const Triangle<T>& triangle, const glm::vec<3, T>& reference_point, Sides sides) noexcept
        : AreaLight{detail::FlatShape<Triangle<T>>{triangle, reference_point}.facing(sides)} {}

    // u.x cuts off a share of the solid angle by an arc from a to the edge bc; u.y goes along that arc.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE LightSample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        if (!(pdf_ > 0)) return {};
        const Direction<R> w = seen_.sample(u);
        return detail::seen_on_plane(w, pdf_, view_.meet_plane(w).distance);
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& w) const noexcept {
        return real::select(view_.intersect(w).distance > 0, R(pdf_), 0);
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& w) const noexcept { return seen_.invert(w); }

    // From the reference point to the light; infinity where w misses it.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R distance_along(const Direction<R>& w) const noexcept {
        return detail::distance_or_infinity(view_.intersect(w));
    }

    // What the surface of the light's shape is where w meets it; for w that misses it the distance is infinite.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD LightHit<R> hit_along(const Triangle<T>& shape, const Direction<R>& w) const noexcept {
        const SurfaceHit<R> hit = view_.intersect(w);
        return {detail::distance_or_infinity(hit), view_.surface(shape, w, hit)};
    }

    // What it is where sample(u) has drawn `drawn`.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface(const Triangle<T>& shape, const glm::vec<2, R>& /*u*/,
                                                       const LightSample<Direction<R>, R>& drawn) const noexcept {
        return view_.surface(shape, drawn.value, view_.meet_plane(drawn.value));
    }

    [[nodiscard]] LUMIS_HD T pdf_from_hit(T /*distance*/, T /*cos_light*/) const noexcept { return pdf_; }

    [[nodiscard]] LUMIS_HD T solid_angle() const noexcept { return seen_.solid_angle(); }

  private:
    LUMIS_INLINE explicit AreaLight(const detail::FlatShape<Triangle<T>>& shape) noexcept
        : view_{shape},
          seen_{shape.in_units().corner, shape.in_units().corner + shape.in_units().edge_u,
                shape.in_units().corner + shape.in_units().edge_v, shape.in_units().edge_u, shape.in_units().edge_v},
          pdf_{detail::uniform_density(seen_.solid_angle())} {}

    detail::FlatView<Triangle<T>> view_;
    detail::SphericalTriangle<T> seen_;
    T pdf_;
};

// A rectangle by Urena, Fajardo and King 2013, which moves along both edges evenly. It is split by the diagonal from its
// corner into two spherical triangles
// - where it is not a rectangle but another parallelogram,
// - where it is small or close by, and Urena's angles have no digits left.
// Both ways are exactly even over the solid angle, so the density does not tell them apart.
template <std::floating_point T>
class AreaLight<Parallelogram<T>, BySolidAngle> {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    LUMIS_INLINE AreaLight(const Parallelogram<T>& shape, const glm::vec<3, T>& reference_point) noexcept
        : AreaLight{detail::FlatShape<Parallelogram<T>>{shape, reference_point}} {}
    LUMIS_INLINE AreaLight(const Parallelogram<T>& shape, const glm::vec<3, T>& reference_point, Sides sides) noexcept
        : AreaLight{detail::FlatShape<Parallelogram<T>>{shape, reference_point}.facing(sides)} {}

    // u.x goes along the first edge and u.y along the second or, where the shape is split, u.x from the first edge by way
    // of the diagonal to the second, and u.y away from the corner.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE LightSample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        if (!(pdf_ > 0)) return {};
        if (halves_) {
            const Halves halves{*halves_};  // see split
            const Direction<R> w = halves.sample(u);
            return detail::seen_on_plane(w, pdf_, view_.meet_plane(w).distance);
        }
        const glm::vec<3, R> position = rectangle_.sample(u);
        const R distance = real::length(position);
        return detail::seen_on_plane(position * real::divide(R(T(1)), distance), pdf_, R(distance * unit_));
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& w) const noexcept {
        return real::select(view_.intersect(w).distance > 0, R(pdf_), 0);
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& w) const noexcept {
        return halves_ ? halves_->invert(w) : rectangle_.invert(w);
    }

    // From the reference point to the light; infinity where w misses it.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R distance_along(const Direction<R>& w) const noexcept {
        return detail::distance_or_infinity(view_.intersect(w));
    }

    // What the surface of the light's shape is where w meets it; for w that misses it the distance is infinite.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD LightHit<R> hit_along(const Parallelogram<T>& shape, const Direction<R>& w) const noexcept {
        const SurfaceHit<R> hit = view_.intersect(w);
        return {detail::distance_or_infinity(hit), view_.surface(shape, w, hit)};
    }

    // What it is where sample(u) has drawn `drawn`.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface(const Parallelogram<T>& shape, const glm::vec<2, R>& /*u*/,
                                                       const LightSample<Direction<R>, R>& drawn) const noexcept {
        return view_.surface(shape, drawn.value, view_.meet_plane(drawn.value));
    }

    [[nodiscard]] LUMIS_HD T pdf_from_hit(T /*distance*/, T /*cos_light*/) const noexcept { return pdf_; }

    [[nodiscard]] LUMIS_HD T solid_angle() const noexcept { return solid_angle_; }

  private:
    using Shape = detail::FlatShape<Parallelogram<T>>;
    using Edges = typename Shape::Edges;
    using Vector = typename Shape::Vector;
    class Halves;

    LUMIS_INLINE explicit AreaLight(const Shape& shape) noexcept
        : view_{shape},
          rectangle_{shape.in_units().corner, shape.in_units().edge_u, shape.in_units().edge_v},
          solid_angle_{rectangle_.solid_angle()},
          unit_{static_cast<T>(shape.unit) * rectangle_.unit()} {
        if (!(rectangle_.has_digits() && detail::is_rectangle(shape))) {
            halves_ = split(Edges{shape.in_units()});
            solid_angle_ = halves_->solid_angle();
        }
        pdf_ = detail::uniform_density(solid_angle_);
    }

    // Takes a copy: compilers keep a whole light in memory if a call refers to any part of it.
    [[nodiscard]] LUMIS_NOINLINE static std::optional<Halves> split(const Edges& edges) noexcept {
        return Halves{edges.corner, edges.edge_u, edges.edge_v, edges.edge_u + edges.edge_v};
    }

    // Two triangles, each from an edge at the corner to the diagonal.
    class Halves {
      public:
        LUMIS_INLINE Halves(const Vector& a, const Vector& u, const Vector& v, const Vector& diagonal) noexcept
            : first_{a, a + u, a + diagonal, u, diagonal}, second_{a, a + v, a + diagonal, v, diagonal} {
            const Vector across = detail::cross(a, diagonal);
            to_first_ = glm::dot(u, across) > 0 ? across : -across;
            const T first = first_.solid_angle(), second = second_.solid_angle();
            share_ = real::quotient_where(first > 0 && second > 0, first, first + second);
        }

        // 0 if the reference point lies at a vertex or in the plane.
        [[nodiscard]] LUMIS_HD T solid_angle() const noexcept {
            return share_ > 0 ? first_.solid_angle() + second_.solid_angle() : T(0);
        }

        template <Real R>
        [[nodiscard]] LUMIS_HD Direction<R> sample(glm::vec<2, R> u) const noexcept {
            const T rest = 1 - share_;
            return real::either(
                u.x < share_,
                [&] {
                    return first_.sample(glm::vec<2, R>{real::divide(u.x, share_), u.y});
                },
                [&] {
                    return second_.sample(glm::vec<2, R>{real::quotient_where(rest > 0, R(1 - u.x), rest), u.y});
                });
        }

        [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Direction<T>& w) const noexcept {
            const bool in_first = glm::dot(w, to_first_) > 0;
            const glm::vec<2, T> u = in_first ? first_.invert(w) : second_.invert(w);
            return {in_first ? u.x * share_ : 1 - u.x * (1 - share_), u.y};
        }

      private:
        detail::SphericalTriangle<T> first_, second_;
        glm::vec<3, T> to_first_;  // normal to the plane through the diagonal
        T share_{0};               // of the first in the solid angle
    };

    detail::FlatView<Parallelogram<T>> view_;
    detail::SphericalRectangle<T> rectangle_;
    std::optional<Halves> halves_;  // where the shape is split
    T solid_angle_, pdf_, unit_;
};

}  // namespace lumis::LUMIS_ISA
