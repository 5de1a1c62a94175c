// What the views of the shapes answer: a point drawn on a surface, and a ray's meeting with it, both as seen from a
// reference point.
#pragma once

#include "lumis/core/sample.hpp"

#include <concepts>

namespace lumis {

// A point relative to the reference point, and the cosine at the light times its distance; 0: edge-on, or hidden.
template <std::floating_point T>
struct SurfaceSample {
    glm::vec<3, T> position{};
    T cos_times_distance{};
};

// Where a ray from the reference point meets the surface, and the cosine to its normal there; distance 0: nowhere.
template <std::floating_point T>
struct SurfaceHit {
    T distance{};
    T cos_light{};
};

}  // namespace lumis
