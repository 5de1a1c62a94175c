// Triangles and parallelograms by solid angle and by the cosine at the receiver, of which `normal` is the normal there: nearly
// even over projected solid angle, so that the irradiance of a uniform light has next to no variance. World space, density per
// solid angle. Only what is above the receiver's horizon is drawn; a light that is wholly below draws nothing.
//
//     const AreaLight<Triangle<float>, ByCosine> light{triangle, point, normal};
//
// See detail/cosine_map.hpp for how. To make one and draw from it takes twice as long as BySolidAngle, three times where the normal
// points at the light; its density, which inverts the map, ten times. Where a light is far away, and so at nearly one cosine,
// BySolidAngle does as well.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/lights/area_light.hpp"
#include "lumis/lights/area_light_by_solid_angle.hpp"
#include "lumis/lights/detail/cosine_map.hpp"

namespace lumis::LUMIS_ISA {

template <class S>
    requires(std::same_as<S, Triangle<typename S::Scalar>> || std::same_as<S, Parallelogram<typename S::Scalar>>)
&&std::floating_point<typename S::Scalar> class AreaLight<S, ByCosine> {
    using T = typename S::Scalar;

  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    // normal: unit, of the receiver; the horizon is at right angles to it. A light of which nothing is above draws nothing, nor
    // does one that subtends nothing.
    LUMIS_INLINE AreaLight(const S& shape, const glm::vec<3, T>& reference_point, const Direction<T>& normal,
                           Sides sides = Sides::Both) noexcept
        : AreaLight{detail::FlatShape<S>{shape, reference_point}.facing(sides), detail::unit_or(normal, 0)} {
        LUMIS_ASSERT(detail::is_unit(normal));
    }

    // u.x goes around the point of the light that is nearest to the normal, by solid angle and cosine; u.y away from it. In a
    // rectangle that the normal does not point at or close by, u.x goes along the more level edge and u.y along the steeper one.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE LightSample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        if (map_.empty()) return {};
        const auto [w, pdf] = map_.sample(u);
        // Rounding may put a direction below the horizon, and edges out of range may leave no density.
        const auto is_drawn = glm::dot(w, Direction<R>(normal_)) > 0 && pdf > 0;
        return detail::seen_on_plane(w, R(real::select(is_drawn, pdf, 0)), view_.meet_plane(w).distance);
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& w) const noexcept {
        if constexpr (std::floating_point<R>) {
            return view_.intersect(w, 4).distance > 0 ? pdf_from_hit(w) : T(0);
        } else {
            return R::of_lanes([&](auto i) { return pdf(Direction<T>{w.x[i], w.y[i], w.z[i]}); });
        }
    }

    // The same, for hosts that know already that w meets the light.
    [[nodiscard]] LUMIS_HD T pdf_from_hit(const Point& w) const noexcept {
        const T density = !map_.empty() && glm::dot(w, normal_) > 0 ? map_.pdf(w) : T(0);
        return density > 0 ? density : T(0);
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& w) const noexcept {
        return map_.empty() ? glm::vec<2, T>{T(0), T(0)} : map_.invert(w);
    }

    // The distance from the reference point to the light, as far as it is above the horizon or not; infinity where w misses it.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R distance_along(const Direction<R>& w) const noexcept {
        return detail::distance_or_infinity(view_.intersect(w));
    }

    // What the surface of the light's shape is where w meets it; for w that misses it the distance is infinite.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD LightHit<R> hit_along(const S& shape, const Direction<R>& w) const noexcept {
        const SurfaceHit<R> hit = view_.intersect(w);
        return {detail::distance_or_infinity(hit), view_.surface(shape, w, hit)};
    }

    // What it is where sample(u) has drawn `drawn`.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE SurfacePoint<R> surface(const S& shape, const glm::vec<2, R>& /*u*/,
                                                       const LightSample<Direction<R>, R>& drawn) const noexcept {
        return view_.surface(shape, drawn.value, view_.meet_plane(drawn.value));
    }

  private:
    LUMIS_INLINE AreaLight(const detail::FlatShape<S>& shape, const Direction<T>& normal) noexcept
        : view_{shape}, map_{shape, normal}, normal_{normal} {}

    detail::FlatView<S> view_;
    detail::CosineMap<S> map_;
    Direction<T> normal_;
};

}  // namespace lumis::LUMIS_ISA
