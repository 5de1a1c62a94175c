// A Cornell box: one rectangular light, a diffuse box and a glossy one.
#pragma once

#include "scenes/scene_parts.hpp"

#include <glm/trigonometric.hpp>

#include <cmath>
#include <tuple>
#include <utility>

namespace tracer {

class Cornell : public SceneParts<Materials<Diffuse<float>, Coated<float>>,
                                  Lights<FewLights<lumis::Parallelogram, lumis::ByArea>>> {
  public:
    Cornell() {
        const Surface white = materials_.add(Diffuse<float>{glm::vec3{0.73f}});
        const Surface red = materials_.add(Diffuse<float>{{0.63f, 0.06f, 0.05f}});
        const Surface green = materials_.add(Diffuse<float>{{0.14f, 0.45f, 0.09f}});
        const Surface glossy = materials_.add(Coated<float>{{0.1f, 0.2f, 0.45f}, 0.1f, 1.6f});

        const glm::vec3 x{2, 0, 0}, y{0, 2, 0}, z{0, 0, 2}, corner{-1};
        geometry_.add(lumis::Parallelogram{corner, x, z}, white);      // floor
        geometry_.add(lumis::Parallelogram{corner, x, y}, white);      // back
        geometry_.add(lumis::Parallelogram{corner, y, z}, red);        // left
        geometry_.add(lumis::Parallelogram{corner + x, y, z}, green);  // right
        add_box({-0.36f, -1, -0.32f}, {0.6f, 1.2f, 0.6f}, 18, glossy);
        add_box({0.36f, -1, 0.34f}, {0.6f, 0.6f, 0.6f}, -17, white);
        // The lamp fills a hole in the ceiling, which four pieces surround.
        const lumis::Parallelogram<float> light{{-0.25f, 1, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f}};
        for (const auto& [from, width, depth] : {std::tuple{glm::vec3{-1, 1, -1}, 0.75f, 2.0f},
                                                 {{0.25f, 1, -1}, 0.75f, 2.0f},
                                                 {{-0.25f, 1, -1}, 0.5f, 0.75f},
                                                 {{-0.25f, 1, 0.25f}, 0.5f, 0.75f}}) {
            geometry_.add(lumis::Parallelogram{from, glm::vec3{width, 0, 0}, glm::vec3{0, 0, depth}}, white);
        }
        geometry_.add(light, lights_.add<0>(light, glm::vec3{18, 14, 8}));
        geometry_.commit();
    }

    [[nodiscard]] static Camera camera() { return {{0, 0, 3.9f}, {0, 0, 0}, {0, 1, 0}, 39}; }

  private:
    // A box that stands on the middle of its base, turned about the vertical.
    void add_box(const glm::vec3& base, const glm::vec3& size, float degrees, const Surface& surface) {
        const float c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
        const glm::vec3 x{size.x * c, 0, -size.x * s}, y{0, size.y, 0}, z{size.z * s, 0, size.z * c};
        const glm::vec3 corner = base - 0.5f * (x + z);
        geometry_.add(lumis::Parallelogram{corner + y, x, z}, surface);
        for (const auto& [from, along] : {std::pair{corner, x}, {corner + z, x}, {corner, z}, {corner + x, z}}) {
            geometry_.add(lumis::Parallelogram{from, along, y}, surface);
        }
    }
};

}  // namespace tracer
