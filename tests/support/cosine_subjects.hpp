// Subjects of the laws: flat lights by solid angle and cosine, above, across and close to the horizon.
#pragma once

#include "light_subjects.hpp"
#include "solid_angle_subjects.hpp"
#include <lumis/lights/area_light_by_cosine.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace subjects {

// A chart about what of a polygon is above the horizon.
inline FlatView view_above(const std::vector<glm::dvec3>& polygon, const glm::dvec3& normal) {
    std::vector<glm::dvec3> above;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double hp = glm::dot(p, normal), hq = glm::dot(q, normal);
        if (hp >= 0) above.push_back(p);
        if ((hp < 0) != (hq < 0)) above.push_back(p + (q - p) * (hp / (hp - hq)));
    }
    glm::dvec3 middle{0};
    for (const auto& p : above) middle += p / static_cast<double>(above.size());
    const auto farthest = [&](auto distance) {
        return *std::ranges::max_element(above, {}, [&](const glm::dvec3& p) { return distance(p - middle); }) - middle;
    };
    const glm::dvec3 along = farthest([](const glm::dvec3& d) { return glm::length(d); });
    const glm::dvec3 across = farthest([&](const glm::dvec3& d) { return glm::length(glm::cross(d, along)); });
    return view_of(middle, along, across);
}

template <class Shape>
auto by_cosine(const char* name, const Shape& shape, const glm::dvec3& reference, const glm::dvec3& normal,
               lumis::Sides sides, const std::vector<glm::dvec3>& corners) {
    using T = typename Shape::Scalar;
    using Light = lumis::AreaLight<Shape, lumis::ByCosine>;
    const glm::dvec3 unit = glm::normalize(normal);
    const auto [chart, blur] = view_above(corners, unit);
    // An inverse decides on the density, to as many digits as it has: of small rectangles few, see solid_angle_subjects.hpp.
    const lumis::AreaLight<Shape, lumis::BySolidAngle> whole{shape, glm::vec<3, T>(reference), sides};
    const double lost = 2 / static_cast<double>(whole.solid_angle());
    auto round_trip = few_digits;
    round_trip.tolerance += lost;
    Subject<Light> subject{name,
                           Light{shape, glm::vec<3, T>(reference), glm::vec<3, T>(unit), sides},
                           chart,
                           1.0,
                           4 * blur * std::numeric_limits<T>::epsilon(),
                           {.tolerance = 512 + lost},
                           round_trip,
                           fused ? 4096 : 512};
    const auto hits = meets(shape, reference);
    subject.integrand = [hits, unit](const glm::dvec3& w) { return glm::dot(w, unit) > 0 && hits(w); };
    return subject;
}

struct TriangleByCosine {
    template <class T>
    static auto make() {
        using V = glm::dvec3;
        struct Case {
            const char* label;
            V a, b, c, reference, normal;
            lumis::Sides sides = lumis::Sides::Both;
        };
        const V up{0, 0, 1};
        const Case cases[] = {
            {"above", {0.2, 0.1, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 0}, up},
            {"octant", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, up},
            {"around the normal", {-1, -1, 1}, {1, -0.5, 1.5}, {0, 1, 1}, {0, 0, 0}, {0.1, -0.1, 1}},
            {"tilted and far", {10, 3, 20}, {12, 3, 19}, {10, 5, 21}, {1, 2, 3}, {1, -0.2, 0.3}},
            {"one corner above the horizon", {1, 0, 0.5}, {1, 1, -1}, {1.5, -1, -1}, {0, 0, 0}, up},
            {"one corner below the horizon", {1, 0, -0.5}, {1, 1, 1}, {1.5, -1, 1}, {0, 0, 0}, up},
            {"sliver", {-1, 0, 2}, {1, 0, 2}, {1, 0.002, 2}, {0, 0, 0}, up},
            {"1e-8 sr", {0.00015, 0, 1}, {0, 0.00015, 1}, {0, 0, 1}, {0, 0, 0}, {1, 1, 1}},
            {"6.28 sr", {4000, 0, 1}, {-2000, 3000, 1}, {-2000, -3000, 1}, {0, 0, 0}, {0.6, 0, 0.8}},
            {"of one side", {0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {0, 0, 0}, {0, -0.6, 0.8}, lumis::Sides::One},
        };
        std::vector<Subject<lumis::AreaLight<lumis::Triangle<T>, lumis::ByCosine>>> result;
        for (const auto& [name, a, b, c, reference, normal, sides] : cases) {
            const lumis::Triangle<T> triangle{glm::vec<3, T>(a), glm::vec<3, T>(b), glm::vec<3, T>(c)};
            result.push_back(
                by_cosine(name, triangle, reference, normal, sides, {a - reference, b - reference, c - reference}));
        }
        return result;
    }
};

struct ParallelogramByCosine {
    template <class T>
    static auto make() {
        using V = glm::dvec3;
        struct Case {
            const char* label;
            V corner, edge_u, edge_v, normal;
            lumis::Sides sides = lumis::Sides::Both;
        };
        const V up{0, 0, 1};
        const Case cases[] = {
            {"square above", {-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, {0.1, 0.2, 1}},
            {"square beside the normal", {-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, {1, 0.2, 0.2}},
            {"wall on the floor", {1, -1, 0}, {0, 2, 0}, {0, 0, 2}, up},
            {"wall across the horizon", {1, -1, -1}, {0, 2, 0}, {0, 0, 2}, up},
            {"wall, its first edge upright", {1, -1, -0.2}, {0, 0, 2}, {0, 2, 0}, up},
            {"rectangle of 0.02 sr, leaning", {3, 0.1, 0.4}, {0.1, 0.4, 0.05}, {-0.15, 0, 0.3}, {0, 0.6, 0.8}},
            {"five corners above the horizon", {1, -1, -0.5}, {0.5, 1, 1.5}, {0, 2, -0.6}, up},
            {"skew", {1, -1, 2}, {2, 0.5, 1}, {-1, 1, 0.3}, {1, 1, 0.4}},
            {"filling the view", {-1, -1, 0.05}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.1, 1}},
            {"strip", {-3, 0.5, 1}, {6, 0, 0}, {0, 0.01, 0}, up},
            {"square of 1e-8 sr", {0.25, 0, 1}, {0.0001, 0, 0}, {0, 0.0001, 0}, {1, 0, 1}},
            {"of one side", {1, -1, 2}, {-1, 1, 0.3}, {2, 0.5, 1}, up, lumis::Sides::One},
        };
        std::vector<Subject<lumis::AreaLight<lumis::Parallelogram<T>, lumis::ByCosine>>> result;
        for (const auto& [name, corner, edge_u, edge_v, normal, sides] : cases) {
            const lumis::Parallelogram<T> shape{glm::vec<3, T>(corner), glm::vec<3, T>(edge_u), glm::vec<3, T>(edge_v)};
            result.push_back(by_cosine(name, shape, {}, normal, sides,
                                       {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v}));
        }
        return result;
    }
};

}  // namespace subjects
