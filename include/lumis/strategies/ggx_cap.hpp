// What sampling visible GGX normals and its bounded form share: stretched to roughness 1, reflected rays fill a spherical
// cap evenly, and the normal is half-way between wo and the ray. Dupuy and Benyoub 2023; Eto and Tokuyoshi 2023.
#pragma once

#include "lumis/core/spherical.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/strategies/ggx.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <concepts>

namespace lumis::detail {

template <std::floating_point T>
class GgxCap {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    // The cap is z > -(1 - shortfall) wo.z, with wo stretched.
    GgxCap(const Direction<T>& wo, const Ggx<T>& ggx, T shortfall) noexcept
        : ggx_{ggx},
          wo_{wo},
          length_{ggx_.stretched_length(wo)},
          wo_std_{ggx_.alpha().x * wo.x / length_, ggx_.alpha().y * wo.y / length_, wo.z / length_},
          shortfall_{shortfall},
          cap_height_{1 + (1 - shortfall) * wo_std_.z} {}

    // u.x = 0 is the top of the cap, u.y = phi / 2 pi. The half vector's z is kept as a sum of positive products: the
    // textbook's cancels at grazing incidence.
    [[nodiscard]] Sample<Point, T> sample(glm::vec<2, T> u) const noexcept {
        if (!(wo_.z > 0)) return {};
        const Direction<T> reflected = direction_at(u.x * cap_height_, u.y);
        const Direction<T> normal{ggx_.alpha().x * (reflected.x + wo_std_.x),
                                  ggx_.alpha().y * (reflected.y + wo_std_.y),
                                  (1 - u.x) * cap_height_ + shortfall_ * wo_std_.z};
        const T length = glm::length(normal);
        if (!(length > 0)) return {};
        const Point wm = normal / length;
        return {wm, pdf(wm)};
    }

    // G1(wo) / wo.z is 2 / (wo.z + stretched length), which is finite at grazing.
    [[nodiscard]] T pdf(const Point& wm) const noexcept {
        const T cos_om = glm::dot(wo_, wm);
        return cos_om > 0 ? density_or_zero(cos_om * pdf_per_cosine(wm)) : T(0);
    }

    // pdf(wm) / wo.wm, of normals that wo sees: what is left of it after reflection.
    [[nodiscard]] T pdf_per_cosine(const Point& wm) const noexcept {
        return wo_.z > 0 ? density_or_zero(2 * ggx_.D(wm) / ((1 - shortfall_) * wo_.z + length_)) : T(0);
    }

    [[nodiscard]] glm::vec<2, T> invert(const Point& wm) const noexcept {
        const Direction<T> stretched{wm.x / ggx_.alpha().x, wm.y / ggx_.alpha().y, wm.z};
        const Direction<T> half = stretched / glm::length(stretched);
        const Direction<T> reflected = 2 * glm::dot(wo_std_, half) * half - wo_std_;
        return {versine_of(reflected) / cap_height_, turn_of(reflected.x, reflected.y)};
    }

    [[nodiscard]] const Ggx<T>& ggx() const noexcept { return ggx_; }

  private:
    Ggx<T> ggx_;
    Direction<T> wo_;
    T length_;             // of wo stretched by alpha
    Direction<T> wo_std_;  // wo stretched by alpha, unit
    T shortfall_;
    T cap_height_;
};

}  // namespace lumis::detail
