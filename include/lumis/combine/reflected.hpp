// Directions by mirroring wo about sampled microfacet normals. Local frame, density per solid angle of wi.
// The reflection Jacobian d(wm)/d(wi) = 1 / (4 wo.wm) (Walter et al. 2007, eq. 14) lives here and nowhere else.
#pragma once

#include "lumis/core/strategy.hpp"

#include <glm/geometric.hpp>

namespace lumis {

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
    [[gnu::always_inline]] Reflected(const Point& wo, const Normals& normals) noexcept
        : wo_{above_horizon_or_zero(wo)}, normals_{normals} {}

    // Normals that reflect below the horizon draw nothing. The density is that of the direction as rounded, so that it
    // cancels exactly against a reflectance evaluated there.
    template <RealOf<Scalar> R = Scalar>
    [[nodiscard, gnu::always_inline]] Sample<Direction<R>, R> sample(glm::vec<dimensions, R> u) const noexcept {
        const Direction<R> wm = normal(u), wo{wo_};
        // Divided by wm's own length, whether it is a unit vector or not: else its rounding would lengthen wi, by up to
        // five units in the last place.
        const R square = glm::dot(wm, wm);
        Sample<Direction<R>, R> drawn{real::select(square > 0, 2 * glm::dot(wo, wm) / square, 0) * wm - wo};
        drawn.pdf = pdf(drawn.value);
        return drawn;
    }

    // wo + wi is 2 (wo.wm) wm: its length is the Jacobian's cosine without the cancellation of a dot product, of which
    // grazing directions leave no digit. Normals whose density has that cosine as a factor say so, and it is never formed.
    template <RealOf<Scalar> R = Scalar>
    [[nodiscard]] R pdf(const Direction<R>& wi) const noexcept {
        const Direction<R> half = Direction<R>(wo_) + wi;
        R density;
        if constexpr (requires { normals_.pdf_per_cosine(half); }) {
            density = normals_.pdf_per_cosine(half) / 4;
        } else {
            const R length = real::length(half);
            density = normals_.pdf(Direction<R>(half / length)) / (2 * length);
        }
        return density_or_zero(real::select(wi.z > 0 && wo_.z > 0, density, 0));
    }

    [[nodiscard]] UniformsOf<Normals> invert(const Point& wi) const noexcept requires InvertibleStrategy<Normals> {
        const Point half = wo_ + wi;
        return normals_.invert(half / real::length(half));
    }

    [[nodiscard]] const Normals& normals() const noexcept { return normals_; }

  private:
    // A normal, if its length does not matter one of any length; 0 if none was drawn.
    template <Real R>
    [[nodiscard]] Direction<R> normal(glm::vec<dimensions, R> u) const noexcept {
        if constexpr (requires { normals_.along_normal(u); }) {
            return normals_.along_normal(u);
        } else {
            const auto drawn = normals_.sample(u);
            return real::select(drawn.pdf > 0, Direction<R>(drawn.value), Direction<R>{});
        }
    }

    Point wo_;
    Normals normals_;
};

}  // namespace lumis
