// What polygons look like from the origin, in long double and without the library: solid angles and irradiance.
#pragma once

#include <lumis/core/uniforms.hpp>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace polygons {

using L = long double;
using V = glm::vec<3, L>;

// Van Oosterom and Strackee 1983, eq. 8, for vertices relative to the eye. Not negative.
inline L solid_angle(const V& a, const V& b, const V& c) {
    const L p = glm::length(a), q = glm::length(b), r = glm::length(c);
    const L det = std::abs(glm::dot(a, glm::cross(b - a, c - a)));
    return 2 * std::atan2(det, p * q * r + glm::dot(a, b) * r + glm::dot(b, c) * p + glm::dot(c, a) * q);
}

// The solid angle of the rectangle [x0, x1] x [y0, y1] in the plane at height z > 0: four quadrants' arc tangents.
inline L rectangle_solid_angle(L x0, L x1, L y0, L y1, L z) {
    const auto corner = [z](L x, L y) { return std::atan2(x * y, z * std::sqrt(x * x + y * y + z * z)); };
    return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

// On a plane through the origin with normal +z, of a planar polygon of radiance 1: what is below the plane is cut off, and
// the rest adds up by Lambert's formula (1760), 1/2 sum theta_i (n . Gamma_i). Not negative.
inline double irradiance(const std::vector<V>& polygon) {
    std::vector<V> above;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const V &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        if (p.z >= 0) above.push_back(p);
        if ((p.z < 0) != (q.z < 0)) above.push_back(p + (q - p) * (p.z / (p.z - q.z)));
    }
    L sum = 0;
    for (std::size_t i = 0; i < above.size(); ++i) {
        const V &p = above[i], &q = above[(i + 1) % above.size()];
        const V normal = glm::cross(p, q - p);
        const L length = glm::length(normal);
        if (length > 0) sum += std::atan2(length, glm::dot(p, q)) * normal.z / length;
    }
    return static_cast<double>(std::abs(sum) / 2);
}

// The same by a light's samples, at the midpoints of n x n cells of the uniforms.
template <class Light>
double estimated_irradiance(const Light& light, int n) {
    using T = typename Light::Scalar;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n; ++k) {
            const auto sample = light.sample(
                {(static_cast<T>(i) + T(0.5)) / static_cast<T>(n), (static_cast<T>(k) + T(0.5)) / static_cast<T>(n)});
            if (sample.pdf > 0) sum += std::max(double{sample.value.z}, 0.0) / double{sample.pdf};
        }
    }
    return sum / n / n;
}

// Uniform numbers in [-1, 1].
class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_{seed} {}
    double operator()() { return uniform_(engine_); }
    glm::dvec3 vector() {
        const double x = (*this)(), y = (*this)(), z = (*this)();
        return {x, y, z};
    }
    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 v = vector();
            const double length = glm::length(v);
            if (length > 0.1 && length <= 1) return v / length;
        }
    }

  private:
    std::mt19937_64 engine_;
    std::uniform_real_distribution<double> uniform_{-1, 1};
};

}  // namespace polygons
