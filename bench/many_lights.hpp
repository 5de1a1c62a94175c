// Many lights for benchmarks: small triangles of one side and spheres in a cube, of intensities over two decades, and points
// to be lit among them.
#pragma once

#include <lumis/core/uniforms.hpp>
#include <lumis/directions/uniform_sphere.hpp>
#include <lumis/lights/light_bounds.hpp>
#include <lumis/lights/shapes.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

struct ManyLights {
    using Vector = glm::vec3;

    struct Point {
        Vector position, normal;
    };

    std::vector<lumis::LightBounds<float>> bounds;
    std::vector<float> intensities;
    std::vector<Point> points;

    explicit ManyLights(std::size_t count, std::size_t point_count = 1024) {
        lumis::Uniforms<std::mt19937_64, float> uniforms{std::mt19937_64{count}};
        const auto in_cube = [&](float side) { return side * (uniforms.template next<3>() - 0.5f); };
        const float size = 0.1f / std::cbrt(static_cast<float>(count));
        while (bounds.size() < count) {
            const Vector center = in_cube(2);
            const auto u = uniforms.template next<2>();
            const float radiance = std::pow(10.0f, 2 * u.x);
            if (u.y < 0.5f) {
                bounds.push_back(light_bounds(lumis::Sphere<float>{center, size}, radiance));
            } else {
                bounds.push_back(
                    light_bounds(lumis::Triangle<float>{center, center + in_cube(8 * size), center + in_cube(8 * size)},
                                 radiance, lumis::Sides::One));
            }
            intensities.push_back(bounds.back().intensity);
        }
        while (points.size() < point_count) {
            const Vector position = in_cube(2);
            points.push_back({position, lumis::UniformSphere<float>{}.sample(uniforms.template next<2>()).value});
        }
    }

    // What a light gives to a point without shadows, as if it stood in the middle of its box.
    [[nodiscard]] float given(std::size_t i, const Point& point) const {
        const auto& light = bounds[i];
        const Vector to_light = 0.5f * (light.lower + light.upper) - point.position;
        const float squared = glm::dot(to_light, to_light), inverse = 1 / std::sqrt(squared);
        const float cos_light = light.cos_cone < 0 ? 1.0f : -glm::dot(light.axis, to_light) * inverse;
        const float cos_point = glm::dot(point.normal, to_light) * inverse;
        return cos_light > 0 && cos_point > 0 ? light.intensity * cos_light * cos_point / squared : 0.0f;
    }
};
