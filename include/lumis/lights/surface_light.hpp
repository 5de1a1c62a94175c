// An area light that tells its surface: position, geometric normal and coordinates of the points that it draws, for textured
// emitters. It is used as AreaLight is, made anew at each point:
//
//     const SurfaceLight light{triangle, point};                                    // evenly by area
//     const SurfaceLight<Triangle<float>, BySolidAngle> by_angle{triangle, point, Sides::One};
//     const SurfaceLight<Triangle<float>, ByCosine> by_cosine{triangle, point, normal};
//     const auto s = light.sample(u);                                               // s.surface.uv
//
// Where such lights are combined with other techniques, an integrand that takes the whole sample is told the surface of the
// nearest light whichever technique drew the direction: s.surface next to s.distance.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/surface_point.hpp"
#include "lumis/lights/area_light.hpp"
#include "lumis/lights/area_light_by_solid_angle.hpp"

#include <concepts>

namespace lumis::LUMIS_ISA {

// The position is that of the coordinates within 3 units in the last place of the shape's largest coordinate, 6 on a sphere,
// however far away the light is; no ray is followed there. Where it lies on the shape is as exact as what it comes from: u
// by area and on spheres, else a rounded direction, which moves it by distance * epsilon / cos_light.
template <class S, class Sampling = ByArea>
class SurfaceLight {
    using Light = AreaLight<S, Sampling>;

  public:
    using Scalar = typename S::Scalar;
    using Point = Direction<Scalar>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    LUMIS_INLINE SurfaceLight(const S& shape, const glm::vec<3, Scalar>& reference_point) noexcept
        requires(!std::same_as<Sampling, ByCosine>)
        : light_{shape, reference_point}, shape_{shape} {}
    LUMIS_INLINE SurfaceLight(const S& shape, const glm::vec<3, Scalar>& reference_point, Sides sides) noexcept
        requires(!std::same_as<Sampling, ByCosine>)
        : light_{shape, reference_point, sides}, shape_{shape} {}
    // normal: of the receiver, see area_light_by_cosine.hpp.
    LUMIS_INLINE SurfaceLight(const S& shape, const glm::vec<3, Scalar>& reference_point,
                              const Direction<Scalar>& normal,
                              Sides sides = Sides::Both) noexcept requires std::same_as<Sampling, ByCosine>
        : light_{shape, reference_point, normal, sides}, shape_{shape} {}

    // As AreaLight's; nothing drawn: the surface point means nothing, but is finite.
    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_INLINE SurfaceLightSample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        const auto drawn = light_.sample(u);
        return {drawn.value, drawn.pdf, drawn.distance, light_.surface(shape_, u, drawn)};
    }

    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& w) const noexcept {
        return light_.pdf(w);
    }

    // From the reference point to the light; infinity where w misses it.
    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_HD R distance_along(const Direction<R>& w) const noexcept {
        return light_.distance_along(w);
    }

    // The same, and what the surface is where w meets it.
    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_HD LightHit<R> hit_along(const Direction<R>& w) const noexcept {
        return light_.hit_along(shape_, w);
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, Scalar> invert(const Point& w) const noexcept requires
        InvertibleStrategy<Light> {
        return light_.invert(w);
    }

    // See AreaLight.
    [[nodiscard]] LUMIS_HD Scalar pdf_from_hit(Scalar distance, Scalar cos_light) const noexcept
        requires(!std::same_as<Sampling, ByCosine>) {
        return light_.pdf_from_hit(distance, cos_light);
    }
    [[nodiscard]] LUMIS_HD Scalar
    pdf_from_hit(const Point& w) const noexcept requires std::same_as<Sampling, ByCosine> {
        return light_.pdf_from_hit(w);
    }

    [[nodiscard]] LUMIS_HD const S& shape() const noexcept LUMIS_LIFETIME_BOUND { return shape_; }

  private:
    Light light_;
    S shape_;
};

template <class S>
SurfaceLight(S, glm::vec<3, typename S::Scalar>) -> SurfaceLight<S, ByArea>;
template <class S>
SurfaceLight(S, glm::vec<3, typename S::Scalar>, Sides) -> SurfaceLight<S, ByArea>;

}  // namespace lumis::LUMIS_ISA
