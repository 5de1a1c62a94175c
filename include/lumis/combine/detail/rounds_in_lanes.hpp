// A round in each lane of what a source of uniforms yields; of numbers, a single one.
#pragma once

#include "lumis/combine/combination.hpp"
#include "lumis/combine/detail/shares.hpp"
#include "lumis/combine/round.hpp"
#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA::detail {

template <Real R>
inline constexpr std::size_t lanes_of = 1;
template <Real R>
    requires(!std::floating_point<R>)
inline constexpr std::size_t lanes_of<R> = R::size;

// The number in one lane of x, which may be a number.
template <class X>
[[nodiscard]] LUMIS_INLINE inline auto number_in([[maybe_unused]] std::size_t lane, const X& x) noexcept {
    if constexpr (std::is_arithmetic_v<X>) {
        return x;
    } else {
        return x[lane];
    }
}

// One lane of an integrand's value in doubles, if its samples are in lanes.
template <Real R, class Value>
[[nodiscard]] LUMIS_INLINE inline auto wide_value_in([[maybe_unused]] std::size_t lane, const Value& value) noexcept {
    if constexpr (std::floating_point<R>) {
        static_assert(SumsInDouble<Value>, "optimal weights are for integrands that return a number or a glm::vec");
        return static_cast<InDouble<Value>>(value);
    } else {
        const auto number = lane_of(value, lane);
        return static_cast<InDouble<std::remove_const_t<decltype(number)>>>(number);
    }
}

// Value: what the integrand returns, in lanes of it if R is.
template <class Value, std::size_t K, Real R>
class RoundsInLanes {
    static constexpr std::size_t lanes = lanes_of<R>;
    using Wide = decltype(wide_value_in<R>(0, std::declval<const Value&>()));

  public:
    // factors: n_k or c_k.
    template <class Scalar>
    LUMIS_INLINE explicit RoundsInLanes(const std::array<Scalar, K>& factors) noexcept {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            for (std::size_t k = 0; k < K; ++k) {
                rounds_[lane].equations.factors[k] = static_cast<double>(number_in(lane, factors[k]));
            }
        }
    }

    // A sample of technique i in the lanes that have selected it.
    template <class Seen>
    LUMIS_INLINE void add(std::size_t i, const Observation<Seen, R, K>& seen, const MaskOf<R>& selected) noexcept {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            if (!number_in(lane, selected)) continue;
            const std::array<double, K>& factors = rounds_[lane].equations.factors;
            if (number_in(lane, seen.drawn)) {
                std::array<double, K> densities;
                for (std::size_t k = 0; k < K; ++k) {
                    densities[k] = static_cast<double>(number_in(lane, seen.densities[k]));
                }
                const Shares<K> over_s = shares(densities, factors);
                rounds_[lane].add_sample(wide_value_in<R>(lane, seen.value) * over_s.inverse, over_s.q);
            } else {
                rounds_[lane].add_alone(i, factors[i], Wide{});
            }
        }
    }

    // The same of a delta strategy, given what its sample contributes: no other can draw the same.
    LUMIS_INLINE void add_delta(std::size_t i, const Value& contribution, const MaskOf<R>& selected) noexcept {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            if (!number_in(lane, selected)) continue;
            rounds_[lane].add_alone(i, rounds_[lane].equations.factors[i], wide_value_in<R>(lane, contribution));
        }
    }

    // A Round, or a std::array of one for each lane.
    [[nodiscard]] LUMIS_INLINE const auto& result() const noexcept {
        if constexpr (std::floating_point<R>) {
            return rounds_[0];
        } else {
            return rounds_;
        }
    }

  private:
    std::array<Round<Wide, K>, lanes> rounds_{};
};

}  // namespace lumis::LUMIS_ISA::detail
