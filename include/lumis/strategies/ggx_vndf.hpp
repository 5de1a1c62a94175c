// GGX normals as seen from wo: density G1(wo) max(0, wo.wm) D(wm) / wo.z per solid angle of wm. Local frame.
// Heitz 2018, "Sampling the GGX Distribution of Visible Normals"; drawn by spherical caps, Dupuy and Benyoub 2023.
#pragma once

#include "lumis/core/spherical.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/strategies/ggx.hpp"

namespace lumis {

template <std::floating_point T = float>
class GgxVndf {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    // wo: unit; on or below the horizon nothing is drawn. alpha: roughness along x and y, see ggx_min_alpha.
    GgxVndf(const Direction<T>& wo, glm::vec<2, T> alpha) noexcept
        : ggx_{alpha},
          wo_{wo},
          length_{ggx_.stretched_length(wo)},
          wo_std_{ggx_.alpha().x * wo.x / length_, ggx_.alpha().y * wo.y / length_, wo.z / length_} {}

    // Stretched to roughness 1, reflected rays fill the spherical cap z > -wo.z evenly; the normal is half-way between.
    // u.x = 0 is the top of the cap, u.y = phi / 2 pi. The cap's height and the half vector's z are kept as products:
    // their textbook sums cancel at grazing incidence.
    [[nodiscard]] Sample<Point, T> sample(glm::vec<2, T> u) const noexcept {
        if (!(wo_.z > 0)) return {};
        const T cap_height = 1 + wo_std_.z;
        const Direction<T> reflected = direction_at(u.x * cap_height, u.y);
        const Direction<T> normal{ggx_.alpha().x * (reflected.x + wo_std_.x),
                                  ggx_.alpha().y * (reflected.y + wo_std_.y), (1 - u.x) * cap_height};
        const T length = glm::length(normal);
        if (!(length > 0)) return {};
        const Point wm = normal / length;
        return {wm, pdf(wm)};
    }

    // G1(wo) / wo.z is 2 / (wo.z + stretched length), which is finite at grazing.
    [[nodiscard]] T pdf(const Point& wm) const noexcept {
        const T cos_om = glm::dot(wo_, wm);
        if (!(wo_.z > 0 && cos_om > 0)) return T(0);
        return density_or_zero(2 * cos_om * ggx_.D(wm) / (wo_.z + length_));
    }

    [[nodiscard]] const Ggx<T>& ggx() const noexcept { return ggx_; }

  private:
    Ggx<T> ggx_;
    Direction<T> wo_;
    T length_;             // of wo stretched by alpha
    Direction<T> wo_std_;  // wo stretched by alpha, unit
};

}  // namespace lumis
