// Lights of finite area by the directions in which they are seen, evenly: the density is 1 / solid angle over the light.
// World space. A light that subtends nothing (no area, edge-on, reference point at a vertex) draws nothing.
#pragma once

#include "lumis/strategies/area_light.hpp"
#include "lumis/strategies/spherical_rectangle.hpp"
#include "lumis/strategies/spherical_triangle.hpp"

#include <concepts>
#include <limits>
#include <optional>

namespace lumis {

namespace detail {

// Nothing where rounding has put the direction beside the light, or left none: of a sliver not wider than its coordinates' last
// place. On a sphere's surface the distance is 0.
template <Real R>
[[nodiscard]] LightSample<Direction<R>, R> seen_at(const Direction<R>& w, scalar_of<R> pdf, R distance) noexcept {
    constexpr auto rounding = 64 * std::numeric_limits<R>::epsilon();
    const auto seen =
        real::abs(R(glm::dot(w, w) - 1)) <= rounding && distance >= 0 && distance <= std::numeric_limits<R>::max();
    return {real::select(seen, w, Direction<R>{}), real::select(seen, R(pdf), 0), real::select(seen, distance, 0)};
}

}  // namespace detail

// The sphere's cone of directions evenly (Shirley, Wang and Zimmerman 1996); from inside, all directions evenly.
template <std::floating_point T>
class AreaLight<Sphere<T>, BySolidAngle> {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    [[gnu::always_inline]] AreaLight(const Sphere<T>& sphere, const glm::vec<3, T>& reference_point) noexcept
        : view_{sphere, reference_point}, pdf_{density_or_zero(1 / view_.solid_angle())} {}

    // u.x = 0 is the centre of the cone.
    template <RealOf<T> R = T>
    [[nodiscard, gnu::always_inline]] LightSample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        const auto [direction, distance] = view_.direction(u);
        return detail::seen_at(direction, pdf_, distance);
    }

    [[nodiscard]] glm::vec<2, T> invert(const Point& w) const noexcept { return view_.invert(w); }

    template <RealOf<T> R = T>
    [[nodiscard]] R pdf(const Direction<R>& w) const noexcept {
        return real::select(view_.contains(w), R(pdf_), 0);
    }

    [[nodiscard]] T pdf_from_hit(T /*distance*/, T /*cos_light*/) const noexcept { return pdf_; }

    [[nodiscard]] T solid_angle() const noexcept { return view_.solid_angle(); }

  private:
    SphereView<T> view_;
    T pdf_;
};

// Arvo 1995, in a form that keeps its digits for tiny triangles, see spherical_triangle.hpp.
template <std::floating_point T>
class AreaLight<Triangle<T>, BySolidAngle> {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    AreaLight(const Triangle<T>& triangle, const glm::vec<3, T>& reference_point) noexcept
        : view_{triangle, reference_point},
          seen_{view_.corner(), view_.corner() + view_.edge_u(), view_.corner() + view_.edge_v(), view_.edge_u(),
                view_.edge_v()},
          pdf_{view_.edge_on() ? T(0) : density_or_zero(1 / seen_.solid_angle())} {}

    // u.x cuts off a share of the solid angle by an arc from a to the edge bc; u.y goes along that arc.
    template <RealOf<T> R = T>
    [[nodiscard]] LightSample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        const Direction<R> w = seen_.sample(u);
        return detail::seen_at(w, pdf_, view_.distance_along(w));
    }

    template <RealOf<T> R = T>
    [[nodiscard]] R pdf(const Direction<R>& w) const noexcept {
        return real::select(view_.intersect(w).distance > 0, R(pdf_), 0);
    }

    [[nodiscard]] glm::vec<2, T> invert(const Point& w) const noexcept { return seen_.invert(w); }

    [[nodiscard]] T pdf_from_hit(T /*distance*/, T /*cos_light*/) const noexcept { return pdf_; }

    [[nodiscard]] T solid_angle() const noexcept { return view_.edge_on() ? T(0) : seen_.solid_angle(); }

  private:
    FlatView<Triangle<T>> view_;
    SphericalTriangle<T> seen_;
    T pdf_;
};

// A rectangle by Urena, Fajardo and King 2013, which moves along both edges evenly. A parallelogram that is not a
// rectangle, and a rectangle so small that their sums of angles have no digits left, is split by a diagonal into two
// spherical triangles. Both are exactly even over the solid angle, so the density does not tell them apart.
template <std::floating_point T>
class AreaLight<Parallelogram<T>, BySolidAngle> {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    AreaLight(const Parallelogram<T>& shape, const glm::vec<3, T>& reference_point) noexcept
        : view_{shape, reference_point},
          first_{half(view_.edge_u(), view_.edge_u() + view_.edge_v())},
          second_{half(view_.edge_v(), view_.edge_u() + view_.edge_v())},
          solid_angle_{!view_.edge_on() && first_.solid_angle() > 0 && second_.solid_angle() > 0
                           ? first_.solid_angle() + second_.solid_angle()
                           : T(0)},
          pdf_{density_or_zero(1 / solid_angle_)} {
        constexpr T epsilon = std::numeric_limits<T>::epsilon();
        const T square = glm::dot(view_.edge_u(), view_.edge_u()) * glm::dot(view_.edge_v(), view_.edge_v());
        const bool is_rectangle = std::abs(glm::dot(view_.edge_u(), view_.edge_v())) <= 4 * epsilon * std::sqrt(square);
        // What Urena's angles lose, epsilon over the solid angle, is then below 1e-5 of the edges. They square the height.
        const T height = glm::dot(view_.corner(), glm::cross(view_.edge_u(), view_.edge_v()));
        if (is_rectangle && solid_angle_ > 1e5f * epsilon && is_squared_length(height * height)) {
            rectangle_.emplace(view_.corner(), view_.edge_u(), view_.edge_v(), solid_angle_);
            solid_angle_ = rectangle_->solid_angle();
            pdf_ = density_or_zero(1 / solid_angle_);
        }
    }

    // u.x goes along the first edge and u.y along the second or, where the shape is split, u.x from the first edge by way
    // of the diagonal to the second, and u.y away from the corner.
    template <RealOf<T> R = T>
    [[nodiscard]] LightSample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        const Direction<R> w = direction(u);
        return detail::seen_at(w, pdf_, view_.distance_along(w));
    }

    template <RealOf<T> R = T>
    [[nodiscard]] R pdf(const Direction<R>& w) const noexcept {
        return real::select(view_.intersect(w).distance > 0, R(pdf_), 0);
    }

    [[nodiscard]] glm::vec<2, T> invert(const Point& w) const noexcept {
        if (rectangle_) return rectangle_->invert(w);
        const T share = first_.solid_angle() / solid_angle_;
        const glm::vec<3, T> across = glm::cross(view_.corner(), view_.edge_u() + view_.edge_v());  // of the diagonal
        const bool in_first = glm::dot(w, across) * glm::dot(view_.edge_u(), across) > 0;
        const glm::vec<2, T> u = in_first ? first_.invert(w) : second_.invert(w);
        return {in_first ? u.x * share : 1 - u.x * (1 - share), u.y};
    }

    [[nodiscard]] T pdf_from_hit(T /*distance*/, T /*cos_light*/) const noexcept { return pdf_; }

    [[nodiscard]] T solid_angle() const noexcept { return solid_angle_; }

  private:
    template <Real R>
    [[nodiscard]] Direction<R> direction(glm::vec<2, R> u) const noexcept {
        if (rectangle_) return glm::normalize(rectangle_->sample(u));
        const T share = first_.solid_angle() / solid_angle_;
        return real::either(
            u.x < share,
            [&] {
                return first_.sample(glm::vec<2, R>{u.x / share, u.y});
            },
            [&] {
                return second_.sample(glm::vec<2, R>{(1 - u.x) / (1 - share), u.y});
            });
    }

    // The triangle of the corner and the ends of two vectors from it.
    [[nodiscard]] SphericalTriangle<T> half(const glm::vec<3, T>& ab, const glm::vec<3, T>& ac) const noexcept {
        return {view_.corner(), view_.corner() + ab, view_.corner() + ac, ab, ac};
    }

    FlatView<Parallelogram<T>> view_;
    SphericalTriangle<T> first_, second_;  // each from an edge to the diagonal, which may span half a turn
    T solid_angle_, pdf_;
    std::optional<SphericalRectangle<T>> rectangle_;
};

}  // namespace lumis
