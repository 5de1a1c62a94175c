// Veach's plates and spheres (Veach 1997, figure 9.2): four plates of rising roughness under lights of rising size.
#pragma once

#include "scenes/scene_parts.hpp"

#include <array>

namespace tracer {

struct SphereLight {
    lumis::Sphere<float> shape;
    float radiance;
};
inline constexpr std::array<SphereLight, 5> veach_lights{{
    {{{10, 10, 4}, 0.5f}, 800},
    {{{-3.75f, 0, 0}, 0.03333f}, 901.803f},
    {{{-1.25f, 0, 0}, 0.1f}, 100},
    {{{1.25f, 0, 0}, 0.3f}, 11.1111f},
    {{{3.75f, 0, 0}, 0.9f}, 1.23457f},
}};

struct PlateOutline {
    glm::vec2 front, back;  // (y, z) of two opposite edges
    float alpha;
};
inline constexpr std::array<PlateOutline, 4> veach_plates{{
    {{-2.70651f, 0.25609f}, {-2.08375f, -0.526323f}, 0.005f},
    {{-3.28825f, 1.36972f}, {-2.83856f, 0.476536f}, 0.02f},
    {{-3.73096f, 2.70046f}, {-3.43378f, 1.74564f}, 0.05f},
    {{-3.99615f, 4.0667f}, {-3.82069f, 3.08221f}, 0.1f},
}};

// The plates as Veach has them, and as other renderers have them: they reflect all light.
[[nodiscard]] inline Coated<float> coated_plate(float alpha) {
    return {{0.07f, 0.09f, 0.13f}, alpha, 2.0f};
}
[[nodiscard]] inline Metal<float, Tint> metal_plate(float alpha) {
    return {{glm::vec3{1}}, alpha};
}

// Plate: the material of the plates.
template <class Plate>
class Veach : public SceneParts<Materials<Diffuse<float>, Plate>,
                                Lights<FewLights<lumis::Sphere, lumis::BySolidAngle, veach_lights.size()>>> {
  public:
    explicit Veach(auto plate_of_roughness) {
        const Surface wall = this->materials_.add(Diffuse<float>{glm::vec3{0.4f}});
        this->geometry_.add(
            lumis::Parallelogram{glm::vec3{-10, -4.14615f, -10}, glm::vec3{20, 0, 0}, glm::vec3{0, 0, 20}}, wall);
        this->geometry_.add(lumis::Parallelogram{glm::vec3{-10, -10, -2}, glm::vec3{20, 0, 0}, glm::vec3{0, 20, 0}},
                            wall);
        for (const PlateOutline& plate : veach_plates) {
            const glm::vec2 depth = plate.back - plate.front;
            this->geometry_.add(lumis::Parallelogram{glm::vec3{-4, plate.front.x, plate.front.y}, glm::vec3{8, 0, 0},
                                                     glm::vec3{0, depth.x, depth.y}},
                                this->materials_.add(plate_of_roughness(plate.alpha)));
        }
        for (const SphereLight& light : veach_lights) {
            this->geometry_.add(light.shape, this->lights_.template add<0>(light.shape, glm::vec3{light.radiance}));
        }
        this->geometry_.commit();
    }

    [[nodiscard]] static Camera camera() { return {{0, 2, 15}, {0, -2, 2.5f}, {0, 1, 0}, 28}; }
};

}  // namespace tracer
