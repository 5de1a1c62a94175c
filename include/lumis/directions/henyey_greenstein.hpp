// Scattering in fog, clouds, milk, skin: Henyey and Greenstein's phase function (1941). World space, density per solid angle;
// the density is the phase function itself, so that a sample's weight is the single-scattering albedo alone.
//
// The textbook's cosine, (1 + g^2 - ((1 - g^2) / (1 + g - 2 g u))^2) / (2 g), is 0 / 0 at g = 0, loses its digits near it, and
// has none left of the lobe's angle near |g| = 1. Solved for 1 - cos(theta) it is a product without a difference.
#pragma once

#include "lumis/core/assert.hpp"
#include "lumis/core/frame.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/spherical.hpp"
#include "lumis/core/strategy.hpp"

#include <numbers>
#include <type_traits>

namespace lumis::LUMIS_ISA {

template <Real T = float>
class HenyeyGreenstein {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 2;

    // wo: unit, away from the point, as all directions; light that goes straight on leaves along -wo. g in (-1, 1): the mean of
    // cos(theta) between -wo and the scattered direction. Positive g scatters forward, as most matter does, 0 evenly, negative g
    // back. Nothing is drawn for any other g, nor for a wo without a direction.
    LUMIS_INLINE HenyeyGreenstein(const Direction<T>& wo, std::type_identity_t<T> g) noexcept
        : HenyeyGreenstein{detail::unit_or(wo, 0), g, detail::is_unit(detail::unit_or(wo, 0)) && real::abs(g) < 1} {
        LUMIS_ASSERT(real::all(detail::is_unit(wo)) && real::all(real::abs(g) <= 1));
    }

    // u.x = the probability of directions nearer to the lobe's peak, which is -wo, and wo for negative g; u.y = phi / 2 pi.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE Sample<Direction<R>, R> sample(glm::vec<2, R> u) const noexcept {
        // With a = 1 - |g|, b = 1 + |g|: 1 - cos(theta) = 2 a^2 u (1 + |g| (1 - u)) / s^2, and 1 + cos(theta) is the same of
        // 1 - u and -|g|; s = a + 2 |g| (1 - u).
        const R rest = 1 - u.x, part = g_ * rest, s = a_ + 2 * part;
        const R inverse = 1 / (s * s);
        const R versine = 2 * a_ * a_ * u.x * (1 + part) * inverse;
        const R opposite = 2 * b_ * b_ * rest * (a_ + part) * inverse;
        // Whichever is the smaller has the digits: 1 - versine alone is no unit vector's next to -1.
        const R sine = real::sqrt(R(versine * opposite)), cosine = real::select(versine < 1, 1 - versine, opposite - 1);
        const auto circle = unit_circle(u.y);
        return {frame_.to_world(Direction<R>{sine * circle.x, sine * circle.y, cosine}), s * s * s * scale_};
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& wi) const noexcept {
        const R d = a_ * a_ + g_ * doubled_versine(wi);
        return density_or_zero(real::select(MaskOf<R>(scale_ > 0), R(a_ * b_ * inv_four_pi / (d * real::sqrt(d))), 0));
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const Point& wi) const noexcept {
        const T versine = doubled_versine(wi) / 2, root = real::sqrt(T(a_ * a_ + 2 * g_ * versine));
        const Direction<T> local = frame_.to_local(wi);
        return {b_ * versine / (root * (root + a_)), turn_of(local.x, local.y)};
    }

  private:
    static constexpr scalar_of<T> inv_four_pi = std::numbers::inv_pi_v<scalar_of<T>> / 4;

    LUMIS_INLINE HenyeyGreenstein(const Direction<T>& wo, T g, const MaskOf<T>& is_valid) noexcept
        : frame_{real::select(is_valid, real::select(MaskOf<T>(g < 0), wo, -wo), Direction<T>{T(0), T(0), T(1)})},
          g_{real::select(is_valid, real::abs(g), 0)},
          a_{1 - g_},
          b_{1 + g_},
          scale_{real::select(is_valid, T(inv_four_pi / (a_ * a_ * b_ * b_)), 0)} {}

    // |wi - axis|^2, which keeps the digits of a small angle.
    template <Real R>
    [[nodiscard]] LUMIS_HD R doubled_versine(const Direction<R>& wi) const noexcept {
        const Direction<R> difference = real::rounded(wi - Direction<R>(frame_.normal()));
        return detail::dot(difference, difference);
    }

    Frame<T> frame_;
    T g_, a_, b_;
    T scale_;  // 1 / (4 pi (1 - g^2)^2); 0 if nothing is drawn
};

}  // namespace lumis::LUMIS_ISA
