// Subjects of the laws: flat lights by the solid angle they subtend, from 1e-8 sr to the hemisphere.
#pragma once

#include "light_subjects.hpp"
#include "subject.hpp"
#include "visibility.hpp"
#include <lumis/lumis.hpp>

#include <concepts>
#include <limits>
#include <vector>

namespace subjects {

// Arcs of nearly half a turn, and a sliver's angles, cost the way back some digits.
inline constexpr lumis::testing::RoundTripOptions few_digits{.tolerance = 2048};

// And leave as few to what is drawn of nearly a hemisphere. Where only one of batch and single call is fused, they differ by
// what Urena's angles lose: up to 1e-4 of a long strip, and more of what fills the view.
template <class Light>
double batch_distance(const Light& light) {
    const bool fills_view = light.solid_angle() > 6;
    if (!fused) return fills_view ? few_digits.tolerance : 4;
    return !fills_view ? 2048 : std::same_as<typename Light::Scalar, float> ? 1 << 13 : 1 << 18;
}

struct TriangleBySolidAngle {
    template <class T>
    static auto make() {
        using V = glm::dvec3;
        struct Case {
            const char* label;
            V a, b, c, reference;
            lumis::Sides sides = lumis::Sides::Both;
        };
        const Case cases[] = {
            {"above", {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 0}},
            {"octant", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}},
            {"tilted and far", {10, 3, 20}, {12, 3, 19}, {10, 5, 21}, {1, 2, 3}},
            {"sliver", {-1, 0, 2}, {1, 0, 2}, {1, 0.002, 2}, {0, 0, 0}},
            {"1e-8 sr", {0.00015, 0, 1}, {0, 0.00015, 1}, {0, 0, 1}, {0, 0, 0}},
            {"nearly edge-on", {1, 0, 0.01}, {2, 0.5, 0.01}, {1.5, 1, 0.02}, {0, 0, 0}},
            {"6.28 sr", {4000, 0, 1}, {-2000, 3000, 1}, {-2000, -3000, 1}, {0, 0, 0}},
            {"of one side", {0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {0, 0, 0}, lumis::Sides::One},
        };
        std::vector<Subject<lumis::AreaLight<lumis::Triangle<T>, lumis::BySolidAngle>>> result;
        for (const auto& [name, a, b, c, reference, sides] : cases) {
            const lumis::Triangle<T> triangle{glm::vec<3, T>(a), glm::vec<3, T>(b), glm::vec<3, T>(c)};
            const auto [chart, blur] = view_of((a + b + c) / 3.0 - reference, (b - a) / 2.0, (c - a) / 2.0);
            const lumis::AreaLight<lumis::Triangle<T>, lumis::BySolidAngle> light{triangle, glm::vec<3, T>(reference),
                                                                                  sides};
            result.push_back({name,
                              light,
                              chart,
                              1.0,
                              blur * std::numeric_limits<T>::epsilon(),
                              {},
                              few_digits,
                              batch_distance(light)});
            result.back().integrand = meets(triangle, reference);
        }
        return result;
    }
};

struct ParallelogramBySolidAngle {
    template <class T>
    static auto make() {
        using V = glm::dvec3;
        struct Case {
            const char* label;
            V corner, edge_u, edge_v;
            lumis::Sides sides = lumis::Sides::Both;
        };
        const Case cases[] = {
            {"square above", {-1, -1, 1}, {2, 0, 0}, {0, 2, 0}},
            {"rectangle aside", {0.5, 0.2, 1}, {0.6, 0, 0.8}, {0, 0.5, 0}},
            {"skew", {1, -1, 2}, {2, 0.5, 1}, {-1, 1, 0.3}},
            {"filling the view", {-1, -1, 0.05}, {2, 0, 0}, {0, 2, 0}},
            {"strip", {-3, 0.5, 1}, {6, 0, 0}, {0, 0.01, 0}},
            {"skew strip", {-3, 0.5, 1}, {6, 0, 0.5}, {0.01, 0.01, 0}},
            {"square of 1e-8 sr", {0.25, 0, 1}, {0.0001, 0, 0}, {0, 0.0001, 0}},
            {"skew of 1e-8 sr", {0.25, 0, 1}, {0.0001, 0, 0}, {0.00005, 0.0001, 0}},
            {"square of 6.28 sr", {-2000, -2000, 1}, {4000, 0, 0}, {0, 4000, 0}},
            {"skew of 6.28 sr", {-3000, -2000, 1}, {4000, 0, 0}, {2000, 4000, 0}},
            {"of one side", {1, -1, 2}, {-1, 1, 0.3}, {2, 0.5, 1}, lumis::Sides::One},
        };
        std::vector<Subject<lumis::AreaLight<lumis::Parallelogram<T>, lumis::BySolidAngle>>> result;
        for (const auto& [name, corner, edge_u, edge_v, sides] : cases) {
            const lumis::Parallelogram<T> shape{glm::vec<3, T>(corner), glm::vec<3, T>(edge_u), glm::vec<3, T>(edge_v)};
            const auto [chart, blur] = view_of(corner + (edge_u + edge_v) / 2.0, edge_u / 2.0, edge_v / 2.0);
            const lumis::AreaLight<lumis::Parallelogram<T>, lumis::BySolidAngle> light{shape, {}, sides};
            auto round_trip = few_digits;
            // Urena's sum of angles, of which small rectangles have few digits; smaller ones are split into triangles.
            if (light.solid_angle() > 1e5f * std::numeric_limits<T>::epsilon()) {
                round_trip.tolerance += 2 / static_cast<double>(light.solid_angle());
            }
            result.push_back({name,
                              light,
                              chart,
                              1.0,
                              blur * std::numeric_limits<T>::epsilon(),
                              {},
                              round_trip,
                              batch_distance(light)});
            result.back().integrand = meets(shape, {});
        }
        return result;
    }
};

}  // namespace subjects
