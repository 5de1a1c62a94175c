// What GGX reflects towards one viewer, in double: answers by quadrature.
#pragma once

#include "problem.hpp"

#include <glm/vec3.hpp>

namespace convergence {

// Towards the viewer, and the mirrored direction, about which the lights are.
template <class T>
[[nodiscard]] glm::vec<3, T> viewer() {
    return {T(0.6), T(0), T(0.8)};
}
template <class T>
[[nodiscard]] glm::vec<3, T> mirrored() {
    return {T(-0.6), T(0), T(0.8)};
}

// The light is a cone of radiance 1 about the mirrored direction, above the horizon.
[[nodiscard]] Answer reflected_cone(double alpha, double solid_angle);

// The light is all around: the directional albedo.
[[nodiscard]] Answer reflected_hemisphere(double alpha);

}  // namespace convergence
