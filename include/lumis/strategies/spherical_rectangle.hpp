// A rectangle projected onto the unit sphere about a reference point, drawn evenly by solid angle.
// Urena, Fajardo and King 2013, "An Area-Preserving Parametrization for Spherical Rectangles".
#pragma once

#include "lumis/core/elementary.hpp"
#include "lumis/core/frame.hpp"
#include "lumis/core/sample.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <numbers>

namespace lumis {

template <std::floating_point T>
class SphericalRectangle {
  public:
    // A corner relative to the reference point, two orthogonal edges, and the solid angle, which the caller can compute
    // without the cancellation that a sum of angles less 2 pi has.
    SphericalRectangle(const glm::vec<3, T>& corner, const glm::vec<3, T>& edge_u, const glm::vec<3, T>& edge_v,
                       T solid_angle) noexcept
        : frame_{edge_u / glm::length(edge_u), edge_v / glm::length(edge_v),
                 glm::normalize(glm::cross(edge_u, edge_v))},
          solid_angle_{solid_angle} {
        near_ = frame_.to_local(corner);
        far_ = {near_.x + glm::length(edge_u), near_.y + glm::length(edge_v)};
        if (near_.z > 0) {
            near_.z = -near_.z;
            frame_ = {frame_.tangent(), frame_.bitangent(), -frame_.normal()};
        }
        b0_ = -near_.y / length(near_.y, near_.z);
        b1_ = far_.y / length(far_.y, near_.z);
        k_ = 2 * std::numbers::pi_v<T> - angle(near_.x * far_.y, near_.x, far_.y) -
             angle(-near_.x * near_.y, near_.x, near_.y);
        // Of a large rectangle the sum of angles keeps its digits, and a caller's sum of triangles does not where their
        // common edge passes close by the reference point.
        if (solid_angle_ > 1) {
            solid_angle_ = angle(near_.y * far_.x, far_.x, near_.y) + angle(-far_.x * far_.y, far_.x, far_.y) - k_;
        }
    }

    [[nodiscard]] T solid_angle() const noexcept { return solid_angle_; }

    // Relative to the reference point, on the rectangle. u.x goes along the first edge, u.y along the second.
    template <RealOf<T> R = T>
    [[nodiscard]] glm::vec<3, R> sample(glm::vec<2, R> u) const noexcept {
        const auto a = unit_circle(R((u.x * solid_angle_ + k_) * (std::numbers::inv_pi_v<T> / 2)));
        const R f = (a.x * b0_ - b1_) / a.y;
        // f^2 + b0^2 - 1, with 1 - b0^2 formed as a square.
        const T z_share = near_.z / length(near_.y, near_.z);
        const R below = real::max(R((f - z_share) * (f + z_share)), 0);
        const R x = real::clamp(real::copysign(R(near_.z / real::sqrt(below)), f), near_.x, far_.x);
        const R d = length(x, R(near_.z));
        const R h0 = near_.y / length(d, R(near_.y)), h1 = far_.y / length(d, R(far_.y));
        const R h = h0 + u.y * (h1 - h0);
        const R y = real::clamp(R(h * d / real::sqrt(R((1 - h) * (1 + h)))), near_.y, far_.y);
        return frame_.to_world(glm::vec<3, R>{x, y, near_.z});
    }

    // position: relative to the reference point, on the rectangle or towards it.
    [[nodiscard]] glm::vec<2, T> invert(const glm::vec<3, T>& position) const noexcept {
        const glm::vec<3, T> local = frame_.to_local(position);
        const T x = local.x * (near_.z / local.z), y = local.y * (near_.z / local.z);
        const T d = length(x, near_.z);
        const T h0 = near_.y / length(d, near_.y), h1 = far_.y / length(d, far_.y);
        const T a = angle(near_.y * x, x, near_.y) + angle(-x * far_.y, x, far_.y);
        return {(a - k_) / solid_angle_, (y / length(d, y) - h0) / (h1 - h0)};
    }

  private:
    template <Real R>
    static R length(R x, R y) noexcept {
        return real::sqrt(R(x * x + y * y));
    }

    // acos(cosine / (|(x, z)| |(y, z)|)), by its tangent.
    [[nodiscard]] T angle(T cosine, T x, T y) const noexcept {
        const T z = near_.z;
        return std::atan2(std::abs(z) * std::sqrt(x * x + y * y + z * z), cosine);
    }

    Frame<T> frame_;
    glm::vec<3, T> near_;  // the corner, in the frame
    glm::vec<2, T> far_;   // x and y of the opposite corner
    T solid_angle_, b0_, b1_, k_;
};

}  // namespace lumis
