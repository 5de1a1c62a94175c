// Lights without extent: shapes of FewLights<Shape, Delta>. No ray meets them, and the camera does not see them. Their radiance
// is that of a light of extent 1, so that it is what such lights are given by: intensity, and irradiance.
#pragma once

#include "lights/lights.hpp"
#include "paths/packet.hpp"
#include <lumis/lights/directional_light.hpp>
#include <lumis/lights/point_light.hpp>

namespace tracer {

// Radiance: the intensity, the same in every direction. As if an area of 1 faced whoever sees it: the density is distance^2.
template <lumis::Real T>
struct Point {
    using Scalar = T;
    using Strategy = lumis::PointLight<T>;
    Vector<T> position;

    [[nodiscard]] LUMIS_INLINE lumis::LightSample<Vector<T>, T> drawn_from(const Vector<T>& from) const {
        auto drawn = Strategy{position, from}.sample(glm::vec<2, T>{});
        drawn.pdf *= drawn.distance * drawn.distance;
        return drawn;
    }
};
[[nodiscard]] inline Extent<float> extent(const Point<float>& point) {
    return {point.position, 0, 1};
}

// Infinitely far away. Radiance: the irradiance on what faces it. As if it filled a solid angle of 1 with density 1.
template <lumis::Real T>
struct Beam {
    using Scalar = T;
    using Strategy = lumis::DirectionalLight<T>;
    Vector<T> direction;  // unit, towards the light

    [[nodiscard]] LUMIS_INLINE lumis::LightSample<Vector<T>, T> drawn_from(const Vector<T>& /*from*/) const {
        return Strategy{direction}.sample(glm::vec<2, T>{});
    }
};
// Far enough for the choice of a light.
[[nodiscard]] inline Extent<float> extent(const Beam<float>& beam) {
    constexpr float distance = 1e12f;
    return {distance * beam.direction, 0, distance * distance};
}

}  // namespace tracer
