// A garden at dusk, and four kinds of light: the shadow of a sundial has soft edges in the sun and sharp ones by the moon, a
// lantern casts the shadows of its bars, and a round lamp hangs on the wall.
#pragma once

#include "lights/delta_lights.hpp"
#include "lights/environment.hpp"
#include "lights/sunlight.hpp"
#include "scenes/scene_parts.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace tracer {

class Sundial : public SceneParts<Materials<Diffuse<float>, Metal<float>>,
                                  Lights<SunAndSky<Environment>, FewLights<Point, Delta>, FewLights<Beam, Delta>,
                                         FewLights<lumis::Disk, lumis::ByArea>>> {
  public:
    Sundial() : SceneParts{LightTable{sun_and_sky(), {}, {}, {}}} {
        const Surface ground = materials_.add(Diffuse<float>{{0.35f, 0.32f, 0.28f}});
        const Surface wall = materials_.add(Diffuse<float>{{0.6f, 0.5f, 0.42f}});
        const Surface marble = materials_.add(Diffuse<float>{glm::vec3{0.8f}});
        const Surface iron = materials_.add(Diffuse<float>{glm::vec3{0.1f}});
        geometry_.add(lumis::Parallelogram{glm::vec3{-30, 0, -2.2f}, glm::vec3{0, 0, 40}, glm::vec3{60, 0, 0}}, ground);
        geometry_.add(lumis::Parallelogram{glm::vec3{-6, 0, -2.2f}, glm::vec3{12, 0, 0}, glm::vec3{0, 2.6f, 0}}, wall);
        geometry_.add(lumis::Sphere{glm::vec3{0.75f, 0.4f, 1.3f}, 0.4f}, materials_.add(Metal<float>{silver, 0.3f}));

        // The dial, marks of seven hours, and what casts the shadow.
        const glm::vec3 dial{-1.1f, 0.4f, 0.2f}, up{0, 1, 0};
        geometry_.add(lumis::Disk{dial, up, 1.2f}, marble);
        for (int hour = -3; hour <= 3; ++hour) {
            const float angle = glm::radians(25.0f * static_cast<float>(hour));
            const glm::vec3 out{std::sin(angle), 0, std::cos(angle)}, aside{0.03f * out.z, 0, -0.03f * out.x};
            geometry_.add(lumis::Parallelogram{dial + 0.9f * out - aside + 0.002f * up, 0.2f * out, 2.0f * aside},
                          iron);
        }
        geometry_.add(lumis::Triangle{dial, dial - glm::vec3{0, 0, 0.9f}, dial + glm::vec3{0, 0.9f, -0.9f}}, iron);

        // The lantern: bars between two plates.
        const glm::vec3 lantern{2, 0.5f, 0.2f};
        lights_.add<1>(Point<float>{lantern}, glm::vec3{1.6f, 0.9f, 0.4f});
        for (const float height : {-0.3f, 0.3f}) geometry_.add(lumis::Disk{lantern + height * up, up, 0.3f}, iron);
        for (int bar = 0; bar < 10; ++bar) {
            const float angle = glm::radians(36.0f * static_cast<float>(bar));
            const glm::vec3 out{std::cos(angle), 0, std::sin(angle)}, aside{0.04f * out.z, 0, -0.04f * out.x};
            geometry_.add(lumis::Parallelogram{lantern + 0.3f * (out - up) - aside, 2.0f * aside, 0.6f * up}, iron);
        }

        const lumis::Disk lamp{glm::vec3{-3.2f, 1.5f, -2.1f}, glm::vec3{0, 0, 1}, 0.3f};
        geometry_.add(lamp, lights_.add<3>(lamp, glm::vec3{5, 4, 3}, iron));
        lights_.add<2>(Beam<float>{glm::normalize(glm::vec3{1.2f, 1, 0.6f})}, glm::vec3{0.2f, 0.3f, 0.5f});
        geometry_.commit();
    }

    [[nodiscard]] static Camera camera() { return {{0, 3, 8}, {0, 0.75f, 0}, {0, 1, 0}, 32}; }

  private:
    // The irradiance of the sun is (3, 2, 1.2).
    [[nodiscard]] static SunAndSky<Environment> sun_and_sky() {
        const lumis::Sun sun{glm::normalize(glm::vec3{-1, 0.75f, 0.5f}), 0.03f};
        const Environment sky{uniform_image({0.1f, 0.16f, 0.3f})};
        return {Sunlight{sun, glm::vec3{3, 2, 1.2f} / sun.projected_solid_angle()}, sky};
    }
};

}  // namespace tracer
