// Glass on a table: a polished ball, whose caustic only paths of the BSDF find, a ball of ground glass, and a coloured block.
#pragma once

#include "lights/environment.hpp"
#include "scenes/scene_parts.hpp"

#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace tracer {

class Glass
    : public SceneParts<Materials<Diffuse<float>, SmoothGlass<float>, RoughGlass<float>, Absorbing<SmoothGlass<float>>>,
                        Lights<FewLights<lumis::Parallelogram, lumis::ByArea>, Environment>> {
  public:
    Glass() : SceneParts{LightTable{{}, Environment{uniform_image(glm::vec3{0.1f})}}} {
        const Surface table = materials_.add(Diffuse<float>{glm::vec3{0.6f}});
        geometry_.add(lumis::Parallelogram{glm::vec3{-8, 0, -4}, glm::vec3{0, 0, 12}, glm::vec3{16, 0, 0}}, table);
        geometry_.add(lumis::Parallelogram{glm::vec3{-8, 0, -4}, glm::vec3{16, 0, 0}, glm::vec3{0, 8, 0}}, table);
        geometry_.add(lumis::Sphere{glm::vec3{-1.6f, 0.81f, 0}, 0.8f}, materials_.add(SmoothGlass<float>{1.5f}));
        geometry_.add(lumis::Sphere{glm::vec3{0.3f, 0.61f, 0.7f}, 0.6f}, materials_.add(RoughGlass<float>{0.2f, 1.5f}));
        add_block({1.8f, 0.01f, -0.2f}, {0.8f, 1.6f, 0.8f}, 30,
                  materials_.add(Absorbing<SmoothGlass<float>>{{1.5f}, {1.5f, 0.3f, 0.5f}}));
        const lumis::Parallelogram<float> light{{-2.5f, 5, -0.5f}, {2.5f, 0, 0}, {0, 0, 2.5f}};
        geometry_.add(light, lights_.add<0>(light, glm::vec3{6}));
        geometry_.commit();
    }

    [[nodiscard]] static Camera camera() { return {{0, 3.2f, 7.5f}, {0.1f, 0.6f, 0}, {0, 1, 0}, 32}; }

  private:
    // Stands on the middle of its base, turned about the vertical. All normals point outward.
    void add_block(const glm::vec3& base, const glm::vec3& size, float degrees, const Surface& surface) {
        const float c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
        const glm::vec3 x{size.x * c, 0, -size.x * s}, y{0, size.y, 0}, z{size.z * s, 0, size.z * c};
        const glm::vec3 from = base - 0.5f * (x + z), to = from + x + y + z;
        for (const lumis::Parallelogram<float>& face : {lumis::Parallelogram{from, y, x}, {from, z, y}, {from, x, z}}) {
            geometry_.add(face, surface);
        }
        for (const lumis::Parallelogram<float>& face : {lumis::Parallelogram{to, -x, -y}, {to, -y, -z}, {to, -z, -x}}) {
            geometry_.add(face, surface);
        }
    }
};

}  // namespace tracer
