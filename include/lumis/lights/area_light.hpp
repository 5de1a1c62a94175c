// A light of finite area as a distribution of directions from a reference point. World space, density per solid angle. It
// is seen from both sides, or as Sides says.
// ByArea draws a surface point evenly and converts the density; BySolidAngle draws a direction evenly over what is seen,
// see area_light_by_solid_angle.hpp; ByCosine where the cosine at the receiver is large too, see area_light_by_cosine.hpp.
#pragma once

#include "lumis/core/measure.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/lights/detail/disk_view.hpp"
#include "lumis/lights/detail/flat_view.hpp"
#include "lumis/lights/detail/sphere_view.hpp"
#include "lumis/lights/shapes.hpp"
#include "lumis/lights/surface.hpp"

#include <glm/geometric.hpp>

#include <concepts>
#include <limits>
#include <utility>

namespace lumis::LUMIS_ISA {

struct ByArea {};        // every shape
struct BySolidAngle {};  // Triangle, Parallelogram, Sphere
struct ByCosine {};      // Triangle, Parallelogram: by solid angle and the cosine at a receiver

// Shapes that a Sampling does not know. A disk is seen as an elliptic cone: a map even over that has no closed form.
template <class S, class Sampling = ByArea>
class AreaLight {
    static_assert(!std::same_as<Sampling, BySolidAngle>,
                  "lumis::AreaLight draws Triangle, Parallelogram and Sphere by solid angle (include "
                  "lumis/lights/area_light_by_solid_angle.hpp), of lanes only Sphere; any other shape ByArea, a Disk "
                  "for one");
    static_assert(
        !std::same_as<Sampling, ByCosine>,
        "lumis::AreaLight draws Triangle and Parallelogram by cosine (include "
        "lumis/lights/area_light_by_cosine.hpp), not of lanes; a Sphere BySolidAngle, any other shape ByArea");
    static_assert(std::same_as<Sampling, BySolidAngle> || std::same_as<Sampling, ByCosine>,
                  "lumis::AreaLight draws ByArea, BySolidAngle or ByCosine");
};
template <class S>
class AreaLight<S, ByArea> {
    static_assert(detail::is_shape<S>(), "lumis::AreaLight draws by area what is a lumis::Shape");
};

// A shape without area, seen edge-on, from distance 0 or one whose square is out of range draws nothing.
template <Shape S>
class AreaLight<S, ByArea> {
    using View = detail::ViewOf<S>;

  public:
    using Scalar = typename S::Scalar;
    using Point = Direction<Scalar>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    LUMIS_INLINE AreaLight(const S& shape, const glm::vec<3, Scalar>& reference_point) noexcept
        : view_{seen_from(shape, reference_point)},
          pdf_area_{real::quotient_where(view_.area() > 0, Scalar(1), view_.area())} {}
    LUMIS_INLINE AreaLight(const S& shape, const glm::vec<3, Scalar>& reference_point,
                           Sides sides) noexcept requires detail::SeenFromSides<S>
        : view_{seen_from(shape, reference_point, sides)},
          pdf_area_{real::quotient_where(view_.area() > 0, Scalar(1), view_.area())} {}

    template <RealOf<Scalar> R = Scalar>
        requires SurfaceView<View, R>
    [[nodiscard]] LUMIS_INLINE LightSample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        const SurfaceSample<R> point = view_.sample(u);
        const R squared = glm::dot(point.position, point.position);
        const auto valid = is_squared_length(squared);
        const R distance = real::select(valid, real::sqrt(squared), 0);
        const R inverse = 1 / real::divisor_where(valid, distance);
        return {real::select(valid, point.position * inverse, Direction<R>{}),
                density(distance, R(point.cos_times_distance * inverse)), distance};
    }

    template <RealOf<Scalar> R = Scalar>
        requires SurfaceView<View, R>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& w) const noexcept {
        const SurfaceHit<R> hit = view_.intersect(w);
        return density(hit.distance, hit.cos_light);
    }

    // From the reference point to the light; infinity where w misses it.
    template <RealOf<Scalar> R = Scalar>
        requires SurfaceView<View, R>
    [[nodiscard]] LUMIS_HD R distance_along(const Direction<R>& w) const noexcept {
        return detail::distance_or_infinity(view_.intersect(w));
    }

    // What the surface of the light's shape is where w meets it; for w that misses it the distance is infinite.
    template <RealOf<Scalar> R = Scalar>
        requires TellsSurface<View, S, R>
    [[nodiscard]] LUMIS_HD LightHit<R> hit_along(const S& shape, const Direction<R>& w) const noexcept {
        const SurfaceHit<R> hit = view_.intersect(w);
        return {detail::distance_or_infinity(hit), view_.surface(shape, w, hit)};
    }

    // What it is where sample(u) has drawn `drawn`.
    template <RealOf<Scalar> R = Scalar>
        requires TellsSurface<View, S, R>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface(const S& shape, const glm::vec<2, R>& u,
                                                       const LightSample<Direction<R>, R>& /*drawn*/) const noexcept {
        return view_.surface(shape, u);
    }

    // Not for spheres, on which two points can lie in one direction.
    [[nodiscard]] LUMIS_HD glm::vec<2, Scalar> invert(const Point& w) const noexcept requires
        requires(const View view) {
        view.invert(w);
    }
    { return view_.invert(w); }

    // For hosts that already know where a ray hit this light: the distance to the point, and the cosine there, of either
    // sign, between the ray and the normal of the shape itself. The cosine to an interpolated shading normal gives a density
    // that nothing is drawn with, and MIS weights that do not sum to 1: estimates are then biased by some percent.
    [[nodiscard]] LUMIS_HD Scalar pdf_from_hit(Scalar distance, Scalar cos_light) const noexcept {
        return density(distance, cos_light);
    }

    [[nodiscard]] LUMIS_HD Scalar area() const noexcept { return view_.area(); }

  private:
    template <Real R>
    [[nodiscard]] LUMIS_HD R density(R distance, R cos_light) const noexcept {
        return area_to_solid_angle(pdf_area_, distance, cos_light);
    }

    View view_;
    Scalar pdf_area_;
};

template <class S>
AreaLight(S, glm::vec<3, typename S::Scalar>) -> AreaLight<S, ByArea>;
template <class S>
AreaLight(S, glm::vec<3, typename S::Scalar>, Sides) -> AreaLight<S, ByArea>;

}  // namespace lumis::LUMIS_ISA
