// What a light's surface is, as seen from a reference point: a view of it draws points, and meets rays. Lights of shapes of
// your own need just this:
//
//     struct Ring {
//         using Scalar = float;
//         ...
//         [[nodiscard]] RingView seen_from(const glm::vec3& reference_point) const noexcept;  // or a function beside it
//     };
//     const lumis::AreaLight light{Ring{...}, point};
//
// where a RingView has what SurfaceView names. One with kernels for any Real R, in place of Scalar alone, also serves
// batches in lanes. A light of one side is made of seen_from(reference_point, sides), which then has no area from behind;
// one that tells its surface (see lights/surface_light.hpp) of what TellsSurface names.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/surface_point.hpp"
#include "lumis/lights/shapes.hpp"

#include <concepts>
#include <limits>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

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

// area() is that of the surface, 0 of one that draws nothing. sample(u), for u in [0,1]^2, yields its points evenly by area.
// intersect(w), for a unit vector w, yields the one point in that direction: sample and intersect have to agree on which
// side of the surface is seen. An invert(w), the u of that point, makes the light invertible.
template <class V, class R>
concept SurfaceView = Real<R> && requires(const V view, glm::vec<2, R> u, Direction<R> w) {
    { view.area() } -> std::convertible_to<R>;
    { view.sample(u) } -> std::same_as<SurfaceSample<R>>;
    { view.intersect(w) } -> std::same_as<SurfaceHit<R>>;
};

// What the surface is: surface(shape, u) at the point that sample(u) draws, surface(shape, w, hit) at the one where w meets it
// as intersect says. In world space; the view of its reference point alone need not know where that is.
template <class V, class S, class R>
concept TellsSurface = SurfaceView<V, R> &&
    requires(const V view, const S shape, glm::vec<2, R> u, Direction<R> w, SurfaceHit<R> hit) {
    { view.surface(shape, u) } -> std::same_as<SurfacePoint<R>>;
    { view.surface(shape, w, hit) } -> std::same_as<SurfacePoint<R>>;
};

// A shape may have seen_from as a member, or as a function in its namespace.
template <class S>
    requires requires(const S& shape, const glm::vec<3, typename S::Scalar>& reference_point) {
        shape.seen_from(reference_point);
    }
[[nodiscard]] LUMIS_INLINE inline auto seen_from(const S& shape,
                                                 const glm::vec<3, typename S::Scalar>& reference_point) noexcept {
    return shape.seen_from(reference_point);
}
template <class S>
    requires requires(const S& shape, const glm::vec<3, typename S::Scalar>& reference_point, Sides sides) {
        shape.seen_from(reference_point, sides);
    }
[[nodiscard]] LUMIS_INLINE inline auto seen_from(const S& shape, const glm::vec<3, typename S::Scalar>& reference_point,
                                                 Sides sides) noexcept {
    return shape.seen_from(reference_point, sides);
}

namespace detail {

template <class S>
concept HasScalar = Real<typename S::Scalar>;
template <class S>
concept SeenFromPoints = requires(const S& shape, const glm::vec<3, typename S::Scalar>& reference_point) {
    seen_from(shape, reference_point);
};

template <class S>
concept SeenFromSides = requires(const S& shape, const glm::vec<3, typename S::Scalar>& reference_point, Sides sides) {
    seen_from(shape, reference_point, sides);
};

}  // namespace detail

template <class S>
concept Shape = detail::HasScalar<S> && detail::SeenFromPoints<S> &&
    requires(const S& shape, const glm::vec<3, typename S::Scalar>& reference_point) {
    { seen_from(shape, reference_point) } -> SurfaceView<typename S::Scalar>;
};

namespace detail {

// What a shape is seen as. (nvcc's front end finds no function of the inline namespace from within a class.)
template <class S>
using ViewOf = decltype(seen_from(std::declval<const S&>(), std::declval<const glm::vec<3, typename S::Scalar>&>()));

// Whether S is a Shape: if not, what it lacks first is named.
template <class S>
[[nodiscard]] constexpr bool is_shape() noexcept {
    static_assert(HasScalar<S>, "a lumis::Shape has a type Scalar: float, double or lanes of them");
    if constexpr (HasScalar<S>) {
        static_assert(SeenFromPoints<S>,
                      "a lumis::Shape has seen_from(reference_point), or a function "
                      "seen_from(shape, reference_point) in its namespace");
        if constexpr (SeenFromPoints<S>) {
            static_assert(SurfaceView<ViewOf<S>, typename S::Scalar>, "seen_from yields a lumis::SurfaceView");
        }
    }
    return Shape<S>;
}

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

}  // namespace detail

}  // namespace lumis::LUMIS_ISA
