// The density of a point of a light that the host has found itself: where a path's ray meets an emitter, its density among
// light samples is wanted for the MIS weight, and nothing else of the light. No light is made for it.
//
//     const float light_pdf = choice.pdf(i) * lumis::pdf_from_hit<lumis::BySolidAngle>(shapes[i], origin, distance, cos_light);
#pragma once

#include "lumis/core/assert.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/lights/area_light.hpp"
#include "lumis/lights/detail/hit_density.hpp"
#include "lumis/lights/shapes.hpp"
#include "lumis/lights/surface.hpp"

#include <concepts>
#include <numbers>

namespace lumis::LUMIS_ISA {

// Per solid angle, what AreaLight<Shape, Sampling>{shape, reference_point, sides}.pdf_from_hit(distance, cos_light) is, to a few
// units in the last place. distance: from the reference point to the hit; cos_light: there, of either sign, between the ray and
// the geometric normal. BySolidAngle needs neither, ByArea no reference point unless the light has one side or is a sphere.
template <class Sampling = ByArea, Shape S>
[[nodiscard]] LUMIS_INLINE inline typename S::Scalar pdf_from_hit(
    const S& shape, const glm::vec<3, typename S::Scalar>& reference_point, typename S::Scalar distance,
    typename S::Scalar cos_light, Sides sides = Sides::Both) noexcept {
    using T = typename S::Scalar;
    static_assert(!std::same_as<Sampling, ByCosine>,
                  "the density by cosine depends on the direction and the receiver's normal: write "
                  "AreaLight<Shape, ByCosine>{shape, reference_point, normal}.pdf_from_hit(w)");
    if constexpr (std::same_as<Sampling, BySolidAngle>) {
        static_assert(std::same_as<S, Triangle<T>> || std::same_as<S, Parallelogram<T>> || std::same_as<S, Sphere<T>>,
                      "by solid angle are drawn Triangle, Parallelogram and Sphere: write pdf_from_hit<ByArea>");
        return detail::density_by_solid_angle(shape, reference_point, sides);
    } else if constexpr (std::same_as<S, Triangle<T>> || std::same_as<S, Parallelogram<T>>) {
        return detail::density_by_area(detail::seen_area(detail::FlatShape<S>{shape, reference_point}, sides), distance,
                                       cos_light);
    } else if constexpr (std::same_as<S, Sphere<T>>) {
        using W = detail::Wide<T>;
        const auto seen = detail::SeenSphere<T>{shape, reference_point, sides}.seen;
        const W r{shape.radius}, area = 4 * std::numbers::pi_v<scalar_of<W>> * r * r;
        const T pdf = detail::density_by_area(area, distance, cos_light);
        return real::select(seen, pdf, 0);
    } else if (sides == Sides::Both) {
        return AreaLight<S, Sampling>{shape, reference_point}.pdf_from_hit(distance, cos_light);
    } else if constexpr (detail::SeenFromSides<S>) {
        return AreaLight<S, Sampling>{shape, reference_point, sides}.pdf_from_hit(distance, cos_light);
    } else {
        LUMIS_ASSERT(sides == Sides::Both);  // a shape that has no seen_from(point, sides) has no single side
        return 0;
    }
}

}  // namespace lumis::LUMIS_ISA
