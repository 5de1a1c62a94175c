// Spheres for Embree, as a geometry of our own: its own kind takes each ray of a packet alone, ten times as long.
#pragma once

#include "geometry/embree.hpp"
#include <lumis/lights/shapes.hpp>

#include <vector>

namespace tracer {

// The spheres have to live as long as the geometry, and where they are.
[[nodiscard]] RTCGeometry new_spheres(RTCDevice device, const std::vector<lumis::Sphere<float>>& spheres);

}  // namespace tracer
