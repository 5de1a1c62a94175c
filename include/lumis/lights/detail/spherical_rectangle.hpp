// A rectangle projected onto the unit sphere about a reference point, drawn evenly by solid angle.
// Urena, Fajardo and King 2013, "An Area-Preserving Parametrization for Spherical Rectangles". In a frame with axes along
// the edges the rectangle is [x0, x1] x [y0, y1] at the height z0 < 0:
//
//       y1  d ---------- c
//           |            |       u.x moves the line at x from the edge ad to the edge bc, u.y a point along that line.
//       y0  a ---------- b
//           x0          x1
#pragma once

#include "lumis/core/elementary.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/lights/detail/flat_shape.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

namespace lumis::LUMIS_ISA::detail {

template <std::floating_point T>
class SphericalRectangle {
    using Wide = detail::Wide<T>;

  public:
    using Vector = glm::vec<3, Wide>;

    // A corner relative to the reference point, and two orthogonal edges; of others the result means nothing. 0 sr without
    // area and edge-on.
    LUMIS_INLINE SphericalRectangle(const Vector& corner, const Vector& edge_u, const Vector& edge_v) noexcept {
        const Wide width = real::length(edge_u), height = real::length(edge_v);
        if (!(width > 0 && height > 0)) return;
        const Vector x = real::divide(edge_u, width), y = real::divide(edge_v, height), up = glm::cross(x, y);
        const Wide above = glm::dot(corner, up), z = -std::abs(above);
        if (!(z < 0)) return;
        x_ = x;
        y_ = y;
        z_ = above > 0 ? -up : up;
        const Wide x0 = glm::dot(corner, x), y0 = glm::dot(corner, y), x1 = x0 + width, y1 = y0 + height;
        unit_ = power_of_two(static_cast<T>(real::greater(width, height)));
        near_ = Vector{x0, y0, z} * (1 / Wide{unit_});
        far_ = glm::vec<2, Wide>{x1, y1} * (1 / Wide{unit_});
        const Wide zz = z * z, xx0 = x0 * x0 + zz, xx1 = x1 * x1 + zz, yy0 = y0 * y0 + zz, yy1 = y1 * y1 + zz;
        const Wide inverse = real::divide(Wide(1), real::sqrt(yy0));
        b0_ = static_cast<T>(-y0 * inverse);
        b1_ = static_cast<T>(real::divide(y1, real::sqrt(yy1)));
        z_share_ = static_cast<T>(z * inverse);

        // Distances of the corners. A turn less the angles at a and d; and the angles at b and c.
        const Wide a = real::sqrt(xx0 + y0 * y0), b = real::sqrt(xx1 + y0 * y0);
        const Wide c = real::sqrt(xx1 + y1 * y1), d = real::sqrt(xx0 + y1 * y1);
        const Wide k = 1 - turn_of_sum<Wide>(z, {x0 * y1, d}, {-x0 * y0, a});
        k_ = static_cast<T>(k);
        if (x0 * x1 + y0 * y1 + zz < Wide(-0.75) * a * c) {
            // The diagonal ac spans nearly half a turn. Then of a wide rectangle the sum of angles has digits enough.
            const Wide outer = turn_of_sum<Wide>(z, {y0 * x1, b}, {-x1 * y1, c});
            solid_angle_ = static_cast<T>(2 * std::numbers::pi_v<Wide> * (outer - k));
            has_digits_ = solid_angle_ > T(0.5);
            if (has_digits_) return;
        }
        // Half the solid angles E of the triangles abc and acd have the tangents volume / sum (Van Oosterom and Strackee
        // 1983), where sum is 1 plus the cosines of the sides. For unit vertices
        //     sum of abc = (1 + a.b)(1 + b.c) + (b x a).(b x c),
        // which cancels nowhere unless the diagonal ac spans nearly half a turn. Here it is times a b^2 c, that of acd times
        // c d^2 a.
        const Wide area = width * height, volume = -z * area, w2 = width * width, h2 = height * height;
        const Wide ab = sum_of_products(a * b, x0 * x1 + yy0, w2 * yy0),
                   cd = sum_of_products(c * d, x0 * x1 + yy1, w2 * yy1);
        const Wide bc = sum_of_products(b * c, y0 * y1 + xx1, h2 * xx1),
                   da = sum_of_products(d * a, y0 * y1 + xx0, h2 * xx0);
        const Wide abc = real::rounded(ab * bc + area * x1 * y0), acd = real::rounded(cd * da + area * x0 * y1);
        const Wide turn =
            signed_turn_of(real::rounded(abc * acd - volume * volume * (b * d)), volume * (abc * d + acd * b));
        solid_angle_ = static_cast<T>(4 * std::numbers::pi_v<Wide> * turn);
        // Urena's angles lose epsilon over the solid angle, and more at a grazing view, z / rho; and those of a narrow
        // rectangle that is much longer than it is far away are too near to half a turn.
        constexpr Wide enough = 1e5f * std::numeric_limits<T>::epsilon();
        const Wide outside_x = real::greater(real::greater(x0, -x1), 0),
                   outside_y = real::greater(real::greater(y0, -y1), 0);
        const Wide rho_squared = outside_x * outside_x + outside_y * outside_y, least = a * c / 32;
        const Wide omega = solid_angle_, grazing = omega * 8 / enough;
        has_digits_ = omega > enough && grazing * grazing * zz > rho_squared &&
                      (omega > Wide(0.5) || (abc >= least * (b * b) && acd >= least * (d * d)));
    }

    [[nodiscard]] LUMIS_HD T solid_angle() const noexcept { return solid_angle_; }

    // Whether samples are even up to 1e-4 of the edges.
    [[nodiscard]] LUMIS_HD bool has_digits() const noexcept { return has_digits_; }

    // The unit of its points.
    [[nodiscard]] LUMIS_HD T unit() const noexcept { return unit_; }

    // Relative to the reference point, on the rectangle. u.x goes along the first edge, u.y along the second.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE glm::vec<3, R> sample(glm::vec<2, R> u) const noexcept {
        const auto a = unit_circle(R(u.x * (solid_angle_ * (std::numbers::inv_pi_v<T> / 2)) + k_));
        // x = z0 / sqrt(f^2 + b0^2 - 1) of the sign of f = numerator / sin a, with 1 - b0^2 formed as a square. The numerator
        // is negative.
        const R numerator = real::rounded(a.x * b0_ - b1_), share = z_share_ * a.y;
        const R below = real::rounded(numerator - share) * real::rounded(numerator + share);
        const R x = real::clamp(ratio(R(near_.z * a.y), below), near_.x, far_.x);
        const R d = length(x, R(near_.z));
        const R h0 = sine(R(near_.y), d), h1 = sine(R(far_.y), d);
        const R h = real::rounded(h0 + u.y * (h1 - h0));
        const R y = real::clamp(ratio(R(h * d), R(real::rounded(1 - h) * real::rounded(1 + h))), near_.y, far_.y);
        return x * Direction<R>(x_) + y * Direction<R>(y_) + R(near_.z) * Direction<R>(z_);
    }

    // position: relative to the reference point, on the rectangle or towards it.
    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const glm::vec<3, T>& position) const noexcept {
        const glm::vec<3, T> local{glm::dot(position, x_), glm::dot(position, y_), glm::dot(position, z_)};
        const T to_plane = real::quotient_where(local.z < 0, near_.z, local.z), x = local.x * to_plane,
                y = local.y * to_plane;
        const T d = length(x, near_.z);
        const T h0 = sine(near_.y, d), h1 = sine(far_.y, d);
        const T a = turn_of_sum<T>(near_.z, {near_.y * x, length(d, near_.y)}, {-x * far_.y, length(d, far_.y)});
        const bool drawn = solid_angle_ > 0 && h1 > h0;
        return {real::quotient_where(drawn, (a - k_) * (2 * std::numbers::pi_v<T>), solid_angle_),
                real::quotient_where(drawn, sine(y, d) - h0, real::rounded(h1 - h0))};
    }

  private:
    template <Real R>
    LUMIS_HD static R length(R x, R y) noexcept {
        return real::sqrt(R(x * x + y * y));
    }

    // The sine of the elevation of the point (x, y) over that at y = 0 on the line at x, which is d away.
    template <Real R>
    LUMIS_HD static R sine(R y, R d) noexcept {
        return real::divide(y, length(d, y));
    }

    // x / sqrt(square), or next to infinity where rounding has left no square.
    template <Real R>
    LUMIS_HD static R ratio(R x, R square) noexcept {
        return real::divide(x, real::sqrt(real::greater(square, (std::numeric_limits<T>::min)())));
    }

    // p q + p.q of the lengths of p and q, their product, and the square of p x q: for p and q nearly opposite to each
    // other the sum has no digits.
    LUMIS_HD static Wide sum_of_products(Wide lengths, Wide dot, Wide cross_squared) noexcept {
        return dot >= 0 ? lengths + dot : real::divide(cross_squared, real::rounded(lengths - dot));
    }

    // The sum of two angles at corners, in turns. The planes from the reference point through the edges that meet at (x, y)
    // have an angle of cosine and sine in proportion to -+x y, which is p.x, and |z| times the corner's distance, p.y.
    template <std::floating_point S>
    LUMIS_HD static S turn_of_sum(S z, const glm::vec<2, S>& p, const glm::vec<2, S>& q) noexcept {
        const S p_sine = -z * p.y, q_sine = -z * q.y;
        return turn_of(real::rounded(p.x * q.x - p_sine * q_sine), real::rounded(p.x * q_sine + p_sine * q.x));
    }

    T unit_{1};  // near the longer edge: squares of tiny or huge edges would leave T's range
    // The axes. Not a Frame, which asserts that they are orthogonal: a skew parallelogram, which is split instead, comes by
    // here too.
    Direction<T> x_{1, 0, 0}, y_{0, 1, 0}, z_{0, 0, 1};
    glm::vec<3, T> near_{0, 0, -1};  // a, in the frame
    glm::vec<2, T> far_{0, 0};       // x1, y1
    T solid_angle_{0};
    T b0_{0}, b1_{0};  // cosines between the normals of the planes through the edges along u, and the rectangle's
    T z_share_{-1};    // sqrt(1 - b0^2), negative
    T k_{0};           // a turn less the angles at the first edge along v, in turns
    bool has_digits_{false};
};

}  // namespace lumis::LUMIS_ISA::detail
