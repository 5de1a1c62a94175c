// A disk as seen from a reference point: points on it evenly by area, and rays that meet it.
#pragma once

#include "lumis/core/frame.hpp"
#include "lumis/core/spherical.hpp"
#include "lumis/strategies/shapes.hpp"
#include "lumis/strategies/surface.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

namespace lumis {

template <std::floating_point T>
class DiskView {
  public:
    DiskView(const Disk<T>& disk, const glm::vec<3, T>& reference_point) noexcept
        : center_{disk.center - reference_point},
          radius_{disk.radius > 0 && has_direction(disk.normal) ? disk.radius : T(0)},
          frame_{has_direction(disk.normal) ? disk.normal / real::length(disk.normal) : Direction<T>{0, 0, 1}},
          height_{glm::dot(center_, frame_.normal())} {
        LUMIS_ASSERT(!detail::is_nan(disk) && !detail::is_nan(reference_point));
    }

    [[nodiscard]] T area() const noexcept { return std::numbers::pi_v<T> * radius_ * radius_; }

    // u.x = 0 is the centre, u.y a fraction of a turn.
    template <RealOf<T> R = T>
    [[nodiscard]] SurfaceSample<R> sample(glm::vec<2, R> u) const noexcept {
        using Vector = glm::vec<3, R>;
        const R distance = radius_ * real::sqrt(u.x);
        const auto circle = unit_circle(u.y);
        const Vector across = circle.x * Vector(frame_.tangent()) + circle.y * Vector(frame_.bitangent());
        return {Vector(center_) + distance * across, height_};
    }

    // w: unit. The rim gives way by the rounding of w, so that a direction drawn to it meets the disk.
    template <RealOf<T> R = T>
    [[nodiscard]] SurfaceHit<R> intersect(const Direction<R>& w) const noexcept {
        const R cos_light = glm::dot(w, Direction<R>(frame_.normal()));
        const R inverse = 1 / cos_light, distance = height_ * inverse;
        const R radius = radius_ + 4 * std::numeric_limits<T>::epsilon() * distance * real::abs(inverse);
        const glm::vec<3, R> across = distance * w - glm::vec<3, R>(center_);
        return hit_if(distance > 0 && glm::dot(across, across) <= radius * radius, distance, cos_light);
    }

    [[nodiscard]] glm::vec<2, T> invert(const Direction<T>& w) const noexcept {
        const glm::vec<3, T> across = height_ / glm::dot(w, frame_.normal()) * w - center_;
        const T x = glm::dot(across, frame_.tangent()) / radius_, y = glm::dot(across, frame_.bitangent()) / radius_;
        return {x * x + y * y, turn_of(x, y)};
    }

  private:
    static bool has_direction(const glm::vec<3, T>& v) noexcept { return is_squared_length(glm::dot(v, v)); }

    glm::vec<3, T> center_;  // relative to the reference point
    T radius_;
    Frame<T> frame_;
    T height_;  // of the plane over the reference point, along the normal; signed
};

}  // namespace lumis
