// What sampling visible GGX normals and its bounded form share: stretched to roughness 1, reflected rays fill a spherical
// cap evenly, and the normal is half-way between wo and the ray. Dupuy and Benyoub 2023; Eto and Tokuyoshi 2023.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/spherical.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/microfacets/ggx.hpp"

#include <glm/geometric.hpp>

#include <concepts>

namespace lumis::LUMIS_ISA::detail {

template <Real T>
class GgxCap {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    // The cap is z > -(1 - shortfall) wo.z, with wo stretched; shortfall_of(wo, alpha) is asked for a unit wo or 0.
    template <class ShortfallOf>
    LUMIS_INLINE GgxCap(const Direction<T>& wo, const Ggx<T>& ggx, const ShortfallOf& shortfall_of) noexcept
        : ggx_{ggx}, wo_{above_horizon_or_zero(wo)} {
        const T length = ggx_.stretched_length(wo_);
        const auto seen = is_squared_length(T(length * length));
        if (real::all(!seen)) return;
        const T shortfall = shortfall_of(wo_, ggx.alpha());
        const Direction<T> stretched{ggx_.alpha().x * wo_.x, ggx_.alpha().y * wo_.y, wo_.z};
        wo_std_ = real::select(seen, real::divide(stretched, length), wo_std_);
        shortfall_ = shortfall;
        cap_height_ = 1 + (1 - shortfall) * wo_std_.z;
        masking_ = real::select(seen, real::divide(T(2), (1 - shortfall) * wo_.z + length), 0);
    }

    // u.x = 0 is the top of the cap, u.y = phi / 2 pi.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD Sample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        const Direction<R> normal = along_normal(u);
        const R length = real::length(normal);
        Sample<Direction<R>, R> drawn{real::divide(normal, real::divisor_where(length > 0, length))};
        drawn.pdf = pdf(drawn.value);
        return drawn;
    }

    // The drawn normal, of any length, for callers that need no unit vector. Its z is formed as a sum of positive products:
    // the textbook's z of the half vector cancels at grazing incidence.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE Direction<R> along_normal(glm::vec<2, R> u) const noexcept {
        const Direction<R> reflected = direction_at(R(u.x * cap_height_), u.y);
        return {ggx_.alpha().x * (reflected.x + wo_std_.x), ggx_.alpha().y * (reflected.y + wo_std_.y),
                (1 - u.x) * cap_height_ + shortfall_ * wo_std_.z};
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& wm) const noexcept {
        return density_or_zero(R(glm::dot(Direction<R>(wo_), wm) * pdf_per_cosine(wm)));
    }

    // pdf(wm) / wo.wm for normals that wo sees, which is all that reflection leaves of it. wm may have any length.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf_per_cosine(const Direction<R>& wm) const noexcept {
        return masking_ * ggx_.D(wm);
    }

    // The GGX reflectance times wi.z over the density of wi by reflection, see Reflected::weight. D cancels.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R reflection_weight(const Direction<R>& wi) const noexcept {
        return weight_of(wi, R(ggx_.visibility(wo_, wi)));
    }
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R reflection_weight_separable(const Direction<R>& wi) const noexcept {
        return weight_of(wi, R(ggx_.visibility_separable(wo_, wi)));
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& wm) const noexcept {
        const Direction<T> stretched{real::divide(wm.x, ggx_.alpha().x), real::divide(wm.y, ggx_.alpha().y), wm.z};
        const Direction<T> half = real::divide(stretched, real::length(stretched));
        const Direction<T> reflected = 2 * glm::dot(wo_std_, half) * half - wo_std_;
        return {real::divide(versine_of(reflected), cap_height_), turn_of(reflected.x, reflected.y)};
    }

    [[nodiscard]] LUMIS_HD const Ggx<T>& ggx() const noexcept { return ggx_; }

  private:
    template <Real R>
    [[nodiscard]] LUMIS_HD R weight_of(const Direction<R>& wi, R visibility) const noexcept {
        return real::quotient_where(wi.z > 0 && masking_ > 0, R(4 * wi.z * visibility), R(masking_));
    }

    Ggx<T> ggx_;
    Direction<T> wo_;
    Direction<T> wo_std_{T(0)};  // wo stretched by alpha, unit
    T shortfall_{0};
    T cap_height_{1};
    T masking_{0};  // G1(wo) / wo.z, which is finite at grazing; 0 on and below the horizon
};

}  // namespace lumis::LUMIS_ISA::detail
