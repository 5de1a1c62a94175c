// Shapes for tests of lights, where their points and normals are told without the library: as lights/shapes.hpp documents
// coordinates, in double.
#pragma once

#include <lumis/core/frame.hpp>
#include <lumis/lights/area_light_by_solid_angle.hpp>
#include <lumis/lights/shapes.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <numbers>
#include <tuple>

namespace shapes {

template <class T>
glm::vec<3, T> point(const glm::dvec3& p) {
    return glm::vec<3, T>(p);
}

// One of each kind about a point, of a size.
template <class T>
auto each(const glm::dvec3& o, double size) {
    const auto at = [&](double x, double y, double z) { return point<T>(o + size * glm::dvec3{x, y, z}); };
    const auto along = [&](double x, double y, double z) { return point<T>(size * glm::dvec3{x, y, z}); };
    return std::tuple{lumis::Triangle<T>{at(-0.6, -0.4, 0.1), at(0.7, -0.3, -0.2), at(0.1, 0.8, 0.2)},
                      lumis::Parallelogram<T>{at(-0.5, -0.5, 0), along(1, 0, 0), along(0, 0.8, 0.6)},
                      lumis::Parallelogram<T>{at(-0.5, -0.4, 0), along(1, 0.2, 0.1), along(0.1, 0.7, -0.3)},
                      lumis::Disk<T>{at(0, 0, 0), along(0.2, -0.3, 0.9), 0.6 * size},
                      lumis::Sphere<T>{at(0, 0, 0), 0.7 * size}};
}

template <class T>
glm::dvec3 position(const lumis::Triangle<T>& s, const glm::dvec2& uv) {
    return (1 - uv.x - uv.y) * glm::dvec3{s.a} + uv.x * glm::dvec3{s.b} + uv.y * glm::dvec3{s.c};
}
template <class T>
glm::dvec3 position(const lumis::Parallelogram<T>& s, const glm::dvec2& uv) {
    return glm::dvec3{s.corner} + uv.x * glm::dvec3{s.edge_u} + uv.y * glm::dvec3{s.edge_v};
}

template <class T>
glm::dvec3 normal(const lumis::Triangle<T>& s, const glm::dvec2&) {
    return glm::normalize(glm::cross(glm::dvec3{s.b} - glm::dvec3{s.a}, glm::dvec3{s.c} - glm::dvec3{s.a}));
}
template <class T>
glm::dvec3 normal(const lumis::Parallelogram<T>& s, const glm::dvec2&) {
    return glm::normalize(glm::cross(glm::dvec3{s.edge_u}, glm::dvec3{s.edge_v}));
}
template <class T>
glm::dvec3 normal(const lumis::Disk<T>& s, const glm::dvec2&) {
    return glm::normalize(glm::dvec3{s.normal});
}
template <class T>
glm::dvec3 normal(const lumis::Sphere<T>&, const glm::dvec2& uv) {
    const double turn = 2 * std::numbers::pi * uv.y, sine = 2 * std::sqrt(uv.x * (1 - uv.x));
    return {sine * std::cos(turn), sine * std::sin(turn), 1 - 2 * uv.x};
}

template <class T>
glm::dvec3 position(const lumis::Disk<T>& s, const glm::dvec2& uv) {
    const lumis::Frame<double> frame{normal(s, uv)};
    const double turn = 2 * std::numbers::pi * uv.y;
    return glm::dvec3{s.center} +
           double{s.radius} * std::sqrt(uv.x) * (std::cos(turn) * frame.tangent() + std::sin(turn) * frame.bitangent());
}
template <class T>
glm::dvec3 position(const lumis::Sphere<T>& s, const glm::dvec2& uv) {
    return glm::dvec3{s.center} + double{s.radius} * normal(s, uv);
}

// The largest coordinate among a shape's points, nearly.
template <class Shape>
double largest_coordinate(const Shape& shape) {
    double largest = 0;
    for (const double u : {0.0, 0.5, 1.0}) {
        for (const double v : {0.0, 0.5}) {
            const glm::dvec3 p = position(shape, {u, v});
            largest = std::fmax(largest, std::fmax(std::abs(p.x), std::fmax(std::abs(p.y), std::abs(p.z))));
        }
    }
    return largest;
}

// visit(shape, sampling) for every kind of area light.
template <class T, class Visit>
void for_each_light(const glm::dvec3& o, double size, Visit visit) {
    std::apply(
        [&](const auto&... shape) {
            const auto both = [&]<class S>(const S& one) {
                visit(one, lumis::ByArea{});
                if constexpr (!std::same_as<S, lumis::Disk<T>>) visit(one, lumis::BySolidAngle{});
            };
            (both(shape), ...);
        },
        each<T>(o, size));
}

}  // namespace shapes
