// Looking down on a plane-parallel slab of coloured glass under a sky of radiance 1, below which is sky as well. A lamp shines
// inside its right half. With the reflectance r of each face (Fresnel) and the share t that the glass leaves of one passage,
// left:   r + (1 - r)^2 t (1 + r t + (r t)^2 + ...): every path ends in the sky, above or below
// right:  r + (1 - r) t' e / n^2: down to the lamp, whose radiance e is that in glass of index n
#pragma once

#include "lights/environment.hpp"
#include "scenes/scene_parts.hpp"

#include <glm/exponential.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace tracer {

class Slab : public SceneParts<Materials<Absorbing<SmoothGlass<float>>>,
                               Lights<Environment, FewLights<lumis::Parallelogram, lumis::ByArea>>> {
  public:
    static constexpr float index = 1.5f, thickness = 0.5f, depth_of_lamp = 0.3f;
    static constexpr glm::vec3 absorption{3, 1, 0.2f}, emission{2, 3, 4};

    // The answer along a ray of the camera, of this direction, for paths of at least one bounce.
    [[nodiscard]] static glm::dvec3 radiance(const glm::dvec3& direction, bool is_on_lamp, int bounces) {
        const double cosine = -direction.y, n{index};
        const double inside = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
        const double s = (cosine - n * inside) / (cosine + n * inside),
                     p = (n * cosine - inside) / (n * cosine + inside);
        const double r = (s * s + p * p) / 2;
        const auto left_after = [&](double depth) { return glm::exp(-glm::dvec3{absorption} * depth / inside); };
        if (is_on_lamp) return r + (1 - r) * left_after(depth_of_lamp) * glm::dvec3{emission} / (n * n);
        const glm::dvec3 t = left_after(thickness);
        return r + (1 - r) * (1 - r) * t * (1.0 - glm::pow(r * t, glm::dvec3{bounces - 1.0})) / (1.0 - r * t);
    }

    Slab() : SceneParts{LightTable{Environment{uniform_image(glm::vec3{1})}, {}}} {
        const Surface glass = materials_.add(Absorbing<SmoothGlass<float>>{{index}, absorption});
        const glm::vec3 x{40, 0, 0}, z{0, 0, 40}, corner{-20, 0, -20};
        geometry_.add(lumis::Parallelogram{corner, z, x}, glass);  // its normal points up
        geometry_.add(lumis::Parallelogram{corner - glm::vec3{0, thickness, 0}, x, z}, glass);
        const lumis::Parallelogram lamp{glm::vec3{0, -depth_of_lamp, -20}, z, 0.5f * x};
        geometry_.add(lamp, lights_.add<1>(lamp, emission));
        geometry_.commit();
    }

    [[nodiscard]] static Camera camera() { return {{0, 4, 0}, {0, 0, 0}, {0, 0, -1}, 60}; }
};

}  // namespace tracer
