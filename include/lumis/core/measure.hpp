// Measures: what a density is a density of. Each is a type, so that two densities of different kinds cannot be mixed.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"

#include <type_traits>

namespace lumis::LUMIS_ISA {

namespace measure {
struct SolidAngle {};      // of directions, in steradians
struct Area {};            // of surface points, in the scene's units squared
struct AreaSolidAngle {};  // of rays that leave a surface: of their starts by area, times of their directions
struct Lebesgue {};        // of points of [0,1]^d or R^d
struct Counting {};        // of indices: the density is a probability
}  // namespace measure

// The one place where a density per area becomes one per solid angle: pdf_area distance^2 / |cos_light|, with the
// distance to the surface point and the cosine there between the surface normal and the direction (Veach 1997, eq. 8.2).
// Yields 0 where no density can be formed: edge-on, at distance 0, for a surface without area.
template <Real R>
[[nodiscard]] LUMIS_HD R area_to_solid_angle(std::type_identity_t<R> pdf_area, R distance, R cos_light) noexcept {
    const R cosine = real::abs(cos_light);
    return density_or_zero(real::quotient_where(cosine > 0, R(pdf_area * distance * distance), cosine));
}

}  // namespace lumis::LUMIS_ISA
