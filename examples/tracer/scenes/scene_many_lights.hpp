// Ten thousand small lights over a floor: a light tree finds those that matter at a point.
#pragma once

#include "lights/many_lights.hpp"
#include "paths/random_stream.hpp"
#include "scenes/scene_parts.hpp"

#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace tracer {

class ManyLightsRoom : public SceneParts<Materials<Diffuse<float>, Coated<float>>,
                                         Lights<ManyLights<lumis::Sphere, lumis::BySolidAngle>>> {
  public:
    static constexpr int count = 10'000;

    ManyLightsRoom() : ManyLightsRoom{swarm()} {}

    [[nodiscard]] static Camera camera() { return {{0, 3.5f, 13}, {0, 1.2f, 0}, {0, 1, 0}, 36}; }

  private:
    using Light = Emitter<lumis::Sphere<float>>;

    explicit ManyLightsRoom(const std::vector<Light>& lights)
        : SceneParts{LightTable{ManyLights<lumis::Sphere, lumis::BySolidAngle>{lights}}} {
        const Surface floor = materials_.add(Coated<float>{glm::vec3{0.35f}, 0.2f, 1.5f});
        const Surface wall = materials_.add(Diffuse<float>{glm::vec3{0.5f}});
        const Surface chalk = materials_.add(Diffuse<float>{glm::vec3{0.8f}});
        const Surface glossy = materials_.add(Coated<float>{{0.1f, 0.15f, 0.3f}, 0.1f, 1.6f});
        geometry_.add(lumis::Parallelogram{glm::vec3{-12, 0, -8}, glm::vec3{0, 0, 24}, glm::vec3{24, 0, 0}}, floor);
        geometry_.add(lumis::Parallelogram{glm::vec3{-12, 0, -8}, glm::vec3{24, 0, 0}, glm::vec3{0, 12, 0}}, wall);
        geometry_.add(lumis::Sphere{glm::vec3{-2.4f, 1, 0.5f}, 1.0f}, chalk);
        geometry_.add(lumis::Sphere{glm::vec3{2.2f, 1.2f, -0.5f}, 1.2f}, glossy);

        std::vector<lumis::Sphere<float>> shapes;
        std::vector<Surface> surfaces;
        for (std::size_t i = 0; i < lights.size(); ++i) {
            shapes.push_back(lights[i].shape);
            surfaces.push_back(LightTable::surface<0>(i));
        }
        geometry_.add(shapes, surfaces);
        geometry_.commit();
    }

    // A spiral of two arms, flat and wide, whose lights turn from warm to cold outwards.
    [[nodiscard]] static std::vector<Light> swarm() {
        auto engine = random_stream(1);
        const auto uniform = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24f; };
        std::vector<Light> lights;
        for (int i = 0; i < count; ++i) {
            const float out = std::sqrt(uniform()), scatter = 0.5f * (uniform() + uniform() - 1);
            const float turn = 3.5f * out + scatter + std::numbers::pi_v<float> * static_cast<float>(i % 2);
            const float height = 3 + 0.8f * (uniform() - 0.5f) * (1.3f - out) + 0.3f * std::sin(2 * turn);
            const float radius = 0.006f + 0.012f * uniform() * uniform();
            const glm::vec3 center{6 * out * std::cos(turn), height, 6 * out * std::sin(turn)};
            const glm::vec3 warm{1.6f, 0.9f, 0.4f}, cold{0.4f, 0.8f, 1.8f};
            lights.push_back({{center, radius}, 25.0f * (warm + out * (cold - warm))});
        }
        return lights;
    }
};

}  // namespace tracer
