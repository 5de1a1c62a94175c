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
[[nodiscard, gnu::always_inline]] inline LightSample<Direction<R>, R> seen_at(const Direction<R>& w, scalar_of<R> pdf,
                                                                              R distance) noexcept {
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

    // From the reference point to the light; infinity where w misses it.
    template <RealOf<T> R = T>
    [[nodiscard]] R distance_along(const Direction<R>& w) const noexcept {
        return distance_or_infinity(view_.intersect(w));
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

    [[gnu::always_inline]] AreaLight(const Triangle<T>& triangle, const glm::vec<3, T>& reference_point) noexcept
        : view_{triangle, reference_point},
          seen_{view_.corner(), view_.corner() + view_.edge_u(), view_.corner() + view_.edge_v(), view_.edge_u(),
                view_.edge_v()},
          pdf_{view_.edge_on() ? T(0) : density_or_zero(1 / seen_.solid_angle())} {}

    // u.x cuts off a share of the solid angle by an arc from a to the edge bc; u.y goes along that arc.
    template <RealOf<T> R = T>
    [[nodiscard, gnu::always_inline]] LightSample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        const Direction<R> w = seen_.sample(u);
        return detail::seen_at(w, pdf_, view_.distance_along(w));
    }

    template <RealOf<T> R = T>
    [[nodiscard]] R pdf(const Direction<R>& w) const noexcept {
        return real::select(view_.intersect(w).distance > 0, R(pdf_), 0);
    }

    [[nodiscard]] glm::vec<2, T> invert(const Point& w) const noexcept { return seen_.invert(w); }

    // From the reference point to the light; infinity where w misses it.
    template <RealOf<T> R = T>
    [[nodiscard]] R distance_along(const Direction<R>& w) const noexcept {
        return distance_or_infinity(view_.intersect(w));
    }

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

    [[gnu::always_inline]] AreaLight(const Parallelogram<T>& shape, const glm::vec<3, T>& reference_point) noexcept
        : view_{shape, reference_point}, rectangle_{view_.corner(), view_.edge_u(), view_.edge_v()} {
        constexpr T epsilon = std::numeric_limits<T>::epsilon();
        const glm::vec<3, T> corner = view_.corner(), u = view_.edge_u(), v = view_.edge_v();
        const T square = glm::dot(u, u) * glm::dot(v, v), volume = glm::dot(corner, glm::cross(u, v));
        solid_angle_ = rectangle_.solid_angle();
        // What Urena's angles lose, epsilon over the solid angle, has to be below 1e-5 of the edges. They square the volume.
        if (!(std::abs(glm::dot(u, v)) <= 4 * epsilon * real::sqrt(square) && is_squared_length(volume * volume) &&
              solid_angle_ > 1e5f * epsilon)) {
            halves_.emplace(
                Halves{{corner, corner + u, corner + u + v, u, u + v}, {corner, corner + v, corner + u + v, v, u + v}});
            const T first = halves_->first.solid_angle(), second = halves_->second.solid_angle();
            solid_angle_ = !view_.edge_on() && first > 0 && second > 0 ? first + second : T(0);
        }
        pdf_ = density_or_zero(1 / solid_angle_);
    }

    // u.x goes along the first edge and u.y along the second or, where the shape is split, u.x from the first edge by way
    // of the diagonal to the second, and u.y away from the corner.
    template <RealOf<T> R = T>
    [[nodiscard, gnu::always_inline]] LightSample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        if (halves_) {
            const Direction<R> w = halves_->sample(u);
            return detail::seen_at(w, pdf_, view_.distance_along(w));
        }
        const glm::vec<3, R> position = rectangle_.sample(u);
        const R distance = real::length(position);
        return detail::seen_at(position * (1 / distance), pdf_, distance * view_.unit());
    }

    template <RealOf<T> R = T>
    [[nodiscard]] R pdf(const Direction<R>& w) const noexcept {
        return real::select(view_.intersect(w).distance > 0, R(pdf_), 0);
    }

    [[nodiscard]] glm::vec<2, T> invert(const Point& w) const noexcept {
        if (!halves_) return rectangle_.invert(w);
        const auto& [first, second] = *halves_;
        const T share = halves_->share_of_first();
        const glm::vec<3, T> across = glm::cross(view_.corner(), view_.edge_u() + view_.edge_v());  // of the diagonal
        const bool in_first = glm::dot(w, across) * glm::dot(view_.edge_u(), across) > 0;
        const glm::vec<2, T> u = in_first ? first.invert(w) : second.invert(w);
        return {in_first ? u.x * share : 1 - u.x * (1 - share), u.y};
    }

    // From the reference point to the light; infinity where w misses it.
    template <RealOf<T> R = T>
    [[nodiscard]] R distance_along(const Direction<R>& w) const noexcept {
        return distance_or_infinity(view_.intersect(w));
    }

    [[nodiscard]] T pdf_from_hit(T /*distance*/, T /*cos_light*/) const noexcept { return pdf_; }

    [[nodiscard]] T solid_angle() const noexcept { return solid_angle_; }

  private:
    // Each from an edge to the diagonal, which may span half a turn.
    struct Halves {
        SphericalTriangle<T> first, second;

        [[nodiscard]] T share_of_first() const noexcept {
            return first.solid_angle() / (first.solid_angle() + second.solid_angle());
        }

        template <Real R>
        [[nodiscard]] Direction<R> sample(glm::vec<2, R> u) const noexcept {
            const T share = share_of_first();
            return real::either(
                u.x < share,
                [&] {
                    return first.sample(glm::vec<2, R>{u.x / share, u.y});
                },
                [&] {
                    return second.sample(glm::vec<2, R>{(1 - u.x) / (1 - share), u.y});
                });
        }
    };

    FlatView<Parallelogram<T>> view_;
    SphericalRectangle<T> rectangle_;
    std::optional<Halves> halves_;  // where it is not a rectangle, or too small a one
    T solid_angle_, pdf_;
};

}  // namespace lumis
