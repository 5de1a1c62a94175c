// The ways to divide samples among techniques that an allocation compares: vectors of counts without a common factor. Their
// multiples divide samples alike, so that their variances follow.
#pragma once

#include "lumis/core/platform.hpp"

#include <array>
#include <cstddef>
#include <numeric>

namespace lumis::LUMIS_ISA::detail {

// The largest number of techniques with a density whose splits are compared.
inline constexpr std::size_t most_to_split = 5;

// The counts that several techniques are combined from; 0 first. Up to 211 combinations.
template <std::size_t N>
[[nodiscard]] LUMIS_HD constexpr auto split_levels() noexcept {
    if constexpr (N == 3) {
        return std::array{0, 1, 2, 4, 8, 16};
    } else if constexpr (N == 4) {
        return std::array{0, 1, 4, 16};
    } else {
        return std::array{0, 1, 8};
    }
}

// Calls visit(counts) for each split among N techniques, the even one first.
//
// Two techniques: all splits of up to 8 samples, k : k + 1 up to 9 : 10, and ratios up to 64. Neighbours are so near that
// the best of them has at most 3 % more variance times cost than the best of all ratios, where each technique has a variance
// of its own: Neyman's (1934) allocation. Near 1 : 1, where a mixture may fit almost perfectly, they are much nearer.
template <std::size_t N, class Visit>
LUMIS_HD constexpr void for_each_split(Visit visit) {
    std::array<int, N> counts{};
    if constexpr (N <= 1) {
        for (int& count : counts) count = 1;
        visit(counts);
    } else if constexpr (N == 2) {
        const auto both = [&](int less, int more) {
            visit(std::array{less, more});
            visit(std::array{more, less});
        };
        visit(std::array{1, 1});
        for (int more = 2; more <= 10; ++more) {
            for (int less = 1; less < more; ++less) {
                if (std::gcd(less, more) == 1 && (less + more <= 8 || less + 1 == more)) both(less, more);
            }
        }
        for (const int more : {8, 12, 16, 32, 64}) both(1, more);
        both(0, 1);
    } else if constexpr (N > 2) {
        constexpr auto levels = split_levels<N>();
        std::size_t combinations = 1;
        for (std::size_t i = 0; i < N; ++i) combinations *= levels.size();
        for (int& count : counts) count = 1;
        visit(counts);
        for (std::size_t number = 1; number < combinations; ++number) {
            std::size_t rest = number;
            bool has_one = false, is_even = true;
            for (int& count : counts) {
                count = levels[rest % levels.size()];
                rest /= levels.size();
                has_one = has_one || count == 1;
                is_even = is_even && count == 1;
            }
            if (has_one && !is_even) visit(counts);
        }
    }
}

template <std::size_t N>
[[nodiscard]] LUMIS_HD constexpr std::size_t number_of_splits() noexcept {
    std::size_t number = 0;
    for_each_split<N>([&](const auto&) { ++number; });
    return number;
}

// counts[t][k]: the samples of technique t in split k.
template <std::size_t N>
struct Splits {
    static constexpr std::size_t size = number_of_splits<N>();
    std::array<std::array<double, size>, N> counts{};
};

template <std::size_t N>
[[nodiscard]] LUMIS_HD constexpr Splits<N> make_splits() noexcept {
    Splits<N> splits;
    std::size_t k = 0;
    for_each_split<N>([&](const auto& counts) {
        for (std::size_t t = 0; t < N; ++t) splits.counts[t][k] = counts[t];
        ++k;
    });
    return splits;
}

// Sums of a number and of its square, or their expectations.
struct FirstAndSecond {
    double first{}, second{};
};

// How a split does, as estimated from pilot rounds: what one round of its counts yields.
struct SplitOutcome {
    double variance,
        second;   // sums over techniques: of the variance, and of the second moment, of a contribution over the count
    double mean;  // the integral
};

}  // namespace lumis::LUMIS_ISA::detail
