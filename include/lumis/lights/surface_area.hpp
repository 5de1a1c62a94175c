// A shape's surface without a reference point, for photon, bidirectional and light tracing: SurfaceArea draws points of it,
// evenly by area, and SurfaceEmission rays that leave it. World space.
//
//     const SurfaceEmission lamp{triangle, Sides::One};
//     const auto s = lamp.sample(u);                              // u of 4 numbers
//     power = radiance(s.surface.uv) * cos / s.pdf;               // of the photon s.value.position, s.value.direction
#pragma once

#include "lumis/core/frame.hpp"
#include "lumis/core/measure.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/surface_point.hpp"
#include "lumis/directions/cosine_hemisphere.hpp"
#include "lumis/lights/detail/surfaces.hpp"
#include "lumis/lights/shapes.hpp"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <numbers>

namespace lumis::LUMIS_ISA {

// Triangle, Parallelogram, Disk, Sphere. The density is 1 / area on the surface, and 0 off it. It gives way by 16 units in the
// last place of the coordinates, so that what was drawn, or rounded, lies on the surface; what a ray has met may lie farther off:
// a host that knows so takes 1 / area().
template <class S>
class SurfaceArea {
  public:
    using Scalar = typename S::Scalar;
    using Point = glm::vec<3, Scalar>;
    using Measure = measure::Area;
    static constexpr int dimensions = 2;

    // A shape without area draws nothing.
    LUMIS_INLINE explicit SurfaceArea(const S& shape) noexcept
        : surface_{shape},
          pdf_{density_or_zero(real::quotient_where(surface_.area() > 0, Scalar(1), surface_.area()))} {}

    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_INLINE SurfaceAreaSample<glm::vec<3, R>, R> sample(glm::vec<2, R> u) const noexcept {
        const SurfacePoint<R> surface = surface_.sample(u);
        const auto drawn = pdf_ > 0 && all_finite(surface.position);
        return {real::select(drawn, surface.position, glm::vec<3, R>{R(scalar_of<R>(0))}),
                real::select(MaskOf<R>(drawn), R(pdf_), 0), surface};
    }

    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_HD R pdf(const glm::vec<3, R>& x) const noexcept {
        return real::select(surface_.contains(x), R(pdf_), 0);
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, Scalar> invert(const Point& x) const noexcept { return surface_.invert(x); }

    // The geometric normal at a point of the surface.
    [[nodiscard]] LUMIS_HD Direction<Scalar> normal_at(const Point& x) const noexcept { return surface_.normal_at(x); }

    [[nodiscard]] LUMIS_HD Scalar area() const noexcept { return surface_.area(); }

  private:
    detail::Surface<S> surface_;
    Scalar pdf_;
};

// A ray that leaves a surface.
template <Real R>
struct SurfaceRay {
    glm::vec<3, R> position{};
    Direction<R> direction{};
};

// Points evenly by area, and from each a direction with a density in proportion to its cosine to the normal: the rays of a
// Lambertian emitter in proportion to the power that they carry. The density, per area and solid angle, is cos / (pi area) from
// one side, and half of that where both sides emit.
template <class S>
class SurfaceEmission {
  public:
    using Scalar = typename S::Scalar;
    using Point = SurfaceRay<Scalar>;
    using Measure = measure::AreaSolidAngle;
    static constexpr int dimensions = 4;

    LUMIS_INLINE explicit SurfaceEmission(const S& shape, Sides sides = Sides::Both) noexcept
        : area_{shape}, sides_{sides} {}

    // u.x and u.y draw the point, u.z and u.w the direction; where both sides emit, u.w below 1/2 is the normal's.
    [[nodiscard]] LUMIS_HD SurfaceAreaSample<Point, Scalar> sample(glm::vec<4, Scalar> u) const noexcept {
        const auto start = area_.sample(glm::vec<2, Scalar>{u.x, u.y});
        if (!(start.pdf > 0)) return {};
        const bool is_front = sides_ == Sides::One || u.w < Scalar(0.5);
        const Scalar turn = sides_ == Sides::One ? u.w : is_front ? 2 * u.w : 2 * u.w - 1;
        const auto local = CosineHemisphere<Scalar>{}.sample(glm::vec<2, Scalar>{u.z, turn});
        const Direction<Scalar>& normal = start.surface.normal;
        const Direction<Scalar> w = Frame<Scalar>{is_front ? normal : -normal}.to_world(local.value);
        return {{start.value, w}, density_or_zero(start.pdf * local.pdf * share()), start.surface};
    }

    [[nodiscard]] LUMIS_HD Scalar pdf(const Point& ray) const noexcept {
        const Scalar signed_cosine = glm::dot(area_.normal_at(ray.position), ray.direction);
        const Scalar cosine = sides_ == Sides::One ? signed_cosine : real::abs(signed_cosine);
        const Direction<Scalar> local{Scalar(0), Scalar(0), cosine};
        return density_or_zero(area_.pdf(ray.position) * CosineHemisphere<Scalar>{}.pdf(local) * share());
    }

    // The power of a Lambertian emitter of radiance 1: pi times the area that emits.
    [[nodiscard]] LUMIS_HD Scalar power() const noexcept {
        return std::numbers::pi_v<scalar_of<Scalar>> * area_.area() / share();
    }

    [[nodiscard]] LUMIS_HD const SurfaceArea<S>& area() const noexcept LUMIS_LIFETIME_BOUND { return area_; }

  private:
    [[nodiscard]] LUMIS_HD Scalar share() const noexcept { return sides_ == Sides::One ? Scalar(1) : Scalar(0.5); }

    SurfaceArea<S> area_;
    Sides sides_;
};

}  // namespace lumis::LUMIS_ISA
