// A triangle projected onto the unit sphere about a reference point, drawn evenly by solid angle.
//
// Arvo 1995, "Stratified Sampling of Spherical Triangles", in terms of half-angle tangents (Van Oosterom and Strackee
// 1983; Peters 2021): Arvo's own formula takes angles from arc cosines and their sum less pi, which leaves float no digit
// below 3e-4 sr. Here every small quantity is formed from differences of the vertices, so that a triangle of 1e-8 sr
// keeps its relative accuracy.
#pragma once

#include "lumis/core/real.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/spherical.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <numbers>

namespace lumis {

template <std::floating_point T>
class SphericalTriangle {
  public:
    // Vertices relative to the reference point, and the edges from a to b and a to c, which the caller may know better
    // than their differences.
    [[gnu::always_inline]] SphericalTriangle(const glm::vec<3, T>& a, const glm::vec<3, T>& b, const glm::vec<3, T>& c,
                                             const glm::vec<3, T>& ab, const glm::vec<3, T>& ac) noexcept
        : SphericalTriangle{Vertex{a}, Vertex{b}, Vertex{c}, ab, ac} {}

    // 0 from a vertex.
    [[nodiscard]] T solid_angle() const noexcept { return solid_angle_; }

    // u.x cuts off a share of the solid angle by an arc from a to the edge bc; u.y goes along that arc.
    template <RealOf<T> R = T>
    [[nodiscard]] Direction<R> sample(glm::vec<2, R> u) const noexcept {
        using Vector = glm::vec<3, R>;
        const Vector a{a_};
        // Of half the solid angle to be cut off, from those of half of that.
        const auto quarter = half_circle(R(u.x * (solid_angle_ / (8 * std::numbers::pi_v<T>))));
        const R sine = 2 * quarter.x * quarter.y, cosine = (quarter.x - quarter.y) * (quarter.x + quarter.y);
        // q on the arc bc such that the triangle a, b, q has the wanted solid angle.
        const Vector aq = to(up_to_c(glm::vec<2, R>{cosine * g0_ - sine * g2_, sine * g1_}));
        // From a towards q: 1 - cos is uniform.
        const R full = real::min(R(glm::dot(aq, aq) / 2), 2);
        const R part = u.y * full;
        Vector across = aq + a * full;
        across = across - a * glm::dot(a, across);  // once more, for q nearly opposite to a,
        across = across - a * glm::dot(a, across);  // and again, for what is left of it then
        const R squared = glm::dot(across, across);
        R versine = part, cos_theta = 1 - part;
        if (!real::all(part <= 1)) {
            // In terms of 1 + cos: for q nearly opposite to a, 2 - part has no digits.
            const Vector sum = aq + R(2) * a;
            versine = real::select(part <= 1, part, glm::dot(sum, sum) / 2 + (1 - u.y) * full);
            cos_theta = real::select(part <= 1, cos_theta, versine - 1);
        }
        const Vector w = a * cos_theta + across * (sine_of_versine(versine) / real::sqrt(squared));
        return real::select(is_squared_length(squared), w, a);
    }

    [[nodiscard]] glm::vec<2, T> invert(const Direction<T>& w) const noexcept {
        const glm::vec<3, T> aw = w - a_;
        const glm::vec<3, T> normal = glm::cross(a_, aw);  // of the arc from a through w, which meets the arc bc at q
        // (cos b + sin tangent).normal == 0, on the side of the triangle: for w rounded across the edge ab the sine is
        // negative.
        const T sine = side_ * glm::dot(normal, ab_), cosine = -side_ * glm::dot(normal, tangent_);
        const T length = real::sqrt(sine * sine + cosine * cosine);
        if (!(length > 0)) return {T(0), T(0)};
        const glm::vec<2, T> half{length + cosine, sine};
        const T cut_off = 2 * std::atan2(half.y * g0_, half.x * g1_ + half.y * g2_);
        const glm::vec<3, T> aq = to(half);
        return {real::max(cut_off / solid_angle_, T(0)), glm::dot(aw, aw) / glm::dot(aq, aq)};
    }

  private:
    struct Vertex {
        [[gnu::always_inline]] explicit Vertex(const glm::vec<3, T>& p) noexcept
            : position{p}, squared{glm::dot(p, p)}, length{real::sqrt(squared)}, inverse{1 / length} {}

        glm::vec<3, T> position;
        T squared, length, inverse;
    };

    [[gnu::always_inline]] SphericalTriangle(const Vertex& a, const Vertex& b, const Vertex& c,
                                             const glm::vec<3, T>& ab, const glm::vec<3, T>& ac) noexcept
        : a_{a.position * a.inverse}, b_{b.position * b.inverse} {
        ab_ = chord(a, b, ab);
        const glm::vec<3, T> chord_ac = chord(a, c, ac), chord_bc = chord(b, c, ac - ab);
        // The direction of the arc from b to c at b.
        const glm::vec<3, T> along = chord_bc + b_ * (glm::dot(chord_bc, chord_bc) / 2);
        tangent_ = along * (1 / real::length(along));
        // 1 + a.b, from the sum: of vertices nearly opposite to each other, a chord's square leaves no digit of it.
        const glm::vec<3, T> sum = a_ + b_;
        g1_ = glm::dot(sum, sum) / 2;
        // 1 + a.b + b.c + c.a, with each other cosine 1 less half a squared chord.
        const T sum_of_cosines = g1_ + 2 - (glm::dot(chord_bc, chord_bc) + glm::dot(chord_ac, chord_ac)) / 2;
        solid_angle_ = 2 * real::atan2(std::abs(glm::dot(a_, glm::cross(ab_, chord_ac))), sum_of_cosines);
        // At a vertex, or so near that in units of the edges its square is out of range.
        if (!(is_squared_length(a.squared) && is_squared_length(b.squared) && is_squared_length(c.squared))) {
            solid_angle_ = 0;
        }
        const T det = glm::dot(a_, glm::cross(ab_, tangent_));
        side_ = std::copysign(T(1), -det);
        g0_ = std::abs(det);
        g2_ = -glm::dot(ab_, tangent_);
        const T half_sine = real::length(chord_bc) / 2;
        half_bc_ = {real::sqrt(real::max((1 - half_sine) * (1 + half_sine), T(0))), half_sine};
    }

    // (cosine, sine), of any common length, of half an angle from b, but not beyond c, whither rounding may lead.
    template <Real R>
    [[nodiscard]] glm::vec<2, R> up_to_c(const glm::vec<2, R>& half) const noexcept {
        const auto before_c = half.y * half_bc_.x < half.x * half_bc_.y;
        return {real::select(before_c, half.x, half_bc_.x), real::select(before_c, half.y, half_bc_.y)};
    }

    // From a to the point of the arc bc at an angle from b, given (cosine, sine), of any common length, of half of it.
    template <Real R>
    [[nodiscard]] glm::vec<3, R> to(const glm::vec<2, R>& half) const noexcept {
        using Vector = glm::vec<3, R>;
        const R scale = 2 * half.y / (half.x * half.x + half.y * half.y);
        return Vector(ab_) + Vector(tangent_) * (half.x * scale) - Vector(b_) * (half.y * scale);
    }

    // q / |q| - p / |p| from q - p without cancellation.
    static glm::vec<3, T> chord(const Vertex& p, const Vertex& q, const glm::vec<3, T>& pq) noexcept {
        const T difference = glm::dot(pq, p.position + q.position) / (p.length + q.length);  // of the lengths
        return (pq - p.position * (difference * p.inverse)) * q.inverse;
    }

    glm::vec<3, T> a_, b_;    // unit
    glm::vec<3, T> ab_;       // b_ - a_
    glm::vec<3, T> tangent_;  // unit, of the arc from b to c at b
    T solid_angle_;
    T side_;                  // -1 if a, b, c run counterclockwise as seen from the reference point, else 1
    T g0_, g1_, g2_;          // det(a, b, tangent), 1 + a.b, a.tangent
    glm::vec<2, T> half_bc_;  // cosine and sine of half the arc from b to c
};

}  // namespace lumis
