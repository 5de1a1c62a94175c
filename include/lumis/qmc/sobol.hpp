// Low-discrepancy uniforms: Sobol's sequence, Owen-scrambled by hashes, in sets of four dimensions that are shuffled against each
// other (Burley 2020, "Practical hash-based Owen scrambling", shuffled scrambled Sobol). Any number of dimensions; no tables
// to fill, no state but the place. Included by name.
#pragma once

// Macros of a host's that are names here are set aside up to the last line.
#pragma push_macro("D")
#pragma push_macro("Real")
#pragma push_macro("real")
#undef D
#undef Real
#undef real

#include "lumis/core/lanes.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/qmc/detail/sobol_points.hpp"

#include <cstddef>
#include <cstdint>

namespace lumis::LUMIS_ISA {

// The points 0, 1, 2, ... of one randomisation, one after another or in any order: start(index) goes to a point, and next<N>()
// yields its coordinates, N at a time. Sobol<Lanes<T, L>> yields L points at once, index to index + L - 1, one in each lane.
//
// Each point is uniform over the lattice of T (2^24 values in float, 2^53 in double; never 1), so that the mean over any points of
// one randomisation is unbiased. Its points depend on each other. The error of the mean is therefore seen from several
// randomisations, not from the spread of the estimates; and what needs independent samples to learn from without bias, as
// cross-fitted weights do, takes what it has learnt from another randomisation. Take counts that are powers of two: each aligned run
// of 2^k points is stratified.
//
// The coordinates of one next<N>() belong to one set of four, and so do those of the next ones while they fit into it: they are
// stratified jointly. Sets are independent: what an integrand owes to coordinates of two sets together converges as with random
// numbers. Coordinates are asked for in the same order at each point, as estimators do.
template <Real R = float>
class Sobol {
    using T = scalar_of<R>;

  public:
    // randomisation: any number; another one for each pixel, or for each repetition. index: modulo 2^32.
    LUMIS_INLINE constexpr explicit Sobol(std::uint64_t randomisation = 0, std::uint32_t index = 0) noexcept {
        start(randomisation, index);
    }

    // The first coordinate of a point comes next.
    LUMIS_INLINE constexpr void start(std::uint32_t index) noexcept {
        index_ = index;
        set_ = 0;
        used_ = detail::sobol_dimensions;
    }
    LUMIS_INLINE constexpr void start(std::uint64_t randomisation, std::uint32_t index) noexcept {
        key_ = detail::derived(detail::mixed(randomisation), 0);
        start(index);
    }

    template <int N>
        requires(N >= 1 && N <= 4)
    [[nodiscard]] LUMIS_INLINE constexpr glm::vec<N, R> next() noexcept {
        if (used_ + N > detail::sobol_dimensions) draw_set();
        return detail::fill<N, R>([this] { return coordinates_[used_++]; });
    }

  private:
    static constexpr std::uint32_t lanes = [] {
        if constexpr (std::floating_point<R>) {
            return 1;
        } else {
            return static_cast<std::uint32_t>(R::size);
        }
    }();

    // Shuffling a sequence is scrambling its indices: aligned runs of 2^k points stay together, in another order. Loops over
    // lanes are innermost, for compilers to make vectors of them.
    LUMIS_INLINE constexpr void draw_set() noexcept {
        const std::uint64_t key = detail::derived(key_, set_++), key_of_order = detail::derived(key, 0);
        std::uint32_t digits[detail::sobol_dimensions][lanes] = {}, order[lanes] = {};
        for (std::uint32_t lane = 0; lane < lanes; ++lane) {
            order[lane] = detail::flipped_by_lower_bits(detail::reversed_bits(index_ + lane), key_of_order);
        }
        detail::reversed_sobol_points(order, lanes <= 16 && index_ % lanes == 0, digits);
        for (std::size_t d = 0; d < detail::sobol_dimensions; ++d) {
            const std::uint64_t key_of_dimension = detail::derived(key, d + 1);
            T u[lanes] = {};
            for (std::uint32_t lane = 0; lane < lanes; ++lane) {
                const std::uint32_t scrambled =
                    detail::reversed_bits(detail::flipped_by_lower_bits(digits[d][lane], key_of_dimension));
                u[lane] = uniform(scrambled, key_of_dimension);
            }
            coordinates_[d] = in_lanes(u);
        }
        used_ = 0;
    }

    LUMIS_INLINE static constexpr R in_lanes(const T* u) noexcept {
        if constexpr (std::floating_point<R>) {
            return *u;
        } else {
            return R::load(u);
        }
    }

    // The digits of T: those of the point, and behind its 32 random ones. Points differ in the first 32, whose later digits are
    // scrambled independently.
    LUMIS_INLINE static constexpr T uniform(std::uint32_t x, std::uint64_t key) noexcept {
        constexpr int digits = uniform_bits<T>;
        constexpr T spacing = T(1) / static_cast<T>(std::uint64_t{1} << digits);
        if constexpr (digits <= 32) {
            return static_cast<T>(static_cast<std::int32_t>(x >> (32 - digits))) * spacing;
        } else {
            const std::uint64_t more = detail::derived(key ^ std::uint64_t{x} << 32, x) >> (64 - (digits - 32));
            return static_cast<T>(static_cast<std::int64_t>(std::uint64_t{x} << (digits - 32) | more)) * spacing;
        }
    }

    std::uint64_t key_ = 0;
    std::uint32_t index_ = 0, set_ = 0;
    std::uint32_t used_ = detail::sobol_dimensions;
    R coordinates_[detail::sobol_dimensions] = {};
};

}  // namespace lumis::LUMIS_ISA

#pragma pop_macro("D")
#pragma pop_macro("Real")
#pragma pop_macro("real")
