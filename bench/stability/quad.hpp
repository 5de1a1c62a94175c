// References: the textbooks' formulas as they stand, with 113 bits. What cancels there leaves them digits enough.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <glm/vec3.hpp>

namespace stability {

using Quad = boost::multiprecision::cpp_bin_float_quad;

inline const Quad quad_pi = boost::math::constants::pi<Quad>();

struct QuadVector {
    Quad x, y, z;
};

template <class T>
[[nodiscard]] QuadVector quad(const glm::vec<3, T>& v) {
    return {Quad{v.x}, Quad{v.y}, Quad{v.z}};
}

[[nodiscard]] inline QuadVector operator+(const QuadVector& a, const QuadVector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] inline QuadVector operator-(const QuadVector& a, const QuadVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] inline QuadVector operator*(const Quad& s, const QuadVector& v) {
    return {s * v.x, s * v.y, s * v.z};
}
[[nodiscard]] inline Quad dot(const QuadVector& a, const QuadVector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] inline QuadVector cross(const QuadVector& a, const QuadVector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline Quad length(const QuadVector& v) {
    return sqrt(dot(v, v));
}
[[nodiscard]] inline QuadVector unit(const QuadVector& v) {
    return (1 / length(v)) * v;
}

// The solid angle of the triangle that three vectors span (Van Oosterom and Strackee 1983).
[[nodiscard]] inline Quad solid_angle_of(const QuadVector& a, const QuadVector& b, const QuadVector& c) {
    const Quad la = length(a), lb = length(b), lc = length(c);
    const Quad sum = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    return 2 * atan2(abs(dot(a, cross(b, c))), sum);
}

// What one edge of a polygon adds to the irradiance per radiance on a receiver of normal n (Lambert).
[[nodiscard]] inline Quad irradiance_of_edge(const QuadVector& a, const QuadVector& b, const QuadVector& n) {
    const QuadVector across = cross(a, b);
    const Quad sine = length(across);
    return sine > 0 ? Quad{atan2(sine, dot(a, b)) * dot(n, across) / sine / 2} : Quad{0};
}

}  // namespace stability
