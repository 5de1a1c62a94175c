// Where integrands are not 0, stated without the library's kernels: directions above a horizon, and directions whose rays
// meet a shape. In double.
#pragma once

#include <lumis/lights/shapes.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <functional>

namespace subjects {

using WhereDirections = std::function<bool(const glm::dvec3&)>;

inline bool above_horizon(const glm::dvec3& w) {
    return w.z > 0;
}

// The rays from the origin that meet corner + a edge_u + b edge_v for a, b >= 0 that `is_inside` allows.
template <class IsInside>
WhereDirections meets_plane(const glm::dvec3& corner, const glm::dvec3& edge_u, const glm::dvec3& edge_v,
                            IsInside is_inside) {
    return [=](const glm::dvec3& w) {
        // Cramer's rule for t w = corner + a edge_u + b edge_v.
        const double det = glm::dot(w, glm::cross(edge_u, edge_v));
        const double t = glm::dot(corner, glm::cross(edge_u, edge_v)) / det;
        const double a = -glm::dot(corner, glm::cross(edge_v, w)) / det;
        const double b = -glm::dot(corner, glm::cross(w, edge_u)) / det;
        return t > 0 && a > 0 && b > 0 && is_inside(a, b);
    };
}

template <class T>
WhereDirections meets(const lumis::Triangle<T>& s, const glm::dvec3& from) {
    const glm::dvec3 a{s.a}, b{s.b}, c{s.c};
    return meets_plane(a - from, b - a, c - a, [](double u, double v) { return u + v < 1; });
}
template <class T>
WhereDirections meets(const lumis::Parallelogram<T>& s, const glm::dvec3& from) {
    return meets_plane(glm::dvec3{s.corner} - from, glm::dvec3{s.edge_u}, glm::dvec3{s.edge_v},
                       [](double u, double v) { return u < 1 && v < 1; });
}
template <class T>
WhereDirections meets(const lumis::Disk<T>& s, const glm::dvec3& from) {
    const glm::dvec3 center = glm::dvec3{s.center} - from, normal{s.normal};
    return [=, radius = double{s.radius}](const glm::dvec3& w) {
        const double t = glm::dot(center, normal) / glm::dot(w, normal);
        return t > 0 && glm::length(t * w - center) < radius;
    };
}
template <class T>
WhereDirections meets(const lumis::Sphere<T>& s, const glm::dvec3& from) {
    const glm::dvec3 center = glm::dvec3{s.center} - from;
    return [=, radius = double{s.radius}](const glm::dvec3& w) {
        if (glm::length(center) < radius) return true;
        return glm::dot(w, center) > 0 && glm::length(glm::cross(w, center)) < radius * glm::length(w);
    };
}

}  // namespace subjects
