// A closed room whose walls all emit the same light and reflect the same share of it: wherever one looks, the radiance is
// e + a e + a^2 e + ... = e / (1 - a), whatever the room's shape. Paths of n bounces see the first n + 1 terms.
#pragma once

#include "scenes/scene_parts.hpp"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/vec3.hpp>

namespace tracer {

// Lights by solid angle: by area, the density towards the next wall falls to 0 at an edge, and the variance has no bounds.
class Box : public SceneParts<Materials<Diffuse<float>>, Lights<FewLights<lumis::Parallelogram, lumis::BySolidAngle>>> {
  public:
    static constexpr glm::vec3 emission{0.5f, 0.6f, 0.7f}, albedo{0.6f, 0.5f, 0.3f};

    // The answer.
    [[nodiscard]] static glm::dvec3 radiance(int bounces) {
        const glm::dvec3 a{albedo};
        return glm::dvec3{emission} * (1.0 - glm::pow(a, glm::dvec3{bounces + 1.0})) / (1.0 - a);
    }

    Box() {
        const Surface wall = materials_.add(Diffuse<float>{albedo});
        const glm::vec3 x{4, 0, 0}, y{0, 2, 0}, z{0, 0, 3}, corner = -0.5f * (x + y + z);
        for (const lumis::Parallelogram<float>& shape : {lumis::Parallelogram{corner, x, y},
                                                         {corner + z, x, y},
                                                         {corner, y, z},
                                                         {corner + x, y, z},
                                                         {corner, z, x},
                                                         {corner + y, z, x}}) {
            geometry_.add(shape, lights_.add<0>(shape, emission, wall));
        }
        geometry_.commit();
    }

    [[nodiscard]] static Camera camera() { return {{-1.5f, -0.3f, 1.2f}, {1, 0, -1}, {0, 1, 0}, 70}; }
};

}  // namespace tracer
