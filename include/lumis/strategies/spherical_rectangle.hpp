// A rectangle projected onto the unit sphere about a reference point, drawn evenly by solid angle.
// Urena, Fajardo and King 2013, "An Area-Preserving Parametrization for Spherical Rectangles".
#pragma once

#include "lumis/core/elementary.hpp"
#include "lumis/core/frame.hpp"
#include "lumis/core/sample.hpp"

#include <glm/geometric.hpp>

#include <array>
#include <concepts>
#include <numbers>

namespace lumis {

template <std::floating_point T>
class SphericalRectangle {
  public:
    // A corner relative to the reference point, and two orthogonal edges.
    [[gnu::always_inline]] SphericalRectangle(const glm::vec<3, T>& corner, const glm::vec<3, T>& edge_u,
                                              const glm::vec<3, T>& edge_v) noexcept
        : SphericalRectangle{corner, edge_u / real::length(edge_u), edge_v / real::length(edge_v), real::length(edge_u),
                             real::length(edge_v)} {}

    [[nodiscard]] T solid_angle() const noexcept { return solid_angle_; }

    // Relative to the reference point, on the rectangle. u.x goes along the first edge, u.y along the second.
    template <RealOf<T> R = T>
    [[nodiscard, gnu::always_inline]] glm::vec<3, R> sample(glm::vec<2, R> u) const noexcept {
        const auto a = unit_circle(R(u.x * (solid_angle_ * (std::numbers::inv_pi_v<T> / 2)) + k_));
        const R f = (a.x * b0_ - b1_) / a.y;
        // f^2 + b0^2 - 1, with 1 - b0^2 formed as a square.
        const R below = real::max(R((f - z_share_) * (f + z_share_)), 0);
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
        const T a = turn_of_sum({near_.y * x, length(x, near_.y, near_.z)}, {-x * far_.y, length(x, far_.y, near_.z)});
        return {(a - k_) * (2 * std::numbers::pi_v<T>) / solid_angle_, (y / length(d, y) - h0) / (h1 - h0)};
    }

  private:
    // x, y: along the edges, which have these lengths.
    [[gnu::always_inline]] SphericalRectangle(const glm::vec<3, T>& corner, const Direction<T>& x,
                                              const Direction<T>& y, T width, T height) noexcept
        : frame_{frame_along(x, y, facing(corner, glm::cross(x, y)))},
          near_{frame_.to_local(corner)},
          far_{near_.x + width, near_.y + height} {
        const auto [x0, y0, z] = std::array{near_.x, near_.y, near_.z};
        const auto [x1, y1] = std::array{far_.x, far_.y};
        const T inverse = 1 / length(y0, z);
        b0_ = -y0 * inverse;
        z_share_ = z * inverse;
        b1_ = y1 / length(y1, z);
        const T a = length(x0, y0, z), b = length(x1, y0, z), c = length(x1, y1, z), d = length(x0, y1, z);
        k_ = 1 - turn_of_sum({x0 * y1, d}, {-x0 * y0, a});
        // Half the solid angles of the triangles a, b, c and a, c, d have the tangents volume / first and volume / second
        // (Van Oosterom and Strackee 1983), where first / (a b c) is one plus the cosines of the sides.
        const T ac = x0 * x1 + y0 * y1 + z * z;
        const T first = (a * b + x0 * x1 + y0 * y0 + z * z) * c + (x1 * x1 + y0 * y1 + z * z) * a + ac * b;
        const T second = (a * d + x0 * x0 + y0 * y1 + z * z) * c + (x0 * x1 + y1 * y1 + z * z) * a + ac * d;
        const T volume = -z * width * height;
        if (4 * first >= a * b * c && 4 * second >= a * c * d) {
            solid_angle_ =
                4 * std::numbers::pi_v<T> * signed_turn_of(first * second - volume * volume, volume * (first + second));
        } else {
            // Those cosines cancel where a side spans nearly half a turn; the sum of angles is right to an epsilon of a turn.
            const T outer = turn_of_sum({y0 * x1, b}, {-x1 * y1, c});
            solid_angle_ = 2 * std::numbers::pi_v<T> * (outer - k_);
        }
    }

    // Edges that are not orthogonal, or have no length, make no rectangle, whatever its frame.
    static Frame<T> frame_along(const Direction<T>& x, const Direction<T>& y, const Direction<T>& normal) noexcept {
        if (detail::are_orthonormal(x, y, normal)) return {x, y, normal};
        return Frame<T>{Direction<T>{0, 0, 1}};
    }

    // The one of two opposite normals to which z is negative.
    static Direction<T> facing(const glm::vec<3, T>& corner, const Direction<T>& normal) noexcept {
        return glm::dot(corner, normal) > 0 ? -normal : normal;
    }

    template <Real R>
    static R length(R x, R y) noexcept {
        return real::sqrt(R(x * x + y * y));
    }
    static T length(T x, T y, T z) noexcept { return real::length(glm::vec<3, T>{x, y, z}); }

    // The sum of two angles at corners, in turns. The planes from the reference point through the edges that meet at (x, y)
    // have an angle of cosine and sine in proportion to -+x y, which is p.x, and |z| times the corner's distance, p.y.
    [[nodiscard]] T turn_of_sum(const glm::vec<2, T>& p, const glm::vec<2, T>& q) const noexcept {
        const T p_sine = -near_.z * p.y, q_sine = -near_.z * q.y;
        return turn_of(p.x * q.x - p_sine * q_sine, p.x * q_sine + p_sine * q.x);
    }

    Frame<T> frame_;
    glm::vec<3, T> near_;  // the corner, in the frame
    glm::vec<2, T> far_;   // x and y of the opposite corner
    T solid_angle_;
    T b0_, b1_;  // cosines between the normals of the planes through the edges along u, and the rectangle's
    T z_share_;  // sqrt(1 - b0^2)
    T k_;        // a turn less the angles at the first edge along v, in turns
};

}  // namespace lumis
