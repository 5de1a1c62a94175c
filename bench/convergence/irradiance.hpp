// The irradiance of a light of radiance 1 on a plane through the origin, +z its normal: closed forms, and the problem of
// estimating it from cosine-distributed directions, from the light's points, and by what better techniques there are for the
// light's shape.
#pragma once

#include "problem.hpp"
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/lights/area_light.hpp>
#include <lumis/lights/area_light_by_cosine.hpp>
#include <lumis/lights/area_light_by_solid_angle.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <numbers>
#include <span>
#include <string>

namespace convergence {

// Lambert's formula for a polygon above the plane: half the sum over its edges of the angle each subtends times the
// height of the unit normal of its plane through the origin.
[[nodiscard]] inline double irradiance_of_polygon(std::span<const glm::dvec3> corners) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        const glm::dvec3 normal = glm::cross(a, b);
        const double sine = glm::length(normal);
        sum += std::atan2(sine, glm::dot(a, b)) * normal.z / sine;
    }
    return std::abs(sum) / 2;
}

template <class Shape>
[[nodiscard]] Problem irradiance(const std::string& group, const std::string& title, const std::string& description,
                                 const Shape& shape, double answer) {
    const glm::dvec3 origin{0};
    const lumis::AreaLight<Shape> by_area{shape, origin};
    const auto cosine_of_light = [by_area](const glm::dvec3& w) { return w.z > 0 && by_area.pdf(w) > 0 ? w.z : 0.0; };
    Problem problem{group, title, description, Answer{answer}};
    problem.compare(cosine_of_light, Technique{"bsdf", lumis::CosineHemisphere<double>{}}, Technique{"light", by_area});
    if constexpr (!std::same_as<Shape, lumis::Disk<double>>) {  // which has no such sampling
        const lumis::AreaLight<Shape, lumis::BySolidAngle> by_solid_angle{shape, origin};
        problem.alone(cosine_of_light, Technique{"light by solid angle", by_solid_angle});
    }
    if constexpr (std::same_as<Shape, lumis::Triangle<double>> || std::same_as<Shape, lumis::Parallelogram<double>>) {
        const lumis::AreaLight<Shape, lumis::ByCosine> by_cosine{shape, origin, glm::dvec3{0, 0, 1}};
        problem.alone(cosine_of_light, Technique{"light by cosine", by_cosine});
    }
    return problem;
}

}  // namespace convergence
