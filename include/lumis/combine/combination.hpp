// What both estimators share: the strategies with a factor each, the effective densities factor_i p_i(x), and the weights
// that a heuristic makes of these. The factor is the count n_i in the multi-sample model and the probability c_i in the
// one-sample model.
#pragma once

#include "lumis/combine/detail/nearest.hpp"
#include "lumis/combine/detail/parts.hpp"
#include "lumis/combine/heuristics.hpp"
#include "lumis/combine/integrand.hpp"
#include "lumis/combine/pairwise_weights.hpp"
#include "lumis/combine/technique.hpp"
#include "lumis/combine/weighted_sample.hpp"
#include "lumis/combine/zero.hpp"
#include "lumis/core/detail/for_each_index.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

namespace detail {

// The uniforms that S spends on a sample.
template <class S, Real R, class U>
[[nodiscard]] LUMIS_INLINE constexpr glm::vec<S::dimensions, R> next_for(U& uniforms) {
    return glm::vec<S::dimensions, R>(uniforms.template next<S::dimensions>());
}

// A divisor that is positive where the condition holds. A number's condition does.
template <Real R>
[[nodiscard]] LUMIS_INLINE constexpr R positive_divisor([[maybe_unused]] const MaskOf<R>& condition, R x) noexcept {
    if constexpr (std::floating_point<R>) {
        return x;
    } else {
        return real::divisor_where(condition, x);
    }
}

// Strategies with a density.
template <class... S>
inline constexpr std::size_t number_of_smooth = (std::size_t{!DeltaStrategy<std::remove_cvref_t<S>>} + ... + 0);

// clang-format off: it takes the template arguments for comparisons
template <class H, std::size_t N, class S>
concept Weighs = std::same_as<H, PairwiseWeights> || Heuristic < H,
        scalar_of<typename S::Scalar>,
typename S::Point, N > ;
// clang-format on

// Where a single strategy has a density, its weight is 1 and no heuristic is asked; a technique is none even so.
template <class H>
concept NoTechnique = std::is_class_v<H> && !requires(const H technique) {
    technique.strategy;
};
template <class H, class... S>
concept NeverAsked = (number_of_smooth<S...> <= 1) && NoTechnique<H>;

// What a sample tells: f there, where something was drawn, and the density of every strategy.
template <class Value, Real R, std::size_t N>
struct Observation {
    Value value;
    MaskOf<R> drawn;
    std::array<R, N> densities;
};

// A heuristic that gives what can be drawn a positive weight: it need not be compared to 0.
template <class H>
concept AlwaysPositive = requires {
    requires H::is_positive;
};

}  // namespace detail

// H is a heuristic for these strategies, each of which may be a reference, see Held.
template <class H, class First, class... Rest>
concept HeuristicFor =
    detail::Weighs<H, 1 + sizeof...(Rest), std::remove_cvref_t<First>> || detail::NeverAsked<H, First, Rest...>;

// Densities and weights are asked for at a point of the strategies' or, with Lanes of Scalar, at several at once.
template <class H, class First, class... Rest>
    requires Composable<First, Rest...>
class Combination {
    using S0 = std::remove_cvref_t<First>;

  public:
    using Scalar = typename S0::Scalar;
    using Point = typename S0::Point;
    static constexpr std::size_t size = 1 + sizeof...(Rest);

    // The effective densities factor_i p_i(x). A technique whose factor is 0 is not asked for its density.
    [[nodiscard]] LUMIS_HD std::array<Scalar, size> densities(const Point& x) const noexcept {
        return densities_in<Scalar>(x);
    }
    template <detail::PointInLanes<S0> X>
    [[nodiscard]] LUMIS_HD auto densities(const X& x) const noexcept {
        return densities_in<typename detail::RealAt<S0, X>::type>(x);
    }

    // The weight of technique I at a point.
    template <std::size_t I>
    [[nodiscard]] LUMIS_HD Scalar weight(const Point& x) const noexcept {
        return weight_given<I, Scalar>(x, [&] { return density<I, Scalar>(x); });
    }
    template <std::size_t I, detail::PointInLanes<S0> X>
    [[nodiscard]] LUMIS_HD auto weight(const X& x) const noexcept {
        using R = typename detail::RealAt<S0, X>::type;
        return weight_given<I, R>(x, [&] { return density<I, R>(x); });
    }

    // For hosts that go on with a sample, as a path does: one of technique I, with its effective density and its weight, see
    // WeightedSample. Spends the strategy's uniforms. A technique whose factor is 0 draws with density 0.
    template <std::size_t I, class U>
        requires UniformSource<U, RealFrom<U, Scalar>>
    [[nodiscard]] LUMIS_INLINE auto weighted_sample(U&& uniforms) const& LUMIS_LIFETIME_BOUND {
        using R = RealFrom<U, Scalar>;
        return weighted<I>(detail::sample_in<R>(strategy<I>(), detail::next_for<Nth<I>, R>(uniforms)));
    }
    template <std::size_t I, class U>
    void weighted_sample(U&& uniforms) const&& = delete;  // it refers to the estimator

    // The same of a sample that the host has drawn by the strategy of technique I: that of LightSet::sample_one, for instance.
    template <std::size_t I, AnySample Drawn>
    [[nodiscard]] LUMIS_INLINE auto weighted(const Drawn& sample) const& LUMIS_LIFETIME_BOUND {
        using R = std::remove_cvref_t<decltype(sample.pdf)>;
        static_assert(RealOf<R, Scalar>, "a sample's density is a Scalar of the strategies");
        return WeightedSample<Combination, I, Drawn, R>{*this, sample, effective<I, R>(sample.pdf)};
    }
    template <std::size_t I, AnySample Drawn>
    void weighted(const Drawn& sample) const&& = delete;

    template <std::size_t I>
    [[nodiscard]] LUMIS_HD const auto& strategy() const noexcept LUMIS_LIFETIME_BOUND {
        return detail::part<I>(strategies_);
    }

    template <std::size_t I>
    static constexpr bool is_delta = DeltaStrategy<typename detail::NthStrategy<I, First, Rest...>::type>;

  protected:
    template <std::size_t I>
    using Nth = typename detail::NthStrategy<I, First, Rest...>::type;

    // Moves each strategy once, out of the Take or Choose that holds it: some are large, and a renderer composes an
    // estimator at every point that it lights.
    template <class... Techniques>
    LUMIS_HD constexpr Combination(const H& heuristic, std::array<Scalar, size> factors, Techniques&&... techniques)
        : heuristic_{heuristic}, factors_{factors}, strategies_{{std::forward<Techniques>(techniques).strategy}...} {}

    // What one sample of technique I, drawn from u, adds to an estimate of the integral of f: weight f / (factor_I pdf).
    // In lanes: where `selected` holds, 0 elsewhere.
    template <std::size_t I, Real R, class F>
    [[nodiscard]] LUMIS_INLINE auto draw(F& f, const glm::vec<Nth<I>::dimensions, R>& u,
                                         const MaskOf<R>& selected = true) const {
        using S = Nth<I>;
        if constexpr (takes_point<F, R, I> && detail::SamplesPoints<S>) {
            return contribution<I, R>(f, detail::sample_point_in<R>(strategy<I>(), u), selected);
        } else if constexpr (std::same_as<R, Scalar>) {
            return contribution<I, R>(f, detail::as_promised<Point, Scalar>(strategy<I>().sample(u)), selected);
        } else {
            return contribution<I, R>(f, detail::sample_in<R>(strategy<I>(), u), selected);
        }
    }

    // The same sample as it is: unweighted f, and the densities p_k without their factors, those of factor 0 too.
    template <std::size_t I, Real R, class F>
    [[nodiscard]] LUMIS_INLINE auto observe(F& f, const glm::vec<Nth<I>::dimensions, R>& u,
                                            const MaskOf<R>& selected = true) const {
        using S = Nth<I>;
        if constexpr (takes_point<F, R, I> && detail::SamplesPoints<S>) {
            return observation<I, R>(f, detail::sample_point_in<R>(strategy<I>(), u), selected);
        } else {
            return observation<I, R>(f, detail::sample_in<R>(strategy<I>(), u), selected);
        }
    }

    // Converts a contribution to the type of technique 0's.
    template <class Value, class Drawn>
    [[nodiscard]] LUMIS_INLINE static Value as_value(const Drawn& drawn) {
        static_assert(std::convertible_to<Drawn, Value>,
                      "an integrand returns one type, whichever technique drew its point");
        return Value(drawn);
    }

    [[nodiscard]] LUMIS_HD constexpr Scalar factor(std::size_t i) const noexcept { return factors_[i]; }
    [[nodiscard]] LUMIS_HD constexpr const std::array<Scalar, size>& factors() const noexcept { return factors_; }

    // The rest is how estimates come about: for estimators that do not add contributions up, too.
    template <class, std::size_t, class, Real>
    friend class WeightedSample;

    static constexpr std::size_t number_of_smooth = detail::number_of_smooth<First, Rest...>;

    // An integrand in lanes takes a point in lanes; any other is called with one.
    template <class F, class R, std::size_t I>
    static constexpr bool takes_point =
        Takes<F, Point, is_delta<I>, I> || Takes<F, typename detail::PointIn<Point, Scalar, R>::type, is_delta<I>, I>;

    // Evaluates f where its weight is positive. A delta strategy's sample, and that of the only strategy with a density, has
    // weight 1. Lanes are evaluated all, if any of them has a weight.
    template <std::size_t I, Real R, class F, class Drawn>
    [[nodiscard]] LUMIS_INLINE auto contribution(F& f, const Drawn& sample,
                                                 [[maybe_unused]] const MaskOf<R>& selected) const {
        constexpr bool only_point = takes_point<F, R, I>;
        using Seen = std::remove_cvref_t<decltype(seen<I, only_point, R>(sample))>;
        using Asked = detail::Asked<F, Seen, R, is_delta<I>, I>;
        if constexpr (!IntegrandOfSamples<F, typename Asked::Sample, typename Asked::Scalar, is_delta<I>, I>) {
            detail::require_integrand<F, typename Asked::Sample, typename Asked::Scalar, is_delta<I>, I>();
            return R{};
        } else {
            const R own = factors_[I] * sample.pdf;
            auto drawn = own > 0;
            if constexpr (!std::floating_point<R>) drawn = drawn && selected;
            using Value = ValueOf<std::remove_cvref_t<decltype(detail::evaluate_in<is_delta<I>, I, R>(
                                      f, seen<I, only_point, R>(sample), drawn))>,
                                  R>;
            if (!real::any(drawn)) return zero<Value>::value();
            const R divisor = detail::positive_divisor(drawn, own);
            if constexpr (is_delta<I> || number_of_smooth == 1) {
                const auto& whole = seen<I, only_point, R>(sample);
                decltype(auto) result = detail::evaluate_in<is_delta<I>, I, R>(f, whole, drawn);
                return detail::selected(drawn, detail::quotient<Value>(result, divisor));
            } else {
                const R weight = weight_given<I, R>(sample.value, [&] { return weighed(drawn, own); });
                if constexpr (!detail::AlwaysPositive<H>) {
                    drawn = drawn && weight > 0;
                    if (!real::any(drawn)) return zero<Value>::value();
                }
                const auto& whole = seen<I, only_point, R>(sample);
                decltype(auto) result = detail::evaluate_in<false, I, R>(f, whole, drawn);
                return detail::selected(drawn, detail::scaled<Value>(result, R(weight / divisor)));
            }
        }
    }

    template <std::size_t I, Real R, class F, class Drawn>
    [[nodiscard]] LUMIS_INLINE auto observation(F& f, const Drawn& sample,
                                                [[maybe_unused]] const MaskOf<R>& selected) const {
        constexpr bool only_point = takes_point<F, R, I>;
        using Seen = std::remove_cvref_t<decltype(seen<I, only_point, R>(sample))>;
        using Asked = detail::Asked<F, Seen, R, false, I>;
        if constexpr (!IntegrandOfSamples<F, typename Asked::Sample, typename Asked::Scalar, false, I>) {
            detail::require_integrand<F, typename Asked::Sample, typename Asked::Scalar, false, I>();
            return detail::Observation<R, R, size>{};
        } else {
            auto drawn = sample.pdf > 0;
            if constexpr (!std::floating_point<R>) drawn = drawn && selected;
            using Value = ValueOf<std::remove_cvref_t<decltype(detail::evaluate_in<false, I, R>(
                                      f, seen<I, only_point, R>(sample), drawn))>,
                                  R>;
            detail::Observation<Value, R, size> result{zero<Value>::value(), drawn, {}};
            if (!real::any(drawn)) return result;
            detail::for_each_index<size>([&](auto k) {
                if constexpr (k == I) {
                    result.densities[k] = sample.pdf;
                } else if constexpr (!is_delta<k>) {
                    result.densities[k] = detail::pdf_in<R>(strategy<k>(), sample.value);
                }
            });
            const auto& whole = seen<I, only_point, R>(sample);
            result.value =
                detail::selected(drawn, static_cast<Value>(detail::evaluate_in<false, I, R>(f, whole, drawn)));
            return result;
        }
    }

    // The effective density with which a point was drawn: 0 in lanes in which none was.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE static R weighed([[maybe_unused]] const MaskOf<R>& drawn, R own) noexcept {
        if constexpr (std::floating_point<R>) {
            return own;
        } else {
            return real::select(drawn, own, scalar_of<R>(0));
        }
    }

    // A sample of technique I as an integrand sees it. Where lights are combined it has the distance to the nearest of
    // them, and its surface if they tell it, whichever technique drew it and whatever the counts: the integrand is the same
    // function for all.
    template <std::size_t I, bool only_point, Real R, class Drawn>
    [[nodiscard]] LUMIS_HD decltype(auto) seen(const Drawn& sample) const noexcept {
        constexpr bool is_delta_light = is_delta<I> && detail::DrawsDistance<Nth<I>>;
        // In order of precedence. NOLINTNEXTLINE(bugprone-branch-clone)
        if constexpr (only_point || size == 1 || is_delta_light) {
            return (sample);
        } else if constexpr (detail::KnowSurface<S0, std::remove_cvref_t<Rest>...>) {
            return detail::with_hit(sample,
                                    detail::nearest_hit<I>(strategies_, sample.value, detail::own_hit<R>(sample)));
        } else if constexpr (detail::KnowNearest<S0, std::remove_cvref_t<Rest>...>) {
            const R own = detail::own_distance<R>(sample);
            return detail::with_distance(sample, detail::nearest_along<I>(strategies_, sample.value, own));
        } else if constexpr (detail::DrawsDistance<Nth<I>>) {
            return Sample<std::remove_cvref_t<decltype(sample.value)>, R>{sample.value, sample.pdf};
        } else {
            return (sample);
        }
    }

    template <Real R, class X>
    [[nodiscard]] LUMIS_HD std::array<R, size> densities_in(const X& x) const noexcept {
        std::array<R, size> result{};
        detail::for_each_index<size>([&](auto i) { result[i] = density<i, R>(x); });
        return result;
    }

    template <std::size_t I, Real R, class X>
    [[nodiscard]] LUMIS_HD R density(const X& x) const noexcept {
        if constexpr (is_delta<I>) {
            return R(scalar_of<R>(0));
        } else {
            return real::any(factors_[I] > 0) ? R(factors_[I] * detail::pdf_in<R>(strategy<I>(), x))
                                              : R(scalar_of<R>(0));
        }
    }

    // The effective density where strategy I has density pdf.
    template <std::size_t I, Real R>
    [[nodiscard]] LUMIS_HD R effective(R pdf) const noexcept {
        return real::any(factors_[I] > 0) ? R(factors_[I] * pdf) : R(scalar_of<R>(0));
    }

    // The weight of technique I at x. own() is technique I's effective density there: a caller that has drawn x knows it.
    template <std::size_t I, Real R, class X, class Own>
    [[nodiscard]] LUMIS_HD R weight_given(const X& x, Own own) const noexcept {
        return weight_from<I, R>(x, own, [&](auto k) { return density<k, R>(x); });
    }

    // The same, where other(k) is the effective density of any other technique.
    template <std::size_t I, Real R, class X, class Own, class Other>
    [[nodiscard]] LUMIS_HD R weight_from(const X& x, Own own, Other other) const noexcept {
        using T = scalar_of<R>;
        if constexpr (number_of_smooth == 1 && !is_delta<I>) {
            return real::select(own() > 0, R(T(1)), T(0));
        } else if constexpr (PointHeuristic<H, Point>) {
            const auto weight = [&](const auto& at) { return heuristic_.owns(I, at) ? T(1) : T(0); };
            if constexpr (std::floating_point<R>) {
                return weight(x);
            } else {
                return detail::each_lane<R>(weight, x);
            }
        } else if constexpr (std::same_as<H, PairwiseWeights>) {
            const auto factor = [&](auto k) { return is_delta<k> ? Scalar(T(0)) : factors_[k]; };
            return heuristic_.template weight<I, size, R>(factor, [&](auto k) {
                if constexpr (k == I) {
                    return own();
                } else {
                    return other(k);
                }
            });
        } else {
            std::array<R, size> q{};
            detail::for_each_index<size>([&](auto k) {
                if constexpr (k == I) {
                    q[k] = own();
                } else {
                    q[k] = other(k);
                }
            });
            return detail::weigh(heuristic_, I, std::span<const R, size>{q});
        }
    }

  private:
    [[no_unique_address]] H heuristic_;
    std::array<Scalar, size> factors_;
    detail::Parts<First, Rest...> strategies_;
};

}  // namespace lumis::LUMIS_ISA
