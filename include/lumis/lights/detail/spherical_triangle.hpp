// A triangle projected onto the unit sphere about a reference point, drawn evenly by solid angle.
// Arvo 1995, "Stratified Sampling of Spherical Triangles":
//
//          c            1. u.x cuts off a triangle abq of a share E of the solid angle, by an arc from a to q on the arc bc.
//         / \           2. u.y goes along the arc aq, with 1 - cos even.
//        /   q
//       /  .  \         Arvo takes angles from arc cosines, and the solid angle as their sum less pi, which leaves float no
//      / .     \        digit below 3e-4 sr. Here the solid angle comes from a complex number, for unit vertices
//     a ------- b           E / 2 = arg(1 + a.b + b.q + q.a + i det(a, b, q))
//
// (Van Oosterom and Strackee 1983; Peters 2021), and no small quantity in it is a difference. So tiny triangles keep their
// relative accuracy; and so do triangles with an edge close to the reference point, whose ends are nearly opposite to each
// other.
//
// With t the direction in which the arc bc leaves b, and q = cos(beta) b + sin(beta) t, that is
//     tan(beta / 2) = y / x,   x = cos(E / 2) - g2 sin(E / 2),   y = g1 sin(E / 2),
//     g1 = (1 + a.b) / det(a, b, t),   g2 = a.t / det(a, b, t),
//     1 + a.q = (1 + a.b) / (x^2 + y^2),   1 - a.q = |p|^2 / (x^2 + y^2)
// where p has the direction in which the arc aq leaves a. Towards b and across towards c, its components are
//     p = (2 x cos(E / 2) - 1 - a.b,                                 2 x sin(E / 2)) / sqrt(1 - a.b)
//       = (1 - a.b - 2 sin(E / 2) (sin(E / 2) + g2 cos(E / 2)),      2 x sin(E / 2)) / sqrt(1 - a.b).
#pragma once

#include "lumis/core/elementary.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/lights/detail/flat_shape.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

namespace lumis::LUMIS_ISA::detail {

template <std::floating_point T>
class SphericalTriangle {
    using Wide = detail::Wide<T>;
    using Vector = glm::vec<3, Wide>;

  public:
    // 0 sr.
    SphericalTriangle() = default;

    // Vertices relative to the reference point, and the edges from a to b and from a to c, which the caller may know better
    // than their differences. Their squares have to be in range. 0 sr without area, edge-on and from a vertex.
    LUMIS_INLINE SphericalTriangle(const Vector& a, const Vector& b, const Vector& c, const Vector& ab,
                                   const Vector& ac) noexcept {
        const Vector cross_ab = cross(a, ab), cross_bc = cross(b, ac - ab);
        const Wide volume = glm::dot(cross_ab, ac), aa = glm::dot(a, a), bb = glm::dot(b, b), cc = glm::dot(c, c);
        if (!(std::abs(volume) > 0 && in_range(aa) && in_range(bb) && in_range(cc))) return;
        const Wide inverse_a = inverse(real::sqrt(aa)), inverse_b = inverse(real::sqrt(bb)),
                   inverse_c = inverse(real::sqrt(cc));
        const Wide inverse_ab = inverse_a * inverse_b, inverse_bc = inverse_b * inverse_c;

        // Unit vertices from here on.
        const Vector a_x_b = cross_ab * inverse_ab, b_x_c = cross_bc * inverse_bc;
        const Wide det = std::abs(volume) * (inverse_ab * inverse_c), dot_of_crosses = glm::dot(a_x_b, b_x_c);
        const Side ab_side{glm::dot(a, b) * inverse_ab, a_x_b}, bc_side{glm::dot(b, c) * inverse_bc, b_x_c};

        // 1 + a.b + b.c + c.a = (1 + a.b)(1 + b.c) - (a x b).(b x c). That cancels where the side that it leaves out, ca,
        // spans nearly half a turn. Then the other form that leaves out the shorter one of ab and bc.
        Wide sum = ab_side.one_plus_cos * bc_side.one_plus_cos - dot_of_crosses;
        const Wide inverse_ca = inverse_c * inverse_a, cos_ca = glm::dot(c, a) * inverse_ca;
        if (cos_ca < Wide(-0.75)) {
            const Vector c_x_a = cross(ac, a) * inverse_ca;
            const Side ca_side{cos_ca, c_x_a};
            sum = ab_side.one_plus_cos > bc_side.one_plus_cos
                      ? bc_side.one_plus_cos * ca_side.one_plus_cos - glm::dot(b_x_c, c_x_a)
                      : ca_side.one_plus_cos * ab_side.one_plus_cos - glm::dot(c_x_a, a_x_b);
        }
        solid_angle_ = static_cast<T>(2 * real::atan2(det, sum));

        const Wide sine_ab = real::sqrt(ab_side.squared_sine), sine_bc = real::sqrt(bc_side.squared_sine);
        const Wide inverse_det = inverse(det), reach = real::sqrt(ab_side.one_minus_cos);
        const Vector unit_a = a * inverse_a;
        // At right angles to a once more: of vertices nearly opposite to each other the cross product is rounded.
        const Vector across = (a_x_b - unit_a * glm::dot(unit_a, a_x_b)) * inverse(sine_ab);
        a_ = unit_a;
        to_b_ = glm::cross(across, unit_a);
        to_c_ = across * std::copysign(Wide(1), volume);
        g1_ = static_cast<T>(ab_side.one_plus_cos * sine_bc * inverse_det);
        g2_ = static_cast<T>(-dot_of_crosses * inverse_det);
        reach_ = static_cast<T>(reach);
        two_over_reach_ = static_cast<T>(real::divide(Wide(2), reach));
        one_plus_cos_ = static_cast<T>(ab_side.one_plus_cos);
        cot_half_bc_ = static_cast<T>(real::divide(bc_side.one_plus_cos, sine_bc));
        const Wide inverse_length = inverse(real::sqrt(det * det + sum * sum));
        end_ = glm::vec<2, T>{static_cast<T>(sum * inverse_length), static_cast<T>(det * inverse_length)};
    }

    [[nodiscard]] LUMIS_HD T solid_angle() const noexcept { return solid_angle_; }

    // u.x cuts off a share of the solid angle by an arc from a to the edge bc; u.y goes along that arc.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE Direction<R> sample(glm::vec<2, R> u) const noexcept {
        // E / 2 by way of E / 4: so its cosine keeps more digits.
        const auto quarter = half_circle(R(u.x * (solid_angle_ / (8 * std::numbers::pi_v<T>))));
        const R sine = 2 * quarter.x * quarter.y;
        const R cosine = real::rounded(quarter.x - quarter.y) * (quarter.x + quarter.y);
        const R x = real::rounded(cosine - sine * g2_);
        // Not beyond c, whither rounding may lead.
        const T end_x = end_.y * (g1_ * cot_half_bc_);
        const auto before_c = x > sine * (g1_ * cot_half_bc_);
        const glm::vec<2, R> half{real::select(before_c, cosine, end_.x), real::select(before_c, sine, end_.y)};
        const Arc<R> arc = arc_to_q(half, glm::vec<2, R>{real::select(before_c, x, end_x), half.y * g1_});

        const R one_minus_cos = u.y * arc.one_minus_cos;
        const R one_plus_cos = arc.one_plus_cos + (1 - u.y) * arc.one_minus_cos;
        const R sine_over_p = real::sqrt(R(u.y * arc.one_minus_cos_over_pp * one_plus_cos));
        return Direction<R>(a_) * real::rounded(1 - one_minus_cos) + Direction<R>(to_b_) * (arc.p.x * sine_over_p) +
               Direction<R>(to_c_) * (arc.p.y * sine_over_p);
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Direction<T>& w) const noexcept {
        const glm::vec<3, T> aw = real::rounded(w - a_);
        // (cos, sin) of the direction in which the arc aw leaves a, and of beta, each times any length.
        const T to_b = glm::dot(aw, to_b_), to_c = glm::dot(aw, to_c_), one_minus_cos = reach_ * reach_;
        const T cosine = to_b + to_c * (1 - one_minus_cos) * g2_, sine = to_c * (g1_ * one_minus_cos);
        const T length = real::sqrt(cosine * cosine + sine * sine);
        if (!(length > 0)) return {T(0), T(0)};
        // p is in proportion to (to_b, to_c): a quadratic equation for tan(E / 2), of which the discriminant is length^2.
        const T middle = to_b + to_c * g2_;
        const glm::vec<2, T> half = middle > 0 ? glm::vec<2, T>{middle + length, to_c * one_minus_cos}
                                               : glm::vec<2, T>{to_c * one_plus_cos_ - 2 * to_b * g2_, length - middle};
        const glm::vec<2, T> unit = half * inverse(real::sqrt(half.x * half.x + half.y * half.y));
        const T reach = arc_to_q(unit, glm::vec<2, T>{unit.x - unit.y * g2_, unit.y * g1_}).one_minus_cos;
        return {real::greater(real::divide(2 * std::atan2(half.y, half.x), solid_angle_), T(0)),
                real::divide(glm::dot(aw, aw), 2 * reach)};
    }

  private:
    // 1 + cos and 1 - cos of a side: the larger one from the cosine, the other as sin^2 divided by it.
    struct Side {
        LUMIS_INLINE Side(Wide cosine, const Vector& cross) noexcept : squared_sine{glm::dot(cross, cross)} {
            const Wide larger = 1 + std::abs(cosine), smaller = real::divide(squared_sine, larger);
            one_plus_cos = cosine > 0 ? larger : smaller;
            one_minus_cos = cosine > 0 ? smaller : larger;
        }

        Wide squared_sine, one_plus_cos, one_minus_cos;
    };

    // The arc from a to q.
    template <Real R>
    struct Arc {
        glm::vec<2, R> p;
        R one_minus_cos, one_plus_cos, one_minus_cos_over_pp;
    };

    // half: (cos, sin) of E / 2; xy: x and y.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE Arc<R> arc_to_q(const glm::vec<2, R>& half, const glm::vec<2, R>& xy) const noexcept {
        const R sine = half.y * two_over_reach_;
        const bool ab_is_far = reach_ > 1;
        const R to_b = ab_is_far
                           ? R(real::rounded(xy.x * half.x * two_over_reach_ - one_plus_cos_ * two_over_reach_ / 2))
                           : R(real::rounded(reach_ - sine * (half.y + half.x * g2_)));
        const glm::vec<2, R> p{to_b, xy.x * sine};
        const R pp = p.x * p.x + p.y * p.y;
        const R inverse =
            SphericalTriangle::inverse(real::greater(R(xy.x * xy.x + xy.y * xy.y), (std::numeric_limits<T>::min)()));
        // The smaller one as it is, the larger one from it: so they sum to 2 as well as T can tell.
        const R one_minus_cos = pp * inverse, one_plus_cos = one_plus_cos_ * inverse;
        const auto q_is_far = one_plus_cos < 1;
        const R versine_if_far = 2 - one_plus_cos;
        return {p, real::select(q_is_far, versine_if_far, one_minus_cos),
                real::select(q_is_far, one_plus_cos, 2 - one_minus_cos),
                real::select(q_is_far, real::quotient_where(q_is_far && pp > 0, versine_if_far, pp), inverse)};
    }

    template <Real R>
    LUMIS_HD static R inverse(R x) noexcept {
        return real::divide(R(scalar_of<R>(1)), x);
    }

    LUMIS_HD static bool in_range(Wide x) noexcept {
        return x >= (std::numeric_limits<Wide>::min)() && x <= (std::numeric_limits<Wide>::max)();
    }

    Direction<T> a_{1, 0, 0}, to_b_{0, 1, 0}, to_c_{0, 0, 1};  // orthonormal: a, and from there towards b, and across
    T solid_angle_{0};
    T g1_{1}, g2_{0};
    T reach_{1}, two_over_reach_{2};  // sqrt(1 - a.b), and 2 over that
    T one_plus_cos_{1};               // 1 + a.b
    T cot_half_bc_{0};                // x / y at c
    glm::vec<2, T> end_{1, 0};        // (cos, sin) of E / 2 at c
};

}  // namespace lumis::LUMIS_ISA::detail
