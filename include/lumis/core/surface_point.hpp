// What lights tell of the surface that a direction meets, for textured emitters and hosts that go on from there.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/strategy.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <concepts>
#include <limits>

namespace lumis::LUMIS_ISA {

// A point of a surface, in world space: where it lies, the unit geometric normal there, and its coordinates on the shape,
// see lights/shapes.hpp.
template <Real R>
struct SurfacePoint {
    glm::vec<3, R> position{};
    Direction<R> normal{};
    glm::vec<2, R> uv{};
};

// A LightSample that tells the surface point which it was drawn at.
template <class Point, Real Scalar>
struct SurfaceLightSample {
    Point value{};
    Scalar pdf{};
    Scalar distance{};
    SurfacePoint<Scalar> surface{};
};

// A point drawn of a surface, or a ray that leaves it, and the surface there.
template <class Point, Real Scalar>
struct SurfaceAreaSample {
    Point value{};
    Scalar pdf{};
    SurfacePoint<Scalar> surface{};
};

// Where a direction meets a light; distance infinity: nowhere, and the surface point means nothing.
template <Real R>
struct LightHit {
    R distance{std::numeric_limits<scalar_of<R>>::infinity()};
    SurfacePoint<R> surface{};
};

// A LightStrategy that tells more of what a direction meets than how far away it is.
template <class S>
concept SurfaceStrategy = LightStrategy<S> && requires(const S light, typename S::Point w) {
    { light.hit_along(w) } -> std::same_as<LightHit<typename S::Scalar>>;
};

namespace detail {

template <class Drawn>
concept HasSurface = requires(const Drawn drawn) {
    drawn.surface;
};

template <Real R>
[[nodiscard]] LUMIS_HD SurfacePoint<R> select(const MaskOf<R>& condition, const SurfacePoint<R>& a,
                                              const SurfacePoint<R>& b) noexcept {
    return {real::select(condition, a.position, b.position), real::select(condition, a.normal, b.normal),
            glm::vec<2, R>{real::select(condition, a.uv.x, b.uv.x), real::select(condition, a.uv.y, b.uv.y)}};
}

// The nearer of what a sample has and a light's hit, where the condition holds.
template <class Drawn, Real R>
LUMIS_HD void keep_nearer(Drawn& sample, const LightHit<R>& hit, const MaskOf<R>& condition = true) noexcept {
    const auto is_nearer = condition && hit.distance < sample.distance;
    sample.distance = real::select(is_nearer, hit.distance, sample.distance);
    sample.surface = select(is_nearer, hit.surface, sample.surface);
}

}  // namespace detail

}  // namespace lumis::LUMIS_ISA
