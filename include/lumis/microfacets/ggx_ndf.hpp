// All GGX normals in proportion to their projected area: density D(wm) wm.z per solid angle of wm. Local frame.
// The classical half-vector sampling, Walter et al. 2007, eq. 35; it draws normals that wo does not see.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/spherical.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/microfacets/ggx.hpp"

#include <glm/geometric.hpp>

#include <concepts>

namespace lumis::LUMIS_ISA {

template <Real T = float>
class GgxNdf {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    // alpha: roughness along x and y, see ggx_min_alpha.
    LUMIS_HD explicit GgxNdf(glm::vec<2, T> alpha) noexcept : ggx_{alpha} {}
    // One roughness for both axes.
    LUMIS_HD explicit GgxNdf(T alpha) noexcept : ggx_{alpha} {}

    // At roughness 1 the normals are cosine distributed; stretching them gives the rest. The textbook's
    // tan(theta) = alpha sqrt(u / (1 - u)) divides by 0 at u = 1. u.y = phi / 2 pi before stretching.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD Sample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        const R radius = real::sqrt(u.x);
        const auto circle = unit_circle(u.y);
        const Direction<R> normal{ggx_.alpha().x * radius * circle.x, ggx_.alpha().y * radius * circle.y,
                                  real::sqrt(R(1 - u.x))};
        const R length = real::length(normal);
        Sample<Direction<R>, R> drawn{real::divide(normal, real::divisor_where(length > 0, length))};
        drawn.pdf = pdf(drawn.value);
        return drawn;
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& wm) const noexcept {
        return density_or_zero(R(ggx_.D(wm) * wm.z));
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& wm) const noexcept {
        const T x = real::divide(wm.x, ggx_.alpha().x), y = real::divide(wm.y, ggx_.alpha().y);
        const T slope = x * x + y * y;
        return {real::divide(slope, slope + wm.z * wm.z), turn_of(x, y)};
    }

    [[nodiscard]] LUMIS_HD const Ggx<T>& ggx() const noexcept { return ggx_; }

  private:
    Ggx<T> ggx_;
};

}  // namespace lumis::LUMIS_ISA
