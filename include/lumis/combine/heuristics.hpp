// Rules for MIS weights (Veach 1997, section 9.2). A heuristic is given the effective densities n_i p_i of all
// techniques at a point and weighs one of them; a PointHeuristic is given the point instead and asks for no density.
//
// Weights lie in [0, 1] and sum to 1 wherever a density is positive. Scaling all densities changes nothing: where a sum
// overflows or its squares vanish, it is formed again at another scale. 0 against 0 gives 0, Inf against finite 1, several
// Inf share evenly, NaN gives 0 and fails an assertion.
#pragma once

#include "lumis/combine/for_each_index.hpp"
#include "lumis/core/assert.hpp"
#include "lumis/core/real.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

namespace lumis {

namespace detail {

// Unrolled where the number of techniques is known when compiled.
template <Real R, std::size_t N, class Visit>
[[gnu::always_inline]] inline void for_each_density(std::span<const R, N> densities, Visit visit) noexcept {
    if constexpr (N == std::dynamic_extent) {
        for (const R density : densities) visit(density);
    } else {
        for_each_index<N>([&](auto k) { visit(densities[k]); });
    }
}

// A copy for functions that are not inlined, or else the densities would have to be in memory at all times.
template <std::floating_point T, std::size_t N>
[[nodiscard, gnu::always_inline]] inline auto by_value(std::span<const T, N> densities) noexcept {
    if constexpr (N == std::dynamic_extent) {
        return densities;
    } else {
        std::array<T, N> copy;
        for_each_index<N>([&](auto k) { copy[k] = densities[k]; });
        return copy;
    }
}

template <Real R, std::size_t N>
[[nodiscard]] R largest_of(std::span<const R, N> densities) noexcept {
    R largest = scalar_of<R>(0);
    for_each_density(densities, [&](R density) { largest = real::max(largest, density); });
    return largest;
}

// The sum of term(density). Of very many, what each addition rounds off is added up by itself (Ogita, Rump and Oishi 2005,
// "Accurate Sum and Dot Product"): no addition waits for it, as in Kahan's sum.
template <Real R, std::size_t N, class Term>
[[nodiscard, gnu::always_inline]] inline R sum_of(std::span<const R, N> densities, Term term) noexcept {
    R sum = -scalar_of<R>(0);  // to which a compiler may add by doing nothing, unlike to 0
    if (N != std::dynamic_extent || densities.size() <= 8) {
        for_each_density(densities, [&](R density) { sum += term(density); });
    } else {
        R rounded_off = scalar_of<R>(0);
        for (const R density : densities) {
            const R next = term(density), total = sum + next, added = total - sum;
            rounded_off += (sum - (total - added)) + (next - added);
            sum = total;
        }
        sum += rounded_off;
    }
    return sum;
}

// The share of technique `own` in the sum of all: share(p, scale) is that of a density p, scaled by a power of two. The
// densities may be any: the policy above decides on NaN and Inf, and the scale brings the largest of the others near 1.
template <std::floating_point T, class Densities, class Share>
[[nodiscard, gnu::noinline, gnu::cold]] T weight_at_scale(std::size_t own, Densities densities, Share share) noexcept {
    int infinite = 0;
    for (const T density : densities) {
        LUMIS_ASSERT(!std::isnan(density));
        if (std::isnan(density)) return 0;
        infinite += std::isinf(density);
    }
    if (infinite > 0) return std::isinf(densities[own]) ? T(1) / static_cast<T>(infinite) : T(0);
    const T largest = real::largest_of(densities);
    if (!(largest > 0)) return 0;
    constexpr int limit = std::numeric_limits<T>::max_exponent - 2;  // of a power of two and of its reciprocal
    const int exponent = std::ilogb(largest);
    const T scale = std::ldexp(T(1), exponent < -limit ? limit : exponent > limit ? -limit : -exponent);
    const T sum = sum_of(std::span{std::as_const(densities)}, [&](T density) { return share(density, scale); });
    const T weight = share(densities[own], scale) / sum;
    return weight > 0 ? weight : T(0);
}

// What a heuristic says of each lane by itself.
template <Real R, std::size_t N, class Heuristic>
[[nodiscard, gnu::noinline]] R weight_lane_by_lane(const Heuristic& heuristic, std::size_t own,
                                                   std::span<const R, N> densities) noexcept {
    using T = scalar_of<R>;
    R weights;
    for (std::size_t lane = 0; lane < R::size; ++lane) {
        std::array<T, N> alone;
        for_each_index<N>([&](auto k) { alone[k] = densities[k][lane]; });
        weights.set(lane, heuristic(own, std::span<const T, N>{alone}));
    }
    return weights;
}

// The same for densities as they are nearly always. A share that is too small to have all its digits, a sum that is not
// finite, a NaN anywhere: each fails one of two comparisons.
template <Real R, std::size_t N, class Heuristic, class Share>
[[nodiscard, gnu::always_inline]] inline R weight_by_shares(const Heuristic& heuristic, std::size_t own,
                                                            std::span<const R, N> densities, Share share) noexcept {
    using T = scalar_of<R>;
    const R sum = sum_of(densities, [&](R density) { return share(density, T(1)); });
    const R own_share = share(densities[own], T(1)), weight = own_share / sum;
    if (real::all(own_share >= std::numeric_limits<T>::min() && weight > 0)) [[likely]]
        return weight;
    if constexpr (std::floating_point<R>) {
        return weight_at_scale<T>(own, by_value(densities), share);
    } else {
        return weight_lane_by_lane(heuristic, own, densities);
    }
}

// The power heuristic for any exponent. Powers soon leave the range: those of ratios do so where the weight does.
template <std::floating_point T, class Densities>
[[nodiscard, gnu::noinline]] T weight_by_power(std::size_t own, Densities densities, T exponent) noexcept {
    T sum = 0;
    for (const T density : densities) {
        const T ratio = density / densities[own];
        sum += ratio > 0 ? std::pow(ratio, exponent) : ratio;  // pow(0, 0) is 1
    }
    if (densities[own] > 0 && sum >= 1) return 1 / sum;
    return weight_at_scale<T>(own, densities, [](T p, T scale) { return p * scale; });
}

// 1 for a positive density; Inf stays, for the policy to decide.
template <Real R>
[[nodiscard]] R one_if_positive(R p) noexcept {
    return real::select(p > 0 && p <= std::numeric_limits<R>::max(), R(scalar_of<R>(1)), p);
}

}  // namespace detail

// Weights in proportion to the densities: no other heuristic's variance is much lower (Veach 1997, theorem 9.2).
struct BalanceHeuristic {
    // Gives no weight of 0 to what was drawn, unless it underflows: estimators need not ask.
    static constexpr bool is_positive = true;

    template <Real R, std::size_t N>
    [[nodiscard]] R operator()(std::size_t own, std::span<const R, N> densities) const noexcept {
        return detail::weight_by_shares(*this, own, densities, [](R p, scalar_of<R> scale) { return R(p * scale); });
    }
};

// Weights in proportion to the densities to the power of beta, 1 or more: sharper, better where one technique is nearly
// perfect.
struct PowerHeuristic {
    static constexpr bool is_positive = true;  // as of BalanceHeuristic

    double beta = 2;

    template <Real R, std::size_t N>
    [[nodiscard]] R operator()(std::size_t own, std::span<const R, N> densities) const noexcept {
        using T = scalar_of<R>;
        if (beta == 2) [[likely]]
            return detail::weight_by_shares(*this, own, densities,
                                            [](R p, T scale) { return R(p * scale * (p * scale)); });
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
    [[nodiscard]] R operator()(std::size_t own, std::span<const R, N> densities) const noexcept {
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
    [[nodiscard]] R operator()(std::size_t own, std::span<const R, N> densities) const noexcept {
        using T = scalar_of<R>;
        const R threshold = static_cast<T>(alpha) * detail::largest_of(densities);
        return detail::weight_by_shares(*this, own, densities,
                                        [=](R p, T scale) { return real::select(p < threshold, R(T(0)), p * scale); });
    }
};

// The same weight to every technique that could have drawn the point: the naive average, which MIS replaces.
struct EqualWeights {
    template <Real R, std::size_t N>
    [[nodiscard]] R operator()(std::size_t own, std::span<const R, N> densities) const noexcept {
        return detail::weight_by_shares(*this, own, densities,
                                        [](R p, scalar_of<R> /*scale*/) { return detail::one_if_positive(p); });
    }
};

// All weight to the technique that owns the point: owner(x) is its index. Next event estimation's split is of this kind.
template <class Owner>
struct PartitionWeights {
    Owner owner;

    template <class Point>
    [[nodiscard]] bool owns(std::size_t own, const Point& x) const {
        return static_cast<std::size_t>(owner(x)) == own;
    }
};

template <class Owner>
PartitionWeights(Owner) -> PartitionWeights<Owner>;

namespace detail {

// A heuristic is told how many densities there are when compiled, if it can be.
template <class H, Real R, std::size_t N>
[[nodiscard, gnu::always_inline]] inline R weigh(const H& heuristic, std::size_t own,
                                                 std::span<const R, N> densities) noexcept {
    if constexpr (std::invocable<const H&, std::size_t, std::span<const R, N>>) {
        return heuristic(own, densities);
    } else {
        return heuristic(own, std::span<const R>{densities});
    }
}

}  // namespace detail

template <class H, class Point>
concept PointHeuristic = requires(const H heuristic, const Point x) {
    { heuristic.owns(std::size_t{}, x) } -> std::convertible_to<bool>;
};

// The weight of one technique from all effective densities, for hundreds of techniques known at run time.
template <class H, std::floating_point T>
[[nodiscard]] T mis_weight(const H& heuristic, std::span<const T> densities, std::size_t own) noexcept {
    return heuristic(own, densities);
}

// The weight of the technique that drew a point with effective density `own` = n p, against the others that could have:
// what a path tracer needs at a hit.
template <class H, std::floating_point T>
[[nodiscard]] T mis_weight(const H& heuristic, T own, std::convertible_to<T> auto... others) noexcept {
    const std::array densities{own, static_cast<T>(others)...};
    return detail::weigh(heuristic, 0, std::span{densities});
}

}  // namespace lumis
