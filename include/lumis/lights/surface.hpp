// What the views of the shapes answer: a point drawn on a surface, and a ray's meeting with it, both as seen from a
// reference point.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"

#include <concepts>
#include <limits>

namespace lumis::detail {

// A point relative to the reference point, and the cosine at the light times its distance; 0: edge-on, or hidden.
template <Real R>
struct SurfaceSample {
    glm::vec<3, R> position{};
    R cos_times_distance{};
};

// Where a ray from the reference point meets the surface, and the cosine to its normal there; distance 0: nowhere.
template <Real R>
struct SurfaceHit {
    R distance{};
    R cos_light{};
};

// The hit where there is one, nowhere elsewhere.
template <Real R>
[[nodiscard]] LUMIS_HD SurfaceHit<R> hit_if(const MaskOf<R>& met, R distance,
                                            std::type_identity_t<R> cos_light) noexcept {
    return {real::select(met, distance, 0), real::select(met, cos_light, 0)};
}

// How far away the hit is; infinity for none.
template <Real R>
[[nodiscard]] LUMIS_HD R distance_or_infinity(const SurfaceHit<R>& hit) noexcept {
    return real::select(hit.distance > 0, hit.distance, std::numeric_limits<scalar_of<R>>::infinity());
}

}  // namespace lumis::detail
