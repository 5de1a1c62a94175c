// The densities of all techniques at a sample over S, the sum of factor times density: the balance heuristic's weights over
// their factors. Unlike these weights they have no bound where a factor is 0.
#pragma once

#include "lumis/combine/heuristics.hpp"
#include "lumis/core/assert.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lumis::LUMIS_ISA::detail {

template <std::size_t K>
struct Shares {
    std::array<double, K> q;  // p_k / S
    double inverse;           // 1 / S
};

// Densities may be of any kind: where one is NaN all is 0, and several drawn techniques of infinite density share evenly, as by
// the policy of heuristics. The scale is a power of two, so that S neither overflows nor vanishes.
template <std::size_t K>
[[nodiscard]] LUMIS_COLD Shares<K> shares_at_scale(const std::array<double, K>& densities,
                                                   const std::array<double, K>& factors) noexcept {
    Shares<K> result{};
    double largest = 0;
    int infinite = 0;
    for (std::size_t k = 0; k < K; ++k) {
        LUMIS_ASSERT(!std::isnan(densities[k]));
        if (std::isnan(densities[k])) return {};
        if (factors[k] > 0) {
            infinite += std::isinf(densities[k]);
            largest = real::greater(largest, densities[k]);
        }
    }
    if (infinite > 0) {
        for (std::size_t k = 0; k < K; ++k) {
            if (factors[k] > 0 && std::isinf(densities[k])) result.q[k] = 1 / (infinite * factors[k]);
        }
        return result;
    }
    if (!(largest > 0)) return result;
    const double scale = scale_to_one(largest);
    double sum = 0;
    for (std::size_t k = 0; k < K; ++k) {
        if (factors[k] > 0) sum += factors[k] * (scale * densities[k]);
    }
    for (std::size_t k = 0; k < K; ++k) result.q[k] = scale * densities[k] / sum;
    result.inverse = real::lesser(scale / sum, (std::numeric_limits<double>::max)());
    return result;
}

// At a sample that was drawn: one density is positive, and so is its factor.
template <std::size_t K>
[[nodiscard]] LUMIS_INLINE inline Shares<K> shares(const std::array<double, K>& densities,
                                                   const std::array<double, K>& factors) noexcept {
    double sum = -0.0;
    for (std::size_t k = 0; k < K; ++k) sum += factors[k] * densities[k];
    if (!(sum >= least_share<double> && sum <= largest_sum<double>)) [[unlikely]]
        return shares_at_scale(densities, factors);
    Shares<K> result;
    result.inverse = real::divide(1.0, sum);
    for (std::size_t k = 0; k < K; ++k) result.q[k] = densities[k] * result.inverse;
    return result;
}

}  // namespace lumis::LUMIS_ISA::detail
