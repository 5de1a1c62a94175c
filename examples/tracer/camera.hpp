// A pinhole camera.
#pragma once

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace tracer {

struct Camera {
    glm::vec3 position, target, up;
    float field_of_view;  // in degrees, on the smaller axis

    // Through the centre of a pixel; row 0 is at the top.
    [[nodiscard]] glm::vec3 direction(int x, int y, int width, int height) const {
        const glm::vec3 forward = glm::normalize(target - position);
        const glm::vec3 right = glm::normalize(glm::cross(forward, up));
        const glm::vec3 above = glm::cross(right, forward);
        const float pixel = 2 * std::tan(glm::radians(field_of_view) / 2) / static_cast<float>(std::min(width, height));
        const float across = pixel * (static_cast<float>(x) + 0.5f - 0.5f * static_cast<float>(width));
        const float down = pixel * (static_cast<float>(y) + 0.5f - 0.5f * static_cast<float>(height));
        return glm::normalize(forward + across * right - down * above);
    }
};

}  // namespace tracer
