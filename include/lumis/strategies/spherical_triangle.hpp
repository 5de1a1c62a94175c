// A triangle projected onto the unit sphere about a reference point, drawn evenly by solid angle.
//
// Arvo 1995, "Stratified Sampling of Spherical Triangles", in terms of half-angle tangents (Van Oosterom and Strackee
// 1983; Peters 2021): Arvo's own formula takes angles from arc cosines and their sum less pi, which leaves float no digit
// below 3e-4 sr. Here every small quantity is formed from differences of the vertices, so that a triangle of 1e-8 sr
// keeps its relative accuracy.
#pragma once

#include "lumis/core/sample.hpp"
#include "lumis/core/spherical.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>

namespace lumis {

template <std::floating_point T>
class SphericalTriangle {
  public:
    // Vertices relative to the reference point, and the edges from a to b and a to c, which the caller may know better
    // than their differences.
    SphericalTriangle(const glm::vec<3, T>& a, const glm::vec<3, T>& b, const glm::vec<3, T>& c,
                      const glm::vec<3, T>& ab, const glm::vec<3, T>& ac) noexcept
        : a_{a / glm::length(a)}, b_{b / glm::length(b)} {
        const glm::vec<3, T> bc = ac - ab;
        ab_ = chord(a, b, ab);
        const glm::vec<3, T> chord_ac = chord(a, c, ac), chord_bc = chord(b, c, bc);
        // The direction of the arc from b to c at b.
        const glm::vec<3, T> along = chord_bc + b_ * (glm::dot(chord_bc, chord_bc) / 2);
        tangent_ = along / glm::length(along);
        // 1 + a.b + b.c + c.a, with each cosine 1 less half a squared chord.
        const T sum_of_cosines =
            4 - (glm::dot(ab_, ab_) + glm::dot(chord_bc, chord_bc) + glm::dot(chord_ac, chord_ac)) / 2;
        solid_angle_ = 2 * std::atan2(std::abs(glm::dot(a_, glm::cross(ab_, chord_ac))), sum_of_cosines);
        g0_ = std::abs(glm::dot(a_, glm::cross(ab_, tangent_)));
        g1_ = 2 - glm::dot(ab_, ab_) / 2;
        g2_ = -glm::dot(ab_, tangent_);
    }

    [[nodiscard]] T solid_angle() const noexcept { return solid_angle_; }

    // u.x cuts off a share of the solid angle by an arc from a to the edge bc; u.y goes along that arc.
    [[nodiscard]] Direction<T> sample(glm::vec<2, T> u) const noexcept {
        const T half = u.x * solid_angle_ / 2;
        const T sine = std::sin(half), cosine = std::cos(half);
        // q on the arc bc such that the triangle a, b, q has the wanted solid angle; t: tan of half the angle from b.
        const T t = sine * g1_ / (cosine * g0_ - sine * g2_);
        const glm::vec<3, T> aq = to(t);
        // From a towards q: 1 - cos is uniform.
        const T full = glm::dot(aq, aq) / 2;
        const T part = u.y * full;
        glm::vec<3, T> across = aq + a_ * full;
        across -= a_ * glm::dot(a_, across);  // once more, for q nearly opposite to a
        const T length = glm::length(across);
        if (!(length > 0)) return a_;
        return a_ * (1 - part) + across * (sine_of_versine(part) / length);
    }

    [[nodiscard]] glm::vec<2, T> invert(const Direction<T>& w) const noexcept {
        const glm::vec<3, T> aw = w - a_;
        const glm::vec<3, T> normal = glm::cross(a_, aw);  // of the arc from a through w, which meets the arc bc at q
        // (cos b + sin tangent).normal == 0, with the sine positive.
        const T across = glm::dot(normal, ab_);
        const T sine = std::abs(across), cosine = across > 0 ? -glm::dot(normal, tangent_) : glm::dot(normal, tangent_);
        const T length = std::sqrt(sine * sine + cosine * cosine);
        if (!(length > 0)) return {T(0), T(0)};
        const T t = sine / (length + cosine);
        return {2 * std::atan2(t * g0_, g1_ + t * g2_) / solid_angle_, glm::dot(aw, aw) / glm::dot(to(t), to(t))};
    }

  private:
    // From a to the point of the arc bc at an angle from b, given the tangent of half that angle.
    [[nodiscard]] glm::vec<3, T> to(T t) const noexcept {
        const T versine = 2 * t * t / (1 + t * t);
        return ab_ + tangent_ * (2 * t / (1 + t * t)) - b_ * versine;
    }

    // q / |q| - p / |p| from q - p without cancellation.
    static glm::vec<3, T> chord(const glm::vec<3, T>& p, const glm::vec<3, T>& q, const glm::vec<3, T>& pq) noexcept {
        const T p_length = glm::length(p), q_length = glm::length(q);
        const T difference = glm::dot(pq, p + q) / (p_length + q_length);  // of the lengths
        return (pq - p * (difference / p_length)) / q_length;
    }

    glm::vec<3, T> a_, b_;    // unit
    glm::vec<3, T> ab_;       // b_ - a_
    glm::vec<3, T> tangent_;  // unit, of the arc from b to c at b
    T solid_angle_;
    T g0_, g1_, g2_;  // det(a, b, tangent), 1 + a.b, a.tangent
};

}  // namespace lumis
