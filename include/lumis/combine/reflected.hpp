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

    // wo: unit, above the horizon.
    Reflected(const Point& wo, const Normals& normals) noexcept : wo_{wo}, normals_{normals} {}

    // Normals that reflect below the horizon draw nothing. The density is that of the direction as rounded, so that it
    // cancels exactly against a reflectance evaluated there.
    [[nodiscard]] Sample<Point, Scalar> sample(UniformsOf<Normals> u) const noexcept {
        const auto normal = normals_.sample(u);
        if (!(normal.pdf > 0)) return {};
        const Point& wm = normal.value;
        // Divided by wm's own length: else its rounding would lengthen wi, by up to five units in the last place.
        const Point wi = 2 * glm::dot(wo_, wm) / glm::dot(wm, wm) * wm - wo_;
        const Scalar density = pdf(wi);
        if (!(density > 0)) return {};
        return {wi, density};
    }

    // wo + wi is 2 (wo.wm) wm: its length is the Jacobian's cosine without the cancellation of a dot product, of which
    // grazing directions leave no digit. Normals whose density has that cosine as a factor say so, and it is never formed.
    [[nodiscard]] Scalar pdf(const Point& wi) const noexcept {
        if (!(wo_.z > 0 && wi.z > 0)) return 0;
        const Point half = wo_ + wi;
        const Scalar length = glm::length(half);
        if constexpr (requires { normals_.pdf_per_cosine(half); }) {
            return density_or_zero(normals_.pdf_per_cosine(half / length) / 4);
        } else {
            return density_or_zero(normals_.pdf(half / length) / (2 * length));
        }
    }

    [[nodiscard]] UniformsOf<Normals> invert(const Point& wi) const noexcept requires InvertibleStrategy<Normals> {
        const Point half = wo_ + wi;
        return normals_.invert(half / glm::length(half));
    }

    [[nodiscard]] const Normals& normals() const noexcept { return normals_; }

  private:
    Point wo_;
    Normals normals_;
};

}  // namespace lumis
