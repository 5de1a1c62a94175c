// A sphere as seen from a reference point: points on it evenly by area, directions towards it evenly by solid angle, rays
// that meet it, and what the surface is there. From outside only its front counts; from inside all of it.
#pragma once

#include "lumis/core/frame.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/spherical.hpp"
#include "lumis/lights/detail/wide.hpp"
#include "lumis/lights/shapes.hpp"
#include "lumis/lights/surface.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

namespace lumis::LUMIS_ISA::detail {

template <Real T>
class SphereView {
  public:
    // A sphere whose radius is not positive, or a number out of range, subtends nothing; nor does one from its own surface,
    // to which the distance is 0.
    LUMIS_INLINE SphereView(const Sphere<T>& sphere, const glm::vec<3, T>& reference_point,
                            Sides sides = Sides::Both) noexcept
        : center_{real::rounded(sphere.center - reference_point)},
          radius_{sphere.radius},
          axis_{Direction<T>{T(0), T(0), T(1)}} {
        LUMIS_ASSERT(real::all(!is_nan(sphere) && !is_nan(reference_point)));
        // In double: just above the surface the rounding of a float distance is as large as the height.
        using Wide = detail::Wide<T>;
        const glm::vec<3, Wide> center{center_};
        const Wide squared = glm::dot(center, center), r{radius_};
        distance_ = real::sqrt(static_cast<T>(squared));
        tangent_squared_ = static_cast<T>(real::rounded(Wide(squared - r * r)));
        inside_ = tangent_squared_ < 0;
        const auto has_axis = is_squared_length(T(distance_ * distance_));
        if (real::any(has_axis)) {
            const Direction<T> to_center = real::divide(center_, real::divisor_where(has_axis, distance_));
            axis_ = Frame<T>{real::select(has_axis, to_center, axis_.normal())};
        }
        const T tangent = real::sqrt_or_zero(tangent_squared_);
        const T sine = real::quotient_where(distance_ > 0, radius_, distance_);
        versine_ = sine * real::quotient_where(distance_ > 0, radius_, T(distance_ + tangent));
        if (real::any(inside_)) versine_ = real::select(inside_, T(2), versine_);
        chord_ = real::sqrt_or_zero(2 * versine_) + 8 * std::numeric_limits<T>::epsilon();
        const auto touches = tangent_squared_ == 0;
        const auto seen =
            (has_axis || inside_) && !touches && radius_ > 0 && radius_ <= (std::numeric_limits<T>::max)();
        if (!real::all(seen)) {
            versine_ = real::select(seen, versine_, 0);
            radius_ = real::select(seen, radius_, 0);
        }
        if (sides == Sides::One) {
            versine_ = real::select(inside_, T(0), versine_);
            radius_ = real::select(inside_, T(0), radius_);
            chord_ = real::select(inside_, T(-1), chord_);
            inside_ = MaskOf<T>(false);
        }
    }

    [[nodiscard]] LUMIS_HD T area() const noexcept { return 4 * std::numbers::pi_v<scalar_of<T>> * radius_ * radius_; }

    [[nodiscard]] LUMIS_HD T solid_angle() const noexcept { return 2 * std::numbers::pi_v<scalar_of<T>> * versine_; }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD SurfaceSample<R> sample(glm::vec<2, R> u) const noexcept {
        const Direction<R> normal = direction_at(R(2 * u.x), u.y);
        SurfaceSample<R> drawn{glm::vec<3, R>(center_) + R(radius_) * normal};
        const R towards = -glm::dot(drawn.position, normal);
        drawn.cos_times_distance = real::either(
            inside_, [&] { return towards; }, [&] { return real::greater(towards, 0); });
        return drawn;
    }

    // The surface at the point that sample draws.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface(const Sphere<T>& sphere,
                                                       const glm::vec<2, R>& u) const noexcept {
        return surface_at(sphere, direction_at(R(2 * u.x), u.y), u);
    }

    // The surface at the point that direction draws. The normal keeps its digits, which w lacks where the sphere is small and
    // far away.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface_of_direction(const Sphere<T>& sphere,
                                                                    const glm::vec<2, R>& u) const noexcept {
        const R versine = u.x * versine_;
        return surface_around_axis(sphere, sine_of_versine(versine), R(1 - versine), unit_circle(u.y));
    }

    // The surface at the point in the direction of a unit vector w.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface(const Sphere<T>& sphere, const Direction<R>& w,
                                                       const SurfaceHit<R>&) const noexcept {
        const Direction<R> local = axis_.to_local(w);
        const R sine = real::sqrt(R(local.x * local.x + local.y * local.y));
        const R inverse = real::quotient_where(sine > 0, R(scalar_of<R>(1)), sine);
        return surface_around_axis(sphere, sine, local.z, glm::vec<2, R>{local.x * inverse, local.y * inverse});
    }

    template <Real R>
    struct Ray {
        Direction<R> direction;
        R distance;
    };

    // Evenly over the cone; u.x = 0 is its axis. Its height, 1 - cos of its half-angle, is formed as sin^2 / (1 + cos):
    // the textbook difference is wrong by 291 % at 0.01 degree in float.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE Ray<R> direction(glm::vec<2, R> u) const noexcept {
        const R versine = u.x * versine_;
        const Direction<R> local = direction_at(versine, u.y);
        return {axis_.to_world(local), distance_along(distance_ * local.z, distance_ * sine_of_versine(versine))};
    }

    // The u of a direction towards the sphere.
    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert_direction(const Direction<T>& w) const noexcept {
        const glm::vec<3, T> chord = real::rounded(w - axis_.normal());
        const Direction<T> local = axis_.to_local(w);
        return {real::quotient_where(versine_ > 0, T(glm::dot(chord, chord)), 2 * versine_), turn_of(local.x, local.y)};
    }

    // Whether w points at the sphere. The chord between w and the axis keeps its digits where their cosine has none;
    // it gives way by the rounding of w, so that a direction drawn at the rim is found on the sphere.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD MaskOf<R> contains(const Direction<R>& w) const noexcept {
        return inside_ || real::length(real::rounded(w - Direction<R>(axis_.normal()))) <= chord_;
    }

    // Where the line passes the centre follows from the chord too: from the centre itself, it is rounded by as much as the
    // sphere is far away.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD SurfaceHit<R> intersect(const Direction<R>& w) const noexcept {
        const Direction<R> chord = real::rounded(w - Direction<R>(axis_.normal()));
        const R versine = glm::dot(chord, chord) / 2, sine = real::sqrt_or_zero(R(versine * (2 - versine)));
        const R along = distance_ * (1 - versine), across = distance_ * sine;
        return hit_if(inside_ || (along > 0 && contains(w)), distance_along(along, across),
                      real::quotient_where(MaskOf<R>(R(radius_) > 0), half_chord_at(across), R(radius_)));
    }

  private:
    // The surface at the point in a direction at a polar angle from the axis, and at a turn around it given as (cos, sin).
    //
    //            P        With the angle theta at the reference point O and gamma at P, the normal at P is gamma - theta away
    //     O ------- C     from CO, or from inside gamma + theta from OC. The distance from C to the line OP is r sin(gamma).
    template <Real R>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface_around_axis(const Sphere<T>& sphere, R sine, R cosine,
                                                                   const glm::vec<2, R>& turn) const noexcept {
        const R across = real::lesser(R(distance_ * sine), radius_), radius = radius_;
        const auto is_sphere = radius > 0;
        const R sin_gamma = real::quotient_where(is_sphere, across, radius);
        const R half_chord = real::quotient_where(is_sphere, half_chord_at(across), radius);
        const R cos_gamma = real::select(MaskOf<R>(inside_), half_chord, R(-half_chord));
        const R away = sin_gamma * cosine + cos_gamma * sine, along = cos_gamma * cosine - sin_gamma * sine;
        const Direction<R> normal = axis_.to_world(Direction<R>{away * turn.x, away * turn.y, along});
        return surface_at(sphere, normal, glm::vec<2, R>{versine_of(normal) / 2, turn_of(normal.x, normal.y)});
    }

    template <Real R>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface_at(const Sphere<T>& sphere, const Direction<R>& normal,
                                                          const glm::vec<2, R>& uv) const noexcept {
        return {glm::vec<3, R>(sphere.center) + R(radius_) * normal, normal, uv};
    }

    // Half the length of the chord that a line cuts out of the sphere when it passes its centre at a distance `across`.
    template <Real R>
    [[nodiscard]] LUMIS_HD R half_chord_at(R across) const noexcept {
        return real::sqrt_or_zero(R(real::rounded(radius_ - across) * (radius_ + across)));
    }

    // To the first point on the sphere ahead, for a ray whose closest approach to the centre is `along` ahead and
    // `across` aside. From outside, along - half chord would cancel; the product of both roots does not.
    template <Real R>
    [[nodiscard]] LUMIS_HD R distance_along(R along, R across) const noexcept {
        const R far_root = along + half_chord_at(across);
        return real::either(
            inside_, [&] { return far_root; },
            [&] { return real::quotient_where(far_root > 0, R(tangent_squared_), far_root); });
    }

    glm::vec<3, T> center_;  // relative to the reference point
    T radius_;
    T distance_;         // to the centre
    T tangent_squared_;  // of the tangent's length; negative inside
    MaskOf<T> inside_;
    Frame<T> axis_;  // its normal points at the centre
    T versine_;      // 1 - cos of the half-angle subtended; 2 from inside
    T chord_;        // longest |w - axis| of a direction w that points at the sphere
};

}  // namespace lumis::LUMIS_ISA::detail

namespace lumis::LUMIS_ISA {

template <Real T>
[[nodiscard]] LUMIS_INLINE inline auto seen_from(const Sphere<T>& shape, const glm::vec<3, T>& reference_point,
                                                 Sides sides = Sides::Both) noexcept {
    return detail::SphereView<T>{shape, reference_point, sides};
}

}  // namespace lumis::LUMIS_ISA
