// Directions by mirroring wo about sampled microfacet normals. Local frame, density per solid angle of wi.
// The reflection Jacobian d(wm)/d(wi) = 1 / (4 wo.wm) (Walter et al. 2007, eq. 14) lives here and nowhere else.
#pragma once

#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"

namespace lumis::LUMIS_ISA {

template <Strategy Normals>
class Reflected {
  public:
    using Scalar = typename Normals::Scalar;
    using Point = Direction<Scalar>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = Normals::dimensions;

    static_assert(std::same_as<typename Normals::Point, Point> &&
                      std::same_as<typename Normals::Measure, measure::SolidAngle>,
                  "Reflected needs a strategy over normals, with a density per solid angle");

    // wo: unit; on or below the horizon nothing is drawn.
    LUMIS_INLINE Reflected(const Point& wo, const Normals& normals) noexcept
        : wo_{above_horizon_or_zero(wo)}, normals_{normals} {}

    // Normals that reflect below the horizon draw nothing. The density is that of the direction as rounded, so that it
    // cancels exactly against a reflectance evaluated there.
    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_INLINE Sample<Direction<R>, R> sample(glm::vec<dimensions, R> u) const noexcept {
        const Direction<R> wm = normal(u), wo{wo_};
        // Divides by wm's own length, even if it is meant to be 1: otherwise its rounding would lengthen wi by up to five
        // units in the last place. The result is kept as rounded: wo + wi, from which pdf starts, is another vector than
        // the one that was subtracted from.
        const R square = real::dot(wm, wm);
        Sample<Direction<R>, R> drawn{
            real::rounded(real::quotient_where(square > 0, R(2 * real::dot(wo, wm)), square) * wm - wo)};
        drawn.pdf = pdf(drawn.value);
        return drawn;
    }

    // wo + wi is 2 (wo.wm) wm. Its length gives the Jacobian's cosine, wo.wm, without the cancellation of a dot product,
    // which leaves no digit at grazing incidence. Normals whose density has wo.wm as a factor offer pdf_per_cosine, the
    // density without it; then wo.wm is never formed.
    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& wi) const noexcept {
        const Direction<R> half = Direction<R>(wo_) + wi;
        R density;
        if constexpr (requires { normals_.pdf_per_cosine(half); }) {
            density = normals_.pdf_per_cosine(half) / 4;
        } else {
            const R length = real::length(half);
            const R divisor = real::divisor_where(length > 0, length);  // 0 for wi == -wo
            density = real::divide(detail::pdf_in<R>(normals_, real::divide(half, divisor)), 2 * divisor);
        }
        return density_or_zero(real::select(wi.z > 0 && wo_.z > 0, density, 0));
    }

    // What a sample is worth: reflectance times wi.z over the density, with Fresnel reflectance 1. From 0 to 1. D, which a
    // smooth surface makes huge, is not formed. Separable: with G1(wo) G1(wi) for G2, see Ggx.
    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_HD R weight(const Direction<R>& wi) const noexcept requires requires(const Normals& normals) {
        normals.reflection_weight(wi);
    }
    { return normals_.reflection_weight(wi); }
    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] LUMIS_HD R weight_separable(const Direction<R>& wi) const noexcept requires
        requires(const Normals& normals) {
        normals.reflection_weight_separable(wi);
    }
    { return normals_.reflection_weight_separable(wi); }

    [[nodiscard]] LUMIS_HD UniformsOf<Normals> invert(const Point& wi) const noexcept requires
        InvertibleStrategy<Normals> {
        const Point half = wo_ + wi;
        return normals_.invert(real::divide(half, real::length(half)));
    }

    [[nodiscard]] LUMIS_HD const Normals& normals() const noexcept { return normals_; }

  private:
    // A drawn normal, or 0 if none was drawn. It is of any length where the strategy can spare normalising it.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE Direction<R> normal(glm::vec<dimensions, R> u) const noexcept {
        if constexpr (requires { normals_.along_normal(u); }) {
            return normals_.along_normal(u);
        } else {
            const auto drawn = detail::sample_in<R>(normals_, u);
            return real::select(drawn.pdf > 0, Direction<R>(drawn.value), Direction<R>{});
        }
    }

    Point wo_;
    Normals normals_;
};

}  // namespace lumis::LUMIS_ISA
