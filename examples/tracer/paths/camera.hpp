// A pinhole camera.
#pragma once

#include "geometry/geometry.hpp"
#include "paths/packet.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace tracer {

struct Camera {
    glm::vec3 position, target, up;
    float field_of_view;  // in degrees, on the smaller axis
};

// An image of width x height pixels, as the camera sees it.
class View {
  public:
    View(const Camera& camera, int width, int height) : position_{camera.position} {
        const glm::vec3 forward = glm::normalize(camera.target - camera.position);
        const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
        const glm::vec3 down = glm::cross(forward, right);
        const float pixel =
            2 * std::tan(glm::radians(camera.field_of_view) / 2) / static_cast<float>(std::min(width, height));
        right_ = pixel * right;
        down_ = pixel * down;
        corner_ = forward - 0.5f * (static_cast<float>(width) * right_ + static_cast<float>(height) * down_);
    }

    // Through a point of the image, in pixels from its upper left corner.
    template <lumis::Real R>
    [[nodiscard]] Ray<R> ray(const R& x, const R& y) const {
        const Vector<R> through = Vector<R>(corner_) + x * Vector<R>(right_) + y * Vector<R>(down_);
        return {Vector<R>(position_), through * (1.0f / lumis::real::length(through))};
    }

  private:
    glm::vec3 position_, right_, down_, corner_;
};

}  // namespace tracer
