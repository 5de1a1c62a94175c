#pragma once

#include <lumis/directions/cosine_hemisphere.hpp>

// Reflected radiance of a white diffuse surface under a sky of radiance 1, by one sample of its BSDF: 1.
float white_furnace(const lumis::CosineHemisphere<float>& bsdf);
