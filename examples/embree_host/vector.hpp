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

    friend float dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    friend Vec cross(const Vec& a, const Vec& b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
    friend float length(const Vec& v) { return std::sqrt(dot(v, v)); }
    friend Vec normalized(const Vec& v) { return 1 / length(v) * v; }
    friend float largest(const Vec& v) { return std::max({v.x, v.y, v.z}); }
    friend float luminance(const Vec& color) { return dot(color, Vec{0.2126f, 0.7152f, 0.0722f}); }  // Rec. 709
};

}  // namespace host
