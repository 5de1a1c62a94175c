// Rules for MIS weights (Veach 1997, section 9.2). A heuristic is given the effective densities n_i p_i of all
// techniques at a point and weighs one of them; a PointHeuristic is given the point instead and asks for no density.
//
// Weights lie in [0, 1] and sum to 1 wherever a density is positive. Only ratios of densities are formed, so that nothing
// overflows and scaling all densities changes nothing. 0 against 0 gives 0, Inf against finite 1, several Inf share
// evenly, NaN gives 0 and fails an assertion.
#pragma once

#include "lumis/core/assert.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>

namespace lumis {

namespace detail {

// Where a density is 0, NaN or infinite, ratios say nothing, and the policy above decides.
template <std::floating_point T>
[[nodiscard]] T weight_without_ratios(std::size_t own, std::span<const T> densities) noexcept {
    int infinite = 0;
    for (const T density : densities) {
        LUMIS_ASSERT(!std::isnan(density));
        if (std::isnan(density)) return 0;
        infinite += std::isinf(density);
    }
    return std::isinf(densities[own]) ? T(1) / static_cast<T>(infinite) : T(0);
}

// 1 / (1 + sum of term(p_k, p_own) over the other techniques), with term a function of the ratio p_k / p_own.
template <std::floating_point T, class Term>
[[nodiscard]] T weight_by_ratios(std::size_t own, std::span<const T> densities, Term term) noexcept {
    T sum = 1;
    for (std::size_t k = 0; k < densities.size(); ++k) {
        if (k != own) sum += term(densities[k], densities[own]);
    }
    if (densities[own] > 0 && sum >= 1) [[likely]]
        return 1 / sum;
    return weight_without_ratios(own, densities);
}

}  // namespace detail

// Weights in proportion to the densities: no other heuristic's variance is much lower (Veach 1997, theorem 9.2).
struct BalanceHeuristic {
    template <std::floating_point T>
    [[nodiscard]] T operator()(std::size_t own, std::span<const T> densities) const noexcept {
        return detail::weight_by_ratios(own, densities, [](T p, T p_own) { return p / p_own; });
    }
};

// Weights in proportion to the densities to the power of beta, 1 or more: sharper, better where one technique is nearly
// perfect.
struct PowerHeuristic {
    double beta = 2;

    template <std::floating_point T>
    [[nodiscard]] T operator()(std::size_t own, std::span<const T> densities) const noexcept {
        const auto power = [this](T p, T p_own) {
            const T ratio = p / p_own;
            if (beta == 2) return ratio * ratio;
            return ratio > 0 ? std::pow(ratio, static_cast<T>(beta)) : ratio;  // pow(0, 0) is 1
        };
        return detail::weight_by_ratios(own, densities, power);
    }
};

// All weight to the largest density; several that are equal share it, so that no order of the techniques matters.
struct MaximumHeuristic {
    template <std::floating_point T>
    [[nodiscard]] T operator()(std::size_t own, std::span<const T> densities) const noexcept {
        bool largest = densities[own] > 0;
        int equal = 0;
        for (const T density : densities) {
            LUMIS_ASSERT(!std::isnan(density));
            if (std::isnan(density)) return 0;
            largest = largest && density <= densities[own];
            equal += density == densities[own];
        }
        return largest ? T(1) / static_cast<T>(equal) : T(0);
    }
};

// Balance among the techniques whose density is at least alpha times the largest.
struct CutoffHeuristic {
    double alpha = 0.1;

    template <std::floating_point T>
    [[nodiscard]] T operator()(std::size_t own, std::span<const T> densities) const noexcept {
        const T largest = *std::ranges::max_element(densities);
        const T threshold = static_cast<T>(alpha) * largest;
        if (densities[own] < threshold) return detail::weight_without_ratios(own, densities);
        return detail::weight_by_ratios(own, densities, [&](T p, T p_own) { return p < threshold ? T(0) : p / p_own; });
    }
};

// The same weight to every technique that could have drawn the point: the naive average, which MIS replaces.
struct EqualWeights {
    template <std::floating_point T>
    [[nodiscard]] T operator()(std::size_t own, std::span<const T> densities) const noexcept {
        const bool all_finite = std::ranges::all_of(densities, [](T p) { return std::isfinite(p); });
        if (!all_finite) return detail::weight_without_ratios(own, densities);
        const auto positive = std::ranges::count_if(densities, [](T p) { return p > 0; });
        return densities[own] > 0 ? T(1) / static_cast<T>(positive) : T(0);
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
    const T densities[] = {own, static_cast<T>(others)...};
    return heuristic(std::size_t{0}, std::span<const T>{densities});
}

}  // namespace lumis
