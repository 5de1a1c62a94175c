// What a path carries through a boundary between two media. Refraction squeezes the solid angle of a beam by the square of
// the relative index. Radiance, power per solid angle, grows by as much when light enters the denser medium; power does
// not. Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 5.2.
#pragma once

#include "lumis/core/platform.hpp"

namespace lumis::LUMIS_ISA {

enum class TransportMode {
    Radiance,    // wo leads to the camera: paths from a camera collect radiance
    Importance,  // wo leads to the light: paths from a light, and photons, carry power
};

}  // namespace lumis::LUMIS_ISA
