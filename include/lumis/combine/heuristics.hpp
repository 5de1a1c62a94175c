// Rules for MIS weights (Veach 1997, section 9.2). A heuristic is given the effective densities n_i p_i of all
// techniques at a point and weighs one of them; a PointHeuristic is given the point instead and asks for no density.
//
// Weights lie in [0, 1] and sum to 1 wherever a density is positive. Scaling all densities changes nothing: where a sum
// overflows or its squares vanish, it is formed again at another scale. 0 against 0 gives 0, Inf against finite 1, several
// Inf share evenly, NaN gives 0 and fails an assertion.
#pragma once

#include "lumis/core/assert.hpp"
#include "lumis/core/detail/for_each_index.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

namespace lumis::LUMIS_ISA {

namespace detail {

// Calls visit(density) for each. The loop is unrolled where the number of techniques is known at compile time.
template <Real R, std::size_t N, class Visit>
LUMIS_INLINE inline void for_each_density(std::span<const R, N> densities, Visit visit) noexcept {
    if constexpr (N == std::dynamic_extent) {
        for (const R density : densities) visit(density);
    } else {
        for_each_index<N>([&](auto k) { visit(densities[k]); });
    }
}

// The densities as an array of their own, for functions that are not inlined: a span of them would force the caller to
// keep its densities in memory instead of registers. Densities of an extent known only at run time stay where they are.
template <std::floating_point T, std::size_t N>
[[nodiscard]] LUMIS_INLINE inline auto by_value(std::span<const T, N> densities) noexcept {
    if constexpr (N == std::dynamic_extent) {
        return densities;
    } else {
        std::array<T, N> copy;
        for_each_index<N>([&](auto k) { copy[k] = densities[k]; });
        return copy;
    }
}

template <Real R, std::size_t N>
[[nodiscard]] LUMIS_HD R largest_of(std::span<const R, N> densities) noexcept {
    R largest = scalar_of<R>(0);
    for_each_density(densities, [&](R density) { largest = real::greater(largest, density); });
    return largest;
}

// Sums above this count as overflowed. Comparisons with the largest number itself are left out by compilers that need not
// reckon with infinity (-ffinite-math-only).
template <std::floating_point T>
inline constexpr T largest_sum = (std::numeric_limits<T>::max)() / 2;

// Beside a share of this, a subnormal one is below the sum's last place, even a million of them: a processor may flush
// them to 0 (FTZ, DAZ), as in programs linked with -ffast-math.
template <std::floating_point T>
inline constexpr T least_share =
    (std::numeric_limits<T>::min)() / std::numeric_limits<T>::epsilon() / std::numeric_limits<T>::epsilon();

// The sum of term(density). Sums of more than 8 terms are compensated by Sum2 of Ogita, Rump and Oishi 2005, "Accurate Sum
// and Dot Product", algorithm 4.1: what each addition rounds off is added up separately. Unlike in Kahan's sum, no addition
// waits for what the one before it rounded off. Stops at the first partial sum that has overflowed, and returns that.
template <Real R, std::size_t N, class Term>
[[nodiscard]] LUMIS_INLINE inline R sum_of(std::span<const R, N> densities, Term term) noexcept {
    R sum = -scalar_of<R>(0);  // adding to -0 changes no number, so compilers drop the addition; adding to 0 changes -0
    if (N != std::dynamic_extent || densities.size() <= 8) {
        for_each_density(densities, [&](R density) { sum += term(density); });
    } else {
        R rounded_off = scalar_of<R>(0);
        for (const R density : densities) {
            // Knuth's TwoSum: total + error == sum + next exactly.
            const R next = term(density), total = real::rounded(R(sum + next)), added = real::rounded(R(total - sum));
            if (!real::all(total <= largest_sum<scalar_of<R>>)) return total;
            const R kept = real::rounded(R(total - added));
            rounded_off += real::rounded(R(sum - kept)) + real::rounded(R(next - added));
            sum = total;
        }
        sum += rounded_off;
    }
    return sum;
}

// The power of two that brings a positive number near 1, or as near as a normal power of two can.
template <std::floating_point T>
[[nodiscard]] LUMIS_HD T scale_to_one(T x) noexcept {
    constexpr int limit = std::numeric_limits<T>::max_exponent - 2;  // 2^limit and 2^-limit are both normal numbers
    const int exponent = std::ilogb(x);
    return std::ldexp(T(1), exponent < -limit ? limit : exponent > limit ? -limit : -exponent);
}

// The share of technique `own` in the sum of all, for densities of any kind: NaN and Inf are decided by the policy at the
// top of this file. share(p, scale) is the share of a density p after scaling; the scale is a power of two that brings the
// largest density near 1, so that neither squares nor sums overflow.
template <std::floating_point T, class Densities, class Share>
[[nodiscard]] LUMIS_COLD T weight_at_scale(std::size_t own, Densities densities, Share share) noexcept {
    int infinite = 0;
    for (const T density : densities) {
        LUMIS_ASSERT(!std::isnan(density));
        if (std::isnan(density)) return 0;
        infinite += std::isinf(density);
    }
    if (infinite > 0) return std::isinf(densities[own]) ? T(1) / static_cast<T>(infinite) : T(0);
    const T largest = real::largest_of(densities);
    if (!(largest > 0)) return 0;
    const T scale = scale_to_one(largest);
    const T sum = sum_of(std::span{std::as_const(densities)}, [&](T density) { return share(density, scale); });
    const T weight = real::divide(share(densities[own], scale), sum);
    return weight > 0 ? weight : T(0);
}

// The weights of lanes by the heuristic for numbers, one lane after the other; those where `settled` holds stay as they are.
template <Real R, std::size_t N, class H>
[[nodiscard]] LUMIS_NOINLINE R weight_lane_by_lane(const H& heuristic, std::size_t own, std::span<const R, N> densities,
                                                   MaskOf<R> settled, R weights) noexcept {
    using T = scalar_of<R>;
    for (std::size_t lane = 0; lane < R::size; ++lane) {
        if (settled[lane]) continue;
        std::array<T, N> alone;
        for_each_index<N>([&](auto k) { alone[k] = densities[k][lane]; });
        weights.set(lane, static_cast<T>(heuristic(own, std::span<const T, N>{alone})));
    }
    return weights;
}
template <Real R, std::size_t N, class H>
[[nodiscard]] LUMIS_HD R weight_lane_by_lane(const H& heuristic, std::size_t own,
                                             std::span<const R, N> densities) noexcept {
    return weight_lane_by_lane(heuristic, own, densities, MaskOf<R>(false), R(scalar_of<R>(0)));
}

// The share of technique `own` in the sum of all. Two comparisons find densities that need scaling or the policy: a share
// so small that others, which were flushed to 0, may be missing in the sum; a sum that has overflowed or holds an Inf or a
// NaN. All others take the short way, and so do lanes in which the technique itself has no share.
template <Real R, std::size_t N, class H, class Share>
[[nodiscard]] LUMIS_INLINE inline R weight_by_shares(const H& heuristic, std::size_t own,
                                                     std::span<const R, N> densities, Share share) noexcept {
    using T = scalar_of<R>;
    const R sum = sum_of(densities, [&](R density) { return share(density, T(1)); });
    const R own_share = share(densities[own], T(1));
    if constexpr (std::floating_point<R>) {
        if (own_share >= least_share<T> && sum <= largest_sum<T>) [[likely]]
            return real::divide(own_share, sum);
        return weight_at_scale<T>(own, by_value(densities), share);
    } else {
        // A share that is 0 as rounded stays 0 where the sum is 1 or more.
        const auto none = densities[own] == 0 || (own_share == 0 && sum >= 1);
        const auto settled = (own_share >= least_share<T> || none) && sum <= largest_sum<T>;
        const R weights = real::divide(own_share, real::divisor_where(settled && sum > 0, sum));
        if (real::all(settled)) [[likely]]
            return weights;
        return weight_lane_by_lane(heuristic, own, densities, settled, weights);
    }
}

// The power heuristic for any exponent, 1 / sum (p_i / p_own)^exponent. Powers of the densities themselves leave the range
// of T soon; powers of their ratios leave it only where the weight does.
template <std::floating_point T, class Densities>
[[nodiscard]] LUMIS_NOINLINE T weight_by_power(std::size_t own, Densities densities, T exponent) noexcept {
    if (densities[own] > 0 && densities[own] <= (std::numeric_limits<T>::max)()) {
        // Scaled, so that 1 / p_own, which -freciprocal-math may form, is a normal number.
        const T scale = scale_to_one(densities[own]), p_own = real::rounded(scale * densities[own]);
        T sum = 1;
        for (std::size_t i = 0; i < densities.size(); ++i) {
            const T ratio = real::divide(real::rounded(scale * densities[i]), p_own);
            if (i != own) sum += ratio > 0 ? std::pow(ratio, exponent) : ratio;  // pow(0, 0) is 1
        }
        if (sum >= 1) return real::divide(T(1), sum);
    }
    return weight_at_scale<T>(own, densities, [](T p, T scale) { return p * scale; });
}

// 1 for a positive finite density. 0 and Inf stay as they are: the policy decides on Inf.
template <Real R>
[[nodiscard]] LUMIS_HD R one_if_positive(R p) noexcept {
    return real::select(p > 0 && p <= (std::numeric_limits<R>::max)(), R(scalar_of<R>(1)), p);
}

}  // namespace detail

// A heuristic of densities: h(own, densities), called with a std::span of N of them or with one of any number.
template <class H, class Scalar, std::size_t N = std::dynamic_extent>
concept DensityHeuristic = requires(const H heuristic, std::span<const Scalar, N> densities) {
    { heuristic(std::size_t{}, densities) } -> std::convertible_to<Scalar>;
}
|| requires(const H heuristic, std::span<const Scalar> densities) {
    { heuristic(std::size_t{}, densities) } -> std::convertible_to<Scalar>;
};

// A heuristic that is told the point alone: owns(i, x), whether technique i has all the weight there.
template <class H, class Point>
concept PointHeuristic = requires(const H heuristic, const Point x) {
    { heuristic.owns(std::size_t{}, x) } -> std::convertible_to<bool>;
};

// What weighs N techniques, the first argument of multi_sample and of one_sample.
template <class H, class Scalar = float, class Point = glm::vec<3, Scalar>, std::size_t N = std::dynamic_extent>
concept Heuristic = DensityHeuristic<H, Scalar, N> || PointHeuristic<H, Point>;

// Weights in proportion to the densities: no other heuristic's variance is much lower (Veach 1997, theorem 9.2).
struct BalanceHeuristic {
    // A technique that can draw the point gets a positive weight, unless it underflows: estimators need not compare it to 0.
    static constexpr bool is_positive = true;

    template <Real R, std::size_t N>
    [[nodiscard]] LUMIS_HD R operator()(std::size_t own, std::span<const R, N> densities) const noexcept {
        return detail::weight_by_shares(*this, own, densities, [](R p, scalar_of<R> scale) { return R(p * scale); });
    }
};

// Weights in proportion to the densities to the power of beta, 1 or more: sharper, better where one technique is nearly
// perfect.
struct PowerHeuristic {
    static constexpr bool is_positive = true;  // see BalanceHeuristic

    double beta = 2;

    template <Real R, std::size_t N>
    [[nodiscard]] LUMIS_HD R operator()(std::size_t own, std::span<const R, N> densities) const noexcept {
        using T = scalar_of<R>;
        LUMIS_ASSERT(beta >= 1);
        if (beta == 2) [[likely]]
            return detail::weight_by_shares(*this, own, densities, [](R p, T scale) {
                const R scaled = real::rounded(R(p * scale));  // p * p may overflow
                return R(scaled * scaled);
            });
        if constexpr (std::floating_point<R>) {
            return detail::weight_by_power<T>(own, detail::by_value(densities), static_cast<T>(beta));
        } else {
            return detail::weight_lane_by_lane(*this, own, densities);
        }
    }
};

// All weight to the largest density; several that are equal share it, so that no order of the techniques matters.
struct MaximumHeuristic {
    template <Real R, std::size_t N>
    [[nodiscard]] LUMIS_HD R operator()(std::size_t own, std::span<const R, N> densities) const noexcept {
        using T = scalar_of<R>;
        const R largest = detail::largest_of(densities);
        return detail::weight_by_shares(*this, own, densities, [=](R p, T /*scale*/) {
            return real::select(p < largest, R(T(0)), detail::one_if_positive(p));
        });
    }
};

// Balance among the techniques whose density is at least alpha times the largest.
struct CutoffHeuristic {
    double alpha = 0.1;

    template <Real R, std::size_t N>
    [[nodiscard]] LUMIS_HD R operator()(std::size_t own, std::span<const R, N> densities) const noexcept {
        using T = scalar_of<R>;
        LUMIS_ASSERT(alpha >= 0 && alpha <= 1);
        // Above 1 no technique would have a weight, not even the only one that drew a point.
        const R threshold = static_cast<T>(real::lesser(alpha, 1.0)) * detail::largest_of(densities);
        return detail::weight_by_shares(*this, own, densities,
                                        [=](R p, T scale) { return real::select(p < threshold, R(T(0)), p * scale); });
    }
};

// Balance of the densities times a factor for each technique, positive and known at run time: BalanceWithFactors{2.0, 1.0}.
// The factors' own scale does not matter, as long as the densities' type holds them. variance_aware_factor gives more to a technique whose samples vary little; where
// that does not make up for what they leave to the others, the variance is above balance's.
template <std::size_t N>
struct BalanceWithFactors {
    static constexpr bool is_positive = true;  // see BalanceHeuristic

    std::array<double, N> factors;

    template <Real R, std::size_t M>
        requires(M == N || M == std::dynamic_extent)
    [[nodiscard]] LUMIS_HD R operator()(std::size_t own, std::span<const R, M> densities) const noexcept {
        using T = scalar_of<R>;
        LUMIS_ASSERT(densities.size() == N);
        std::array<R, N> products;
        for (std::size_t k = 0; k < N; ++k) {
            const T factor = static_cast<T>(factors[k]);
            LUMIS_ASSERT(factor >= (std::numeric_limits<T>::min)() && factor <= (std::numeric_limits<T>::max)());
            products[k] = factor * densities[k];
        }
        const std::span<const R, N> of_products{products};
        const R sum = detail::sum_of(of_products, [](R product) { return product; });
        if constexpr (std::floating_point<R>) {
            if (products[own] >= detail::least_share<T> && sum <= detail::largest_sum<T>) [[likely]]
                return real::divide(products[own], sum);
            return at_scale<T>(own, detail::by_value(densities));
        } else {
            const auto settled =
                (products[own] >= detail::least_share<T> || densities[own] == 0) && sum <= detail::largest_sum<T>;
            const R weights = real::divide(products[own], real::divisor_where(settled && sum > 0, sum));
            if (real::all(settled)) [[likely]]
                return weights;
            return detail::weight_lane_by_lane(*this, own, densities, settled, weights);
        }
    }

  private:
    // The densities are scaled before the factors can make them overflow or vanish.
    template <std::floating_point T, class Densities>
    [[nodiscard]] LUMIS_COLD T at_scale(std::size_t own, Densities densities) const noexcept {
        const T largest = real::largest_of(densities);
        const T scale = largest > 0 && std::isfinite(largest) ? detail::scale_to_one(largest) : T(1);
        std::array<T, N> products;
        for (std::size_t k = 0; k < N; ++k) products[k] = static_cast<T>(factors[k]) * (scale * densities[k]);
        return detail::weight_at_scale<T>(own, products, [](T p, T again) { return p * again; });
    }
};

template <std::convertible_to<double>... T>
BalanceWithFactors(T...) -> BalanceWithFactors<sizeof...(T)>;

// The factor of a technique by Grittmann et al. 2019, "Variance-Aware Multiple Importance Sampling": second moment over
// variance, 1 + mean^2 / variance, of what a sample of it contributes under the balance heuristic, w f / p. Take the moments of
// other samples than those to be weighed (earlier passes, neighbouring pixels), else the estimate is biased. At most 1e6, as
// for a variance of 0; 1 where the variance is not known (NaN).
[[nodiscard]] LUMIS_HD constexpr double variance_aware_factor(double mean, double variance) noexcept {
    constexpr double largest = 1e6;
    const double square = mean * mean;
    if (!(variance >= 0) || !(square > 0)) return 1;
    return square < largest * variance ? real::lesser(1 + square / variance, largest) : largest;
}

// The same weight to every technique that could have drawn the point: the naive average, which MIS replaces.
struct EqualWeights {
    template <Real R, std::size_t N>
    [[nodiscard]] LUMIS_HD R operator()(std::size_t own, std::span<const R, N> densities) const noexcept {
        return detail::weight_by_shares(*this, own, densities,
                                        [](R p, scalar_of<R> /*scale*/) { return detail::one_if_positive(p); });
    }
};

// All weight to the technique that owns the point: owner(x) is its index. Next event estimation's split is of this kind.
template <class Owner>
struct PartitionWeights {
    Owner owner;

    template <class Point>
    [[nodiscard]] LUMIS_HD bool owns(std::size_t own, const Point& x) const {
        return static_cast<std::size_t>(owner(x)) == own;
    }
};

template <class Owner>
PartitionWeights(Owner) -> PartitionWeights<Owner>;

namespace detail {

// Calls a heuristic with the number of densities known at compile time, if it accepts such a span. Lanes are weighed one
// after the other by a heuristic that is written for numbers.
template <class H, Real R, std::size_t N>
[[nodiscard]] LUMIS_INLINE inline R weigh(const H& heuristic, std::size_t own,
                                          std::span<const R, N> densities) noexcept {
    if constexpr (std::invocable<const H&, std::size_t, std::span<const R, N>>) {
        return static_cast<R>(heuristic(own, densities));
    } else if constexpr (std::floating_point<R> || std::invocable<const H&, std::size_t, std::span<const R>>) {
        return static_cast<R>(heuristic(own, std::span<const R>{densities}));
    } else {
        const auto of_numbers = [&](std::size_t i, auto alone) { return weigh(heuristic, i, alone); };
        return weight_lane_by_lane(of_numbers, own, densities);
    }
}

}  // namespace detail

// The weight of technique `own` from all effective densities, for hundreds of techniques known at run time.
template <class H, FloatOrDouble T>
    requires DensityHeuristic<H, T>
[[nodiscard]] LUMIS_HD T mis_weight(const H& heuristic, std::size_t own, std::span<const T> densities) noexcept {
    return static_cast<T>(heuristic(own, densities));
}

// The weight of the technique that drew a point with effective density `own` = n p, against the others that could have:
// what a path tracer needs at a hit. Numbers, or lanes of them.
template <class H, Real R>
    requires DensityHeuristic<H, scalar_of<R>>
[[nodiscard]] LUMIS_HD R mis_weight(const H& heuristic, R own, std::convertible_to<R> auto... others) noexcept {
    const std::array densities{own, static_cast<R>(others)...};
    return detail::weigh(heuristic, 0, std::span{densities});
}

}  // namespace lumis::LUMIS_ISA
