// A disk as seen from a reference point: points on it evenly by area, rays that meet it, and what the surface is there.
#pragma once

#include "lumis/core/frame.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/spherical.hpp"
#include "lumis/lights/shapes.hpp"
#include "lumis/lights/surface.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

namespace lumis::LUMIS_ISA::detail {

template <Real T>
class DiskView {
  public:
    LUMIS_INLINE DiskView(const Disk<T>& disk, const glm::vec<3, T>& reference_point) noexcept
        : DiskView{disk, reference_point, is_squared_length(T(glm::dot(disk.normal, disk.normal)))} {}
    LUMIS_INLINE DiskView(const Disk<T>& disk, const glm::vec<3, T>& reference_point, Sides sides) noexcept
        : DiskView{disk, reference_point} {
        if (sides == Sides::Both) return;
        const auto behind = height_ > 0;
        radius_ = real::select(behind, T(0), radius_);
        height_ = real::select(behind, T(0), height_);
    }

    [[nodiscard]] LUMIS_HD T area() const noexcept { return std::numbers::pi_v<scalar_of<T>> * radius_ * radius_; }
    [[nodiscard]] LUMIS_HD T radius() const noexcept { return radius_; }
    [[nodiscard]] LUMIS_HD const Frame<T>& frame() const noexcept { return frame_; }

    // u.x = 0 is the centre, u.y a fraction of a turn.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD SurfaceSample<R> sample(glm::vec<2, R> u) const noexcept {
        using Vector = glm::vec<3, R>;
        const R distance = radius_ * real::sqrt(u.x);
        const auto circle = unit_circle(u.y);
        const Vector across = circle.x * Vector(frame_.tangent()) + circle.y * Vector(frame_.bitangent());
        return {Vector(center_) + distance * across, height_};
    }

    // The surface at the point that sample draws.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface(const Disk<T>& disk, const glm::vec<2, R>& u) const noexcept {
        const auto circle = unit_circle(u.y);
        return {position_at(disk, R(radius_ * real::sqrt(u.x)) * circle), Direction<R>(frame_.normal()), u};
    }

    // The surface where a unit vector w meets the disk as `met` says; where rounding has put w beside it, that of the rim's
    // nearest point.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface(const Disk<T>& disk, const Direction<R>& w,
                                                       const SurfaceHit<R>& met) const noexcept {
        using Vector = glm::vec<3, R>;
        const Vector across = real::rounded(met.distance * w - Vector(center_));
        const R x = glm::dot(across, Vector(frame_.tangent())), y = glm::dot(across, Vector(frame_.bitangent()));
        const R reach = real::sqrt(R(x * x + y * y)), radius = radius_;
        const R inward = real::select(reach > radius, real::quotient_where(reach > radius, radius, reach), 1);
        const R share = real::quotient_where(MaskOf<R>(radius > 0), real::lesser(reach, radius), radius);
        return {position_at(disk, inward * glm::vec<2, R>{x, y}), Direction<R>(frame_.normal()),
                glm::vec<2, R>{share * share, turn_of(x, y)}};
    }

    // w: unit. The rim gives way by the rounding of w, so that a direction drawn to it meets the disk.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD SurfaceHit<R> intersect(const Direction<R>& w) const noexcept {
        const R cos_light = glm::dot(w, Direction<R>(frame_.normal()));
        const R distance = real::quotient_where(real::abs(cos_light) > 0, R(height_), cos_light);
        // Both sides times the cosine, which may be next to 0.
        const R radius = radius_ * real::abs(cos_light) + 4 * std::numeric_limits<T>::epsilon() * distance;
        const glm::vec<3, R> across = real::rounded(R(height_) * w - cos_light * glm::vec<3, R>(center_));
        return hit_if(distance > 0 && glm::dot(across, across) <= radius * radius, distance, cos_light);
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Direction<T>& w) const noexcept {
        const T cos_light = glm::dot(w, frame_.normal());
        const T distance = real::quotient_where(real::abs(cos_light) > 0, height_, cos_light);
        const glm::vec<3, T> across = real::rounded(distance * w - center_);
        const T inverse = real::quotient_where(radius_ > 0, T(1), radius_);
        const T x = glm::dot(across, frame_.tangent()) * inverse, y = glm::dot(across, frame_.bitangent()) * inverse;
        return {x * x + y * y, turn_of(x, y)};
    }

  private:
    // The frame is made once: compilers keep a view in memory if a part of it is replaced in a branch.
    LUMIS_INLINE DiskView(const Disk<T>& disk, const glm::vec<3, T>& reference_point, MaskOf<T> has_normal) noexcept
        : center_{real::rounded(disk.center - reference_point)},
          radius_{real::select(has_normal && disk.radius > 0, disk.radius, 0)},
          frame_{real::select(has_normal, real::divide(disk.normal, length_where(has_normal, disk.normal)),
                              Direction<T>{T(0), T(0), T(1)})},
          height_{glm::dot(center_, frame_.normal())} {
        LUMIS_ASSERT(real::all(!is_nan(disk) && !is_nan(reference_point)));
    }

    [[nodiscard]] LUMIS_INLINE static T length_where(const MaskOf<T>& condition, const glm::vec<3, T>& v) noexcept {
        return real::sqrt(real::divisor_where(condition, T(glm::dot(v, v))));
    }

    template <Real R>
    [[nodiscard]] LUMIS_INLINE glm::vec<3, R> position_at(const Disk<T>& disk,
                                                          const glm::vec<2, R>& across) const noexcept {
        using Vector = glm::vec<3, R>;
        return Vector(disk.center) + (across.x * Vector(frame_.tangent()) + across.y * Vector(frame_.bitangent()));
    }

    glm::vec<3, T> center_;  // relative to the reference point
    T radius_;
    Frame<T> frame_;
    T height_;  // of the plane over the reference point, along the normal; signed
};

}  // namespace lumis::LUMIS_ISA::detail

namespace lumis::LUMIS_ISA {

template <Real T, std::same_as<Sides>... S>
[[nodiscard]] LUMIS_INLINE inline auto seen_from(const Disk<T>& shape, const glm::vec<3, T>& reference_point,
                                                 S... sides) noexcept {
    return detail::DiskView<T>{shape, reference_point, sides...};
}

}  // namespace lumis::LUMIS_ISA
