// How much unpolarised light a smooth boundary reflects and lets through: Fresnel's equations for dielectrics and conductors.
// Every term is a quotient of sums of positive numbers, or of squares. The textbook's differences (Born and Wolf 1999,
// section 1.5.2) lose their digits where the indices are nearly the same, and 1 - F loses them where nearly all is reflected.
#pragma once

#include "lumis/core/detail/arguments.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <limits>
#include <type_traits>

namespace lumis::LUMIS_ISA {

// Shares of the power that arrives, which sum to 1, and the cosine of the refracted ray, 0 where all is reflected.
template <Real R>
struct FresnelShares {
    R reflected{};
    R transmitted{};
    R cos_t{};
};

namespace detail {

// 1 / x for a squared length; 0 for one too small to be a normal number, of light along the boundary.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline R reciprocal_or_zero(R x) noexcept {
    return real::quotient_where(x >= (std::numeric_limits<R>::min)(), R(scalar_of<R>(1)), x);
}

// A share, which rounding may make more than 1; NaN stays.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline R at_most_one(R share) noexcept {
    return real::lesser(share, scalar_of<R>(1));
}

// A boundary as light meets it. eta: the index on the other side over the one on this side; excess: eta^2 - 1, given
// apart because it cancels.
template <Real T>
struct IndexRatio {
    T eta;
    T excess;

    // Covers a ratio, and its reciprocal.
    [[nodiscard]] LUMIS_INLINE static IndexRatio of(T eta) noexcept { return {eta, (eta - 1) * (eta + 1)}; }
    [[nodiscard]] LUMIS_INLINE static IndexRatio reciprocal(T eta) noexcept {
        const T inverse = real::divide(T(1), eta);
        return {inverse, (1 - eta) * (1 + eta) * inverse * inverse};
    }

    // eta cos_t by Snell's law, for a cosine of at least 0; 0 where all is reflected. Its square is eta^2 - sin_i^2, or the same
    // by excess and cosine: what cancels the less.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE R eta_cos_t(R cos_i) const noexcept {
        const R by_sine = eta * eta - squared_sine(cos_i), by_cosine = cos_i * cos_i + excess;
        return real::sqrt_or_zero(real::select(R(excess) < scalar_of<R>(-0.5), by_sine, by_cosine));
    }

    // r_s = -excess / (cos_i + eta cos_t)^2 and r_p = excess (eta^2 cos_i^2 - sin_i^2) / (eta^2 cos_i + eta cos_t)^2: the
    // textbook's fractions, extended by their divisors.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE R reflected(R cos_i, R eta_cos_t) const noexcept {
        const R s = squared(R(cos_i + eta_cos_t)), p = squared(R(eta * eta * cos_i + eta_cos_t));
        const R brewster = eta * eta * cos_i * cos_i - squared_sine(cos_i);
        const R r_s = real::divide(R(excess), real::divisor_where(s > 0, s));
        const R r_p = real::divide(R(excess * brewster), real::divisor_where(p > 0, p));
        const auto is_total = eta_cos_t <= 0 && excess < 0;
        return real::select(is_total, R(scalar_of<R>(1)), at_most_one(scalar_of<R>(0.5) * (r_s * r_s + r_p * r_p)));
    }

    template <Real R>
    [[nodiscard]] LUMIS_INLINE static R squared_sine(R cosine) noexcept {
        return (1 - cosine) * (1 + cosine);
    }

    // 1 - r_s^2 and 1 - r_p^2, each a fraction of the same divisors, without the difference.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE R transmitted(R cos_i, R eta_cos_t) const noexcept {
        const R s = cos_i + eta_cos_t, p = eta * cos_i + real::divide(eta_cos_t, R(eta));
        return at_most_one(2 * cos_i * eta_cos_t * (reciprocal_or_zero(R(s * s)) + reciprocal_or_zero(R(p * p))));
    }
};

// What the boundary between two media is to light from one side of it.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline IndexRatio<R> index_ratio(R eta, const MaskOf<R>& from_below) noexcept {
    if constexpr (std::floating_point<R>) {
        return from_below ? IndexRatio<R>::reciprocal(eta) : IndexRatio<R>::of(eta);
    } else {
        const auto above = IndexRatio<R>::of(eta), below = IndexRatio<R>::reciprocal(eta);
        return {real::select(from_below, below.eta, above.eta), real::select(from_below, below.excess, above.excess)};
    }
}

}  // namespace detail

// A boundary between dielectrics. cos_i: of the angle to the normal, which points up; negative for light from below.
// eta: the index of refraction below the boundary over the one above, positive.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline FresnelShares<R> fresnel_shares(R cos_i, std::type_identity_t<R> eta) noexcept {
    const auto ratio = detail::index_ratio(eta, cos_i < 0);
    const R cosine = real::abs(cos_i), eta_cos_t = ratio.eta_cos_t(cosine);
    return {ratio.reflected(cosine, eta_cos_t), ratio.transmitted(cosine, eta_cos_t),
            real::divide(eta_cos_t, ratio.eta)};
}

// The share that is reflected, the Fresnel reflectance, alone.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline R fresnel_dielectric(R cos_i, std::type_identity_t<R> eta) noexcept {
    const auto ratio = detail::index_ratio(eta, cos_i < 0);
    const R cosine = real::abs(cos_i);
    return ratio.reflected(cosine, ratio.eta_cos_t(cosine));
}

// The share that a conductor reflects. eta + i k: its complex index of refraction over that of the medium around it; for a
// colour ask for each channel. cos_i: of the angle to the normal, from 0 to 1. With k = 0 it is a dielectric.
// The same fractions as above with complex numbers: w = eta cos_t = u + i v.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline R fresnel_conductor(R cos_i, std::type_identity_t<R> eta,
                                                      std::type_identity_t<R> k) noexcept {
    const R c = real::abs(cos_i);
    // The squared index is n2 + 1 + i m2.
    const R n2 = (eta - 1) * (eta + 1) - k * k, m2 = 2 * eta * k;
    // w^2 = n2 + cos^2 + i m2, and its root with a positive real part. The larger of the two parts is a sum; the
    // smaller follows from their product, m2 / 2.
    const R square = n2 + c * c;
    const R larger = real::sqrt(R(scalar_of<R>(0.5) * (real::sqrt(R(square * square + m2 * m2)) + real::abs(square))));
    const R smaller = real::quotient_where(larger > 0, R(m2 / 2), larger);
    const R u = real::select(square > 0, larger, smaller), v = real::select(square > 0, smaller, larger);

    const R excess = n2 * n2 + m2 * m2;
    const R s = detail::squared(R(c + u)) + v * v;
    const R p = detail::squared(R((n2 + 1) * c + u)) + detail::squared(R(m2 * c + v));
    const R brewster = detail::squared(R((n2 + 2) * c * c - 1)) + detail::squared(R(m2 * c * c));
    const R in_s = detail::reciprocal_or_zero(s), in_p = detail::reciprocal_or_zero(p);
    return detail::at_most_one(scalar_of<R>(0.5) * excess * (in_s * in_s + brewster * in_p * in_p));
}

}  // namespace lumis::LUMIS_ISA
