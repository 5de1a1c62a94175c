// The renderer's own vectors: positions, directions and colors alike. Nothing here knows of Lumis or of GLM.
#pragma once

#include <algorithm>
#include <cmath>

namespace host {

struct Vec {
    float x{}, y{}, z{};

    friend Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vec operator*(const Vec& a, const Vec& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
    friend Vec operator*(float s, const Vec& v) { return {s * v.x, s * v.y, s * v.z}; }
    friend Vec operator-(const Vec& v) { return -1 * v; }
};

inline float dot(const Vec& a, const Vec& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(const Vec& a, const Vec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(const Vec& v) {
    return std::sqrt(dot(v, v));
}
inline Vec normalized(const Vec& v) {
    return 1 / length(v) * v;
}
inline float largest(const Vec& v) {
    return std::max({v.x, v.y, v.z});
}
inline float luminance(const Vec& color) {  // Rec. 709
    return dot(color, {0.2126f, 0.7152f, 0.0722f});
}

}  // namespace host
