// Optimal weights (Kondapaneni et al. 2019, "Optimal Multiple Importance Sampling"): the balance heuristic's estimate with the
// techniques' densities as control variates,
//
//   sum_k alpha_k + sum over all samples of (f - sum_k alpha_k p_k) / S,   S = sum_k n_k p_k (one-sample: c_k p_k),
//
// with the alpha that leaves the least variance. Its weights need not be positive, as those of heuristics are. alpha comes from
// the samples themselves, and still there is no bias, see CrossFitted.
#pragma once

#include "lumis/combine/cross_fitted.hpp"
#include "lumis/combine/detail/rounds_in_lanes.hpp"
#include "lumis/combine/multi_sample.hpp"
#include "lumis/combine/one_sample.hpp"
#include "lumis/combine/round.hpp"
#include "lumis/core/platform.hpp"

#include <concepts>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

// Draws rounds: n_k samples of every technique. take(0, s) draws none, but its density is a control variate. It has to
// integrate to 1 over all that the techniques with samples can draw, or else the estimate is biased. That of visible normals
// does not, for they reflect some samples below the horizon. CrossFitted::control_mean tells.
template <class... S>
class MultiSampleRounds : public MultiSample<BalanceHeuristic, S...> {
    using Base = MultiSample<BalanceHeuristic, S...>;

  public:
    using Base::Base;
    using typename Base::Scalar;

    // A round, see Round; where the source yields lanes, a std::array of one for each. f is called as by MultiSample::estimate,
    // and returns a number or a glm::vec.
    template <class F, class U>
        requires UniformSource<U, RealFrom<U, Scalar>>
    [[nodiscard]] LUMIS_INLINE auto round(F&& f, U&& uniforms) const {
        using R = RealFrom<U, Scalar>;
        using First = typename Base::template Nth<0>;
        using Value = decltype(this->template draw<0, R>(f, detail::next_for<First, R>(uniforms)));
        detail::RoundsInLanes<Value, Base::size, R> rounds{this->factors()};
        detail::for_each_index<Base::size>([&](auto i) {
            using Part = typename Base::template Nth<i>;
            for (int k = 0; k < this->count(i); ++k) {
                const auto u = detail::next_for<Part, R>(uniforms);
                if constexpr (Base::template is_delta<i>) {
                    rounds.add_delta(i, Base::template as_value<Value>(this->template draw<i, R>(f, u)), true);
                } else {
                    rounds.add(i, this->template observe<i, R>(f, u), true);
                }
            }
        });
        return rounds.result();
    }
};

// Draws rounds of a single sample, of a technique that is selected at random. choose(0, s): as take(0, s).
template <class... S>
class OneSampleRounds : public OneSample<BalanceHeuristic, S...> {
    using Base = OneSample<BalanceHeuristic, S...>;

  public:
    using Base::Base;
    using typename Base::Scalar;

    // The same as MultiSampleRounds::round. Spends what OneSample::estimate does.
    template <class F, class U>
        requires UniformSource<U, RealFrom<U, Scalar>>
    [[nodiscard]] LUMIS_INLINE auto round(F&& f, U&& uniforms) const {
        using R = RealFrom<U, Scalar>;
        using First = typename Base::template Nth<0>;
        using Value = decltype(this->template draw<0, R>(f, detail::next_for<First, R>(uniforms)));
        detail::RoundsInLanes<Value, Base::size, R> rounds{this->factors()};
        const auto draw_one = [&](auto i, const auto& u, const MaskOf<R>& selected) {
            if constexpr (Base::template is_delta<i>) {
                rounds.add_delta(i, Base::template as_value<Value>(this->template draw<i, R>(f, u, selected)),
                                 selected);
            } else {
                rounds.add(i, this->template observe<i, R>(f, u, selected), selected);
            }
        };
        if constexpr (std::floating_point<R>) {
            this->select(uniforms, [&](auto i) {
                draw_one(i, detail::next_for<typename Base::template Nth<i>, R>(uniforms), true);
            });
        } else {
            this->template select_in_lanes<R>(uniforms, draw_one);
        }
        return rounds.result();
    }
};

template <class First, class... Rest>
    requires Composable<First, Rest...>
[[nodiscard]] LUMIS_HD constexpr auto rounds_of(Take<First> first LUMIS_LIFETIME_BOUND,
                                                Take<Rest>... rest LUMIS_LIFETIME_BOUND) {
    return MultiSampleRounds<First, Rest...>{BalanceHeuristic{}, std::move(first), std::move(rest)...};
}
template <class First, class... Rest>
    requires Composable<First, Rest...>
[[nodiscard]] LUMIS_HD constexpr auto rounds_of(Choose<First> first LUMIS_LIFETIME_BOUND,
                                                Choose<Rest>... rest LUMIS_LIFETIME_BOUND) {
    return OneSampleRounds<First, Rest...>{BalanceHeuristic{}, std::move(first), std::move(rest)...};
}

// Draws rounds and accumulates them for one integral. Value is what the integrand returns: a number, or a glm::vec.
template <SumsInDouble Value, class Rounds>
class Optimal : public CrossFitted<Value, Rounds::size> {
  public:
    LUMIS_HD explicit constexpr Optimal(Rounds rounds) : rounds_{std::move(rounds)} {}

    using CrossFitted<Value, Rounds::size>::add;

    // A round of every technique; in lanes one for each. See MultiSampleRounds::round and OneSampleRounds::round.
    template <class F, class U>
    requires UniformSource<U, RealFrom<U, typename Rounds::Scalar>> LUMIS_HD void add(F&& f, U&& uniforms) {
        const auto drawn = rounds_.round(f, uniforms);
        if constexpr (requires { drawn.size(); }) {
            for (const auto& round : drawn) add_one(round);
        } else {
            add_one(drawn);
        }
    }

    [[nodiscard]] LUMIS_HD const Rounds& techniques() const noexcept LUMIS_LIFETIME_BOUND { return rounds_; }

  private:
    template <class Wide>
    LUMIS_INLINE void add_one(const Round<Wide, Rounds::size>& round) noexcept {
        static_assert(
            std::same_as<Wide, InDouble<Value>>,
            "optimal<Value>(...) accumulates what the integrand returns: optimal<glm::vec3>(...) for a glm::vec3");
        if constexpr (std::same_as<Wide, InDouble<Value>>) add(round);
    }

    Rounds rounds_;
};

namespace detail {

// void stands for a number of the strategies' type.
template <class Value, class Scalar>
using ValueOr = std::conditional_t<std::is_void_v<Value>, scalar_of<Scalar>, Value>;

}  // namespace detail

// optimal(take(1, bsdf), take(1, light)), or of choose(probability, strategy)...; optimal<glm::vec3>(...) for colour.
template <class Value = void, class First, class... Rest>
    requires Composable<First, Rest...>
[[nodiscard]] LUMIS_HD constexpr auto optimal(Take<First> first LUMIS_LIFETIME_BOUND,
                                              Take<Rest>... rest LUMIS_LIFETIME_BOUND) {
    using Rounds = MultiSampleRounds<First, Rest...>;
    return Optimal<detail::ValueOr<Value, typename Rounds::Scalar>, Rounds>{
        rounds_of(std::move(first), std::move(rest)...)};
}
template <class Value = void, class First, class... Rest>
    requires Composable<First, Rest...>
[[nodiscard]] LUMIS_HD constexpr auto optimal(Choose<First> first LUMIS_LIFETIME_BOUND,
                                              Choose<Rest>... rest LUMIS_LIFETIME_BOUND) {
    using Rounds = OneSampleRounds<First, Rest...>;
    return Optimal<detail::ValueOr<Value, typename Rounds::Scalar>, Rounds>{
        rounds_of(std::move(first), std::move(rest)...)};
}

}  // namespace lumis::LUMIS_ISA
