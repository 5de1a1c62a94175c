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
          radius_{disk.radius > 0 ? disk.radius : T(0)},
          frame_{disk.normal / glm::length(disk.normal)},
          height_{glm::dot(center_, frame_.normal())} {}

    [[nodiscard]] T area() const noexcept { return std::numbers::pi_v<T> * radius_ * radius_; }

    // u.x = 0 is the centre, u.y a fraction of a turn.
    [[nodiscard]] SurfaceSample<T> sample(glm::vec<2, T> u) const noexcept {
        const T distance = radius_ * std::sqrt(u.x);
        const auto circle = unit_circle(u.y);
        return {center_ + distance * (circle.x * frame_.tangent() + circle.y * frame_.bitangent()), height_};
    }

    // w: unit. The rim gives way by the rounding of w, so that a direction drawn to it meets the disk.
    [[nodiscard]] SurfaceHit<T> intersect(const Direction<T>& w) const noexcept {
        const T cos_light = glm::dot(w, frame_.normal());
        const T distance = height_ / cos_light;
        const T rounding = 4 * std::numeric_limits<T>::epsilon() * distance / std::abs(cos_light);
        if (!(distance > 0 && glm::length(distance * w - center_) <= radius_ + rounding)) return {};
        return {distance, cos_light};
    }

    [[nodiscard]] glm::vec<2, T> invert(const Direction<T>& w) const noexcept {
        const glm::vec<3, T> across = height_ / glm::dot(w, frame_.normal()) * w - center_;
        const T x = glm::dot(across, frame_.tangent()) / radius_, y = glm::dot(across, frame_.bitangent()) / radius_;
        return {x * x + y * y, turn_of(x, y)};
    }

  private:
    glm::vec<3, T> center_;  // relative to the reference point
    T radius_;
    Frame<T> frame_;
    T height_;  // of the plane over the reference point, along the normal; signed
};

}  // namespace lumis
