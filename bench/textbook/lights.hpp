// Lights as books have them: shapes by area with the measure's conversion, and by solid angle a sphere's cone from its
// cosine (Pharr, Jakob and Humphreys 2023, section 6.2.4), triangles by arc cosines (Arvo 1995), rectangles as published
// (Urena, Fajardo and King 2013, listing in the appendix).
#pragma once

#include <lumis/core/sample.hpp>
#include <lumis/lights/shapes.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

namespace textbook {

using lumis::Direction;
using lumis::LightSample;

// Shared by the two that meet rays with a triangle or parallelogram, Moller and Trumbore 1997; 0: no hit.
template <std::floating_point T>
[[nodiscard]] T hit_distance(const glm::vec<3, T>& corner, const glm::vec<3, T>& edge_u, const glm::vec<3, T>& edge_v,
                             bool is_triangle, const Direction<T>& w) noexcept {
    const glm::vec<3, T> p = glm::cross(w, edge_v), q = glm::cross(-corner, edge_u);
    const T inverse = 1 / glm::dot(edge_u, p);
    const T s = -glm::dot(corner, p) * inverse, t = glm::dot(w, q) * inverse;
    if (!(s >= 0 && t >= 0 && (is_triangle ? s + t <= 1 : s <= 1 && t <= 1))) return 0;
    return std::max(glm::dot(edge_v, q) * inverse, T(0));
}

// A triangle or parallelogram evenly by area.
template <std::floating_point T, bool is_triangle>
class FlatByArea {
    using Vector = glm::vec<3, T>;

  public:
    FlatByArea(const lumis::Triangle<T>& s, const Vector& reference) noexcept requires is_triangle
        : FlatByArea{s.a - reference, s.b - s.a, s.c - s.a} {}
    FlatByArea(const lumis::Parallelogram<T>& s, const Vector& reference) noexcept requires(!is_triangle)
        : FlatByArea{s.corner - reference, s.edge_u, s.edge_v} {}

    [[nodiscard]] LightSample<Direction<T>, T> sample(glm::vec<2, T> u) const noexcept {
        T s = u.x, t = u.y;
        if constexpr (is_triangle) {
            const T root = std::sqrt(u.x);
            s = root * (1 - u.y), t = root * u.y;
        }
        const Vector position = corner_ + s * edge_u_ + t * edge_v_;
        const T squared = glm::dot(position, position);
        if (squared == 0) return {};
        const T distance = std::sqrt(squared);
        const Direction<T> w = position / distance;
        return {w, squared / (std::abs(glm::dot(normal_, w)) * area_), distance};
    }

    [[nodiscard]] T pdf(const Direction<T>& w) const noexcept {
        const T distance = hit_distance(corner_, edge_u_, edge_v_, is_triangle, w);
        return distance > 0 ? distance * distance / (std::abs(glm::dot(normal_, w)) * area_) : T(0);
    }

  private:
    FlatByArea(const Vector& corner, const Vector& edge_u, const Vector& edge_v) noexcept
        : corner_{corner}, edge_u_{edge_u}, edge_v_{edge_v} {
        const Vector normal = glm::cross(edge_u, edge_v);
        const T length = glm::length(normal);
        area_ = is_triangle ? length / 2 : length;
        normal_ = normal / length;
    }

    Vector corner_, edge_u_, edge_v_;
    Direction<T> normal_;
    T area_;
};

template <std::floating_point T>
using TriangleByArea = FlatByArea<T, true>;
template <std::floating_point T>
using ParallelogramByArea = FlatByArea<T, false>;

// An orthonormal basis about z (Duff et al. 2017).
template <std::floating_point T>
struct Basis {
    explicit Basis(const Direction<T>& axis) noexcept : z{axis} {
        const T sign = std::copysign(T(1), z.z), a = -1 / (sign + z.z), b = z.x * z.y * a;
        x = {1 + sign * z.x * z.x * a, sign * b, -sign * z.x};
        y = {b, sign + z.y * z.y * a, -z.y};
    }
    Direction<T> x, y, z;
};

template <std::floating_point T>
class DiskByArea {
    using Vector = glm::vec<3, T>;

  public:
    DiskByArea(const lumis::Disk<T>& disk, const Vector& reference) noexcept
        : center_{disk.center - reference}, radius_{disk.radius}, basis_{glm::normalize(disk.normal)} {}

    [[nodiscard]] LightSample<Direction<T>, T> sample(glm::vec<2, T> u) const noexcept {
        const T r = radius_ * std::sqrt(u.x), phi = 2 * std::numbers::pi_v<T> * u.y;
        const Vector position = center_ + r * std::cos(phi) * basis_.x + r * std::sin(phi) * basis_.y;
        const T squared = glm::dot(position, position), distance = std::sqrt(squared);
        if (squared == 0) return {};
        const Direction<T> w = position / distance;
        return {w, squared / (std::abs(glm::dot(basis_.z, w)) * area()), distance};
    }

    [[nodiscard]] T pdf(const Direction<T>& w) const noexcept {
        const T cosine = glm::dot(w, basis_.z), distance = glm::dot(center_, basis_.z) / cosine;
        if (!(distance > 0)) return 0;
        const Vector across = distance * w - center_;
        if (glm::dot(across, across) > radius_ * radius_) return 0;
        return distance * distance / (std::abs(cosine) * area());
    }

  private:
    [[nodiscard]] T area() const noexcept { return std::numbers::pi_v<T> * radius_ * radius_; }

    Vector center_;
    T radius_;
    Basis<T> basis_;
};

// From outside.
template <std::floating_point T>
class SphereByCone {
    using Vector = glm::vec<3, T>;

  public:
    SphereByCone(const lumis::Sphere<T>& sphere, const Vector& reference) noexcept
        : distance_{glm::length(sphere.center - reference)},
          radius_{sphere.radius},
          basis_{(sphere.center - reference) / distance_},
          cos_max_{std::sqrt(std::max(T(0), 1 - radius_ * radius_ / (distance_ * distance_)))},
          pdf_{1 / (2 * std::numbers::pi_v<T> * (1 - cos_max_))} {}

    [[nodiscard]] LightSample<Direction<T>, T> sample(glm::vec<2, T> u) const noexcept {
        const T cosine = 1 - u.x * (1 - cos_max_), squared = std::max(T(0), 1 - cosine * cosine);
        const T sine = std::sqrt(squared), phi = 2 * std::numbers::pi_v<T> * u.y;
        const T distance =
            distance_ * cosine - std::sqrt(std::max(T(0), radius_ * radius_ - distance_ * distance_ * squared));
        return {sine * std::cos(phi) * basis_.x + sine * std::sin(phi) * basis_.y + cosine * basis_.z, pdf_, distance};
    }

    [[nodiscard]] T pdf(const Direction<T>& w) const noexcept {
        return glm::dot(w, basis_.z) >= cos_max_ ? pdf_ : T(0);
    }

  private:
    T distance_, radius_;
    Basis<T> basis_;
    T cos_max_, pdf_;
};

template <std::floating_point T>
class TriangleBySolidAngle {
    using Vector = glm::vec<3, T>;

  public:
    TriangleBySolidAngle(const lumis::Triangle<T>& s, const Vector& reference) noexcept
        : corner_{s.a - reference},
          edge_u_{s.b - s.a},
          edge_v_{s.c - s.a},
          normal_{glm::cross(edge_u_, edge_v_)},
          a_{glm::normalize(s.a - reference)},
          b_{glm::normalize(s.b - reference)} {
        const Vector c = glm::normalize(s.c - reference);
        const Vector ab = glm::normalize(glm::cross(a_, b_)), bc = glm::normalize(glm::cross(b_, c)),
                     ca = glm::normalize(glm::cross(c, a_));
        const auto angle = [](const Vector& p, const Vector& q) {
            return std::acos(std::clamp(-glm::dot(p, q), T(-1), T(1)));
        };
        const T alpha = angle(ab, ca);
        solid_angle_ = alpha + angle(bc, ab) + angle(ca, bc) - std::numbers::pi_v<T>;
        cos_alpha_ = std::cos(alpha), sin_alpha_ = std::sin(alpha), alpha_ = alpha;
        cos_c_ = glm::dot(a_, b_);
        towards_c_ = glm::normalize(c - glm::dot(c, a_) * a_);
    }

    [[nodiscard]] LightSample<Direction<T>, T> sample(glm::vec<2, T> u) const noexcept {
        const T angle = u.x * solid_angle_ - alpha_;
        const T s = std::sin(angle), t = std::cos(angle);
        const T p = t - cos_alpha_, r = s + sin_alpha_ * cos_c_;
        const T q = ((r * t - p * s) * cos_alpha_ - r) / ((r * s + p * t) * sin_alpha_);
        const T cos_b = std::clamp(q, T(-1), T(1));
        const Vector c = cos_b * a_ + std::sqrt(1 - cos_b * cos_b) * towards_c_;
        const T cb = glm::dot(c, b_), z = 1 - u.y * (1 - cb);
        const Direction<T> w = z * b_ + std::sqrt(std::max(T(0), 1 - z * z)) * glm::normalize(c - cb * b_);
        return {w, 1 / solid_angle_, glm::dot(corner_, normal_) / glm::dot(w, normal_)};
    }

    [[nodiscard]] T pdf(const Direction<T>& w) const noexcept {
        return hit_distance(corner_, edge_u_, edge_v_, true, w) > 0 ? 1 / solid_angle_ : T(0);
    }

  private:
    Vector corner_, edge_u_, edge_v_, normal_;
    Direction<T> a_, b_, towards_c_;
    T solid_angle_, alpha_, cos_alpha_, sin_alpha_, cos_c_;
};

template <std::floating_point T>
class RectangleBySolidAngle {
    using Vector = glm::vec<3, T>;

  public:
    RectangleBySolidAngle(const lumis::Parallelogram<T>& s, const Vector& reference) noexcept
        : corner_{s.corner - reference}, edge_u_{s.edge_u}, edge_v_{s.edge_v} {
        const T length_u = glm::length(edge_u_), length_v = glm::length(edge_v_);
        x_ = edge_u_ / length_u, y_ = edge_v_ / length_v, z_ = glm::cross(x_, y_);
        z0_ = glm::dot(corner_, z_);
        if (z0_ > 0) z_ = -z_, z0_ = -z0_;
        x0_ = glm::dot(corner_, x_), y0_ = glm::dot(corner_, y_);
        x1_ = x0_ + length_u, y1_ = y0_ + length_v;
        const Vector v00{x0_, y0_, z0_}, v01{x0_, y1_, z0_}, v10{x1_, y0_, z0_}, v11{x1_, y1_, z0_};
        const Vector n0 = glm::normalize(glm::cross(v00, v10)), n1 = glm::normalize(glm::cross(v10, v11)),
                     n2 = glm::normalize(glm::cross(v11, v01)), n3 = glm::normalize(glm::cross(v01, v00));
        b0_ = n0.z, b1_ = n2.z;
        k_ = 2 * std::numbers::pi_v<T> - std::acos(-glm::dot(n2, n3)) - std::acos(-glm::dot(n3, n0));
        solid_angle_ = std::acos(-glm::dot(n0, n1)) + std::acos(-glm::dot(n1, n2)) - k_;
    }

    [[nodiscard]] LightSample<Direction<T>, T> sample(glm::vec<2, T> u) const noexcept {
        const T au = u.x * solid_angle_ + k_;
        const T fu = (std::cos(au) * b0_ - b1_) / std::sin(au);
        const T cu = std::clamp(std::copysign(1 / std::sqrt(fu * fu + b0_ * b0_), fu), T(-1), T(1));
        const T xu = std::clamp(-(cu * z0_) / std::sqrt(1 - cu * cu), x0_, x1_);
        const T d = std::sqrt(xu * xu + z0_ * z0_);
        const T h0 = y0_ / std::sqrt(d * d + y0_ * y0_), h1 = y1_ / std::sqrt(d * d + y1_ * y1_);
        const T hv = h0 + u.y * (h1 - h0), hv2 = hv * hv;
        const T yv = hv2 < 1 - std::numeric_limits<T>::epsilon() ? hv * d / std::sqrt(1 - hv2) : y1_;
        const Vector position = xu * x_ + yv * y_ + z0_ * z_;
        const T distance = glm::length(position);
        return {position / distance, 1 / solid_angle_, distance};
    }

    [[nodiscard]] T pdf(const Direction<T>& w) const noexcept {
        return hit_distance(corner_, edge_u_, edge_v_, false, w) > 0 ? 1 / solid_angle_ : T(0);
    }

  private:
    Vector corner_, edge_u_, edge_v_;
    Vector x_, y_, z_;
    T x0_, y0_, z0_, x1_, y1_, b0_, b1_, k_, solid_angle_;
};

}  // namespace textbook
