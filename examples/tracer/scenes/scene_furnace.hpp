// Objects that lose no light, under a sky of radiance 1: they look like the sky, and cannot be seen. What reflects only a part
// emits the rest. Paths of few bounces miss the light that goes to and fro more often: inside the glass, and between
// neighbours. Rough metal and rough glass are not here: their BSDFs lose what their facets reflect more than once.
#pragma once

#include "lights/environment.hpp"
#include "scenes/scene_parts.hpp"

#include <glm/vec3.hpp>

namespace tracer {

class Furnace : public SceneParts<Materials<Diffuse<float>, Mirror<float, Tint>, SmoothGlass<float>>,
                                  Lights<Environment, FewLights<lumis::Sphere, lumis::BySolidAngle>>> {
  public:
    // The answer, for paths of any length.
    static constexpr float radiance = 1;

    Furnace() : SceneParts{LightTable{Environment{uniform_image(glm::vec3{radiance})}, {}}} {
        const Surface chalk = materials_.add(Diffuse<float>{glm::vec3{1}});
        const Surface mirror = materials_.add(Mirror<float, Tint>{{glm::vec3{1}}});
        const Surface glass = materials_.add(SmoothGlass<float>{1.5f});
        const glm::vec3 reflected{0.8f, 0.5f, 0.2f};
        const Surface ember = materials_.add(Diffuse<float>{reflected});
        for (float x = -3; const Surface& surface : {chalk, mirror, glass}) {
            geometry_.add(lumis::Sphere{glm::vec3{x, 0, 0}, 1.0f}, surface);
            x += 2.1f;
        }
        const lumis::Sphere<float> ball{{3.3f, 0, 0}, 1.0f};
        geometry_.add(ball, lights_.add<1>(ball, radiance - reflected, ember));
        geometry_.commit();
    }

    [[nodiscard]] static Camera camera() { return {{0, 1, 12}, {0.15f, 0, 0}, {0, 1, 0}, 22}; }
};

}  // namespace tracer
