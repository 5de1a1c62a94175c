// What samples cost and what an allocation may do with them: the host's part of the question how many to take.
#pragma once

#include "lumis/core/platform.hpp"

#include <array>
#include <cstddef>

namespace lumis::LUMIS_ISA {

namespace detail {

template <std::size_t N>
[[nodiscard]] LUMIS_HD constexpr std::array<double, N> ones() noexcept {
    std::array<double, N> result{};
    for (double& x : result) x = 1;
    return result;
}

}  // namespace detail

// What an estimate by N techniques costs, in any unit of time.
template <std::size_t N>
struct SamplingCosts {
    // One sample of each technique: drawing it, and evaluating the integrand there. Positive.
    std::array<double, N> of_sample = detail::ones<N>();

    // The density of each technique at a sample that another one has drawn. It is paid at every sample that has a density,
    // where the technique takes part.
    std::array<double, N> of_density{};

    // What an estimate costs besides, whatever it draws: a camera ray, a lookup of textures.
    double of_estimate = 0;
};

// What an allocation may do.
template <std::size_t N>
struct AllocationLimits {
    // Techniques that are known to draw all points where the integrand is not 0. Where one of them takes part, others may be
    // left out, by 256 pilot rounds or more. Else every technique takes part: what no pilot sample has met must still be drawn.
    // Delta strategies always take part.
    std::array<bool, N> covers{};

    int most_samples = 16;  // of all techniques together, in a multi-sample estimate
};

}  // namespace lumis::LUMIS_ISA
