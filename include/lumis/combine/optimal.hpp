// Optimal weights (Kondapaneni et al. 2019, "Optimal Multiple Importance Sampling"): the balance heuristic's estimate with the
// techniques' densities as control variates,
//
//   sum_k alpha_k + sum over all samples of (f - sum_k alpha_k p_k) / S,   S = sum_k n_k p_k,
//
// where alpha comes from the samples and yet adds no bias, see CrossFitted. No other weights have less variance: those of
// heuristics are positive, and these need not be.
#pragma once

#include "lumis/combine/cross_fitted.hpp"
#include "lumis/combine/detail/shares.hpp"
#include "lumis/combine/multi_sample.hpp"
#include "lumis/combine/one_sample.hpp"
#include "lumis/combine/round.hpp"
#include "lumis/core/platform.hpp"

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

namespace detail {

// A round in each lane of R. A round of numbers is one of a single lane.
template <class V, std::size_t K, Real R>
struct RoundsIn {
    static constexpr std::size_t lanes = 1;
    using Value = V;
    using type = Round<V, K>;
};
template <class V, std::size_t K, Real R>
    requires(!std::floating_point<R>)
struct RoundsIn<V, K, R> {
    static constexpr std::size_t lanes = R::size;
    using Value = decltype(lane_of(std::declval<const V&>(), 0));
    using type = std::array<Round<Value, K>, lanes>;
};

// The number in one lane of x.
template <class X>
[[nodiscard]] LUMIS_INLINE inline auto number_in([[maybe_unused]] std::size_t lane, const X& x) noexcept {
    if constexpr (std::is_arithmetic_v<X>) {
        return x;
    } else {
        return x[lane];
    }
}

// What the samples of combined strategies add to the rounds of all lanes.
template <class V, std::size_t K, Real R>
class RoundsOf {
    using In = RoundsIn<V, K, R>;
    static constexpr std::size_t lanes = In::lanes;
    using Value = typename In::Value;

  public:
    // factors: n_k or c_k.
    template <class Scalar>
    LUMIS_INLINE explicit RoundsOf(const std::array<Scalar, K>& factors) noexcept {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            for (std::size_t k = 0; k < K; ++k) {
                at(lane).equations.factors[k] = static_cast<double>(number_in(lane, factors[k]));
            }
        }
    }

    // A sample of technique i, in the lanes that selected it.
    LUMIS_INLINE void add(std::size_t i, const Observation<V, R, K>& seen, const MaskOf<R>& selected) noexcept {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            if (!number_in(lane, selected)) continue;
            const std::array<double, K>& factors = at(lane).equations.factors;
            if (number_in(lane, seen.drawn)) {
                std::array<double, K> densities;
                for (std::size_t k = 0; k < K; ++k) {
                    densities[k] = static_cast<double>(number_in(lane, seen.densities[k]));
                }
                const Shares<K> over_s = shares(densities, factors);
                at(lane).add_sample(value_in(lane, seen.value) * over_s.inverse, over_s.q);
            } else {
                at(lane).add_alone(i, factors[i], {});  // nothing drawn: f is 0
            }
        }
    }

    // A sample of delta strategy i, given what it contributes: it has to itself all that it can draw.
    LUMIS_INLINE void add_delta(std::size_t i, const V& contribution, const MaskOf<R>& selected) noexcept {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            if (!number_in(lane, selected)) continue;
            at(lane).add_alone(i, at(lane).equations.factors[i], value_in(lane, contribution));
        }
    }

    [[nodiscard]] LUMIS_INLINE const typename In::type& result() const noexcept { return rounds_; }

  private:
    [[nodiscard]] LUMIS_INLINE Round<Value, K>& at([[maybe_unused]] std::size_t lane) noexcept {
        if constexpr (lanes == 1 && std::floating_point<R>) {
            return rounds_;
        } else {
            return rounds_[lane];
        }
    }

    [[nodiscard]] LUMIS_INLINE static InDouble<Value> value_in([[maybe_unused]] std::size_t lane,
                                                               const V& value) noexcept {
        if constexpr (std::floating_point<R>) {
            return static_cast<InDouble<Value>>(value);
        } else {
            return static_cast<InDouble<Value>>(lane_of(value, lane));
        }
    }

    typename In::type rounds_{};
};

}  // namespace detail

// Draws rounds of samples: n_k of every technique. take(0, s) draws none, but s serves as a control variate: it has to
// integrate to 1 over all that the others can draw, else the estimate is biased. Visible normals do not, where they reflect
// samples below the horizon. CrossFitted::control_mean tells.
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
        detail::RoundsOf<Value, Base::size, R> rounds{this->factors()};
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

    // As MultiSampleRounds::round. Spends what OneSample::estimate does.
    template <class F, class U>
        requires UniformSource<U, RealFrom<U, Scalar>>
    [[nodiscard]] LUMIS_INLINE auto round(F&& f, U&& uniforms) const {
        using R = RealFrom<U, Scalar>;
        using First = typename Base::template Nth<0>;
        using Value = decltype(this->template draw<0, R>(f, detail::next_for<First, R>(uniforms)));
        detail::RoundsOf<Value, Base::size, R> rounds{this->factors()};
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
            for (const auto& round : drawn) add(round);
        } else {
            add(drawn);
        }
    }

    [[nodiscard]] LUMIS_HD const Rounds& techniques() const noexcept LUMIS_LIFETIME_BOUND { return rounds_; }

  private:
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
