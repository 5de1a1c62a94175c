// What a ray meets: Embree holds the shapes, this keeps what Embree does not know, the surface that each shape wears.
#pragma once

#include <lumis/lights/shapes.hpp>

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace tracer {

// What covers a shape. A light shines alike to all sides and reflects nothing.
struct Surface {
    std::size_t material{};  // index into the scene's materials
    glm::vec3 radiance{0};   // emitted
};

struct Hit {
    glm::vec3 position;
    glm::vec3 normal;  // unit, of either side
    const Surface* surface;
};

class Geometry {
  public:
    Geometry();

    void add(const lumis::Parallelogram<float>& shape, const Surface& surface);
    void add(const lumis::Sphere<float>& shape, const Surface& surface);

    // After the last shape and before the first ray.
    void commit();

    // The first surface ahead of the origin, if any.
    [[nodiscard]] std::optional<Hit> closest(const glm::vec3& origin, const glm::vec3& direction) const;

  private:
    std::shared_ptr<RTCDeviceTy> device_;
    std::shared_ptr<RTCSceneTy> scene_;
    std::vector<Surface> surfaces_;  // by Embree's geometry number
};

}  // namespace tracer
