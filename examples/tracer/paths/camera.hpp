// A pinhole camera.
#pragma once

#include "geometry/geometry.hpp"
#include "paths/packet.hpp"
#include "render_options.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tracer {

struct Camera {
    glm::vec3 position, target, up;
    float field_of_view;  // in degrees, on the smaller axis
};

// A scene's camera, changed as the options ask. Throws if it would look nowhere.
[[nodiscard]] inline Camera asked(const Camera& own, const CameraOptions& options) {
    const Camera camera{options.eye.value_or(own.position), options.target.value_or(own.target),
                        options.up.value_or(own.up), options.field_of_view.value_or(own.field_of_view)};
    const float distance = glm::length(camera.target - camera.position);
    if (!(distance > 0 && std::isfinite(distance))) {
        throw std::invalid_argument("the camera looks nowhere: its eye and its target are too near, or too far apart");
    }
    return camera;
}

// An image of width x height pixels, as the camera sees it.
class View {
  public:
    View(const Camera& camera, int width, int height) : position_{camera.position} {
        const glm::vec3 forward = glm::normalize(camera.target - camera.position);
        glm::vec3 sideways = glm::cross(forward, camera.up);
        if (!(glm::dot(sideways, sideways) > 1e-12f * glm::dot(camera.up, camera.up))) {
            // It looks along up: x is to the right, as on a map.
            const glm::vec3 axis = std::abs(forward.x) < 0.9f ? glm::vec3{1, 0, 0} : glm::vec3{0, 0, -1};
            sideways = axis - glm::dot(axis, forward) * forward;
        }
        const glm::vec3 right = glm::normalize(sideways);
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
