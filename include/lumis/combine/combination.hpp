// What both estimators share: the strategies with a factor each, the effective densities factor_i p_i(x), and the weights
// that a heuristic makes of these. The factor is the count n_i in the multi-sample model and the probability c_i in the
// one-sample model.
#pragma once

#include "lumis/combine/detail/nearest.hpp"
#include "lumis/combine/detail/parts.hpp"
#include "lumis/combine/heuristics.hpp"
#include "lumis/combine/integrand.hpp"
#include "lumis/combine/technique.hpp"
#include "lumis/core/detail/for_each_index.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

namespace lumis {

namespace detail {

// The uniforms that S spends on a sample.
template <class S, class U>
[[nodiscard]] LUMIS_INLINE constexpr UniformsOf<S> next_for(U& uniforms) {
    return UniformsOf<S>(uniforms.template next<S::dimensions>());
}

// The value over a divisor. A number is divided, which rounds once; other values need only scale.
template <class Value, std::floating_point T>
[[nodiscard]] LUMIS_HD constexpr auto quotient(const Value& value, T divisor) {
    if constexpr (std::same_as<Value, T>) {
        return value / divisor;
    } else {
        return value * (1 / divisor);
    }
}

// Strategies with a density.
template <class... S>
inline constexpr std::size_t number_of_smooth = (std::size_t{!DeltaStrategy<std::remove_cvref_t<S>>} + ... + 0);

template <class H, std::size_t N, class S>
concept Weighs = Heuristic<H, typename S::Scalar, typename S::Point, N>;

// Where a single strategy has a density, its weight is 1 and no heuristic is asked; a technique is none even so.
template <class H>
concept NoTechnique = std::is_class_v<H> && !requires(const H technique) {
    technique.strategy;
};
// A heuristic that gives what can be drawn a positive weight: it need not be compared to 0.
template <class H>
concept AlwaysPositive = requires {
    requires H::is_positive;
};

template <class H, class... S>
concept NeverAsked = (number_of_smooth<S...> <= 1) && NoTechnique<H>;

}  // namespace detail

// H is a heuristic for these strategies, each of which may be a reference, see Held.
template <class H, class First, class... Rest>
concept HeuristicFor =
    detail::Weighs<H, 1 + sizeof...(Rest), std::remove_cvref_t<First>> || detail::NeverAsked<H, First, Rest...>;

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
        std::array<Scalar, size> result{};
        detail::for_each_index<size>([&](auto i) { result[i] = density<i>(x); });
        return result;
    }

    // The weight of technique I at a point.
    template <std::size_t I>
    [[nodiscard]] LUMIS_HD Scalar weight(const Point& x) const noexcept {
        return weight_given<I>(x, [&] { return density<I>(x); });
    }

    template <std::size_t I>
    [[nodiscard]] LUMIS_HD const auto& strategy() const noexcept LUMIS_LIFETIME_BOUND {
        return detail::part<I>(strategies_);
    }

  protected:
    // Moves each strategy once, out of the Take or Choose that holds it: some are large, and a renderer composes an
    // estimator at every point that it lights.
    template <class... Techniques>
    LUMIS_HD constexpr Combination(const H& heuristic, std::array<Scalar, size> factors, Techniques&&... techniques)
        : heuristic_{heuristic}, factors_{factors}, strategies_{{std::forward<Techniques>(techniques).strategy}...} {}

    // What one sample of technique I adds to an estimate of the integral of f: weight f / (factor_I pdf).
    template <std::size_t I, class F, class U>
    [[nodiscard]] LUMIS_HD auto draw(F& f, U& uniforms) const {
        using S = Nth<I>;
        if constexpr (Takes<F, Point, is_delta<I>> && detail::SamplesPoints<S>) {
            return contribution<I>(f, strategy<I>().sample_point(detail::next_for<S>(uniforms)));
        } else {
            return contribution<I>(
                f, detail::as_promised<Point, Scalar>(strategy<I>().sample(detail::next_for<S>(uniforms))));
        }
    }

    // The same, converted to Value, the type of technique 0's.
    template <class Value, std::size_t I, class F, class U>
    [[nodiscard]] LUMIS_HD Value draw_as(F& f, U& uniforms) const {
        static_assert(std::convertible_to<decltype(draw<I>(f, uniforms)), Value>,
                      "an integrand returns one type, whichever technique drew its point");
        return Value(draw<I>(f, uniforms));
    }

    [[nodiscard]] LUMIS_HD constexpr Scalar factor(std::size_t i) const noexcept { return factors_[i]; }

  private:
    template <std::size_t I>
    using Nth = typename detail::NthStrategy<I, First, Rest...>::type;
    template <std::size_t I>
    static constexpr bool is_delta = DeltaStrategy<Nth<I>>;
    static constexpr std::size_t number_of_smooth = detail::number_of_smooth<First, Rest...>;

    // Evaluates f where its weight is positive. A delta strategy's sample, and that of the only strategy with a density, has
    // weight 1.
    template <std::size_t I, class F, class Drawn>
    [[nodiscard]] LUMIS_INLINE auto contribution(F& f, const Drawn& sample) const {
        constexpr bool only_point = Takes<F, Point, is_delta<I>>;
        using Seen = std::remove_cvref_t<decltype(seen<I, only_point>(sample))>;
        if constexpr (!IntegrandOfSamples<F, Seen, Scalar, is_delta<I>>) {
            detail::require_integrand<F, Seen, Scalar, is_delta<I>>();
            return Scalar{};
        } else {
            using Value = detail::ScaledBy<detail::ResultOf<F, Seen, is_delta<I>>, Scalar>;
            const Scalar own = factors_[I] * sample.pdf;
            if (!(own > 0)) return Value{};
            if constexpr (is_delta<I> || number_of_smooth == 1) {
                const auto& whole = seen<I, only_point>(sample);
                return Value(detail::quotient(detail::evaluate<is_delta<I>>(f, whole), own));
            } else {
                const Scalar weight = weight_given<I>(sample.value, [&] { return own; });
                if constexpr (!detail::AlwaysPositive<H>) {
                    if (!(weight > 0)) return Value{};
                }
                const auto& whole = seen<I, only_point>(sample);
                return Value(detail::evaluate<false>(f, whole) * (weight / own));
            }
        }
    }

    // A sample of technique I as an integrand sees it. Where lights are combined it has the distance to the nearest of
    // them, whichever technique drew it and whatever the counts: the integrand is the same function for all.
    template <std::size_t I, bool only_point, class Drawn>
    [[nodiscard]] LUMIS_HD decltype(auto) seen(const Drawn& sample) const noexcept {
        constexpr bool is_delta_light = is_delta<I> && detail::DrawsDistance<Nth<I>>;
        if constexpr (only_point || size == 1 || is_delta_light) {
            return (sample);
        } else if constexpr (detail::KnowNearest<S0, std::remove_cvref_t<Rest>...>) {
            const Scalar own = detail::own_distance<Scalar>(sample);
            return detail::with_distance(sample, detail::nearest_along<I>(strategies_, sample.value, own));
        } else if constexpr (detail::DrawsDistance<Nth<I>>) {
            return Sample<Point, Scalar>{sample.value, sample.pdf};
        } else {
            return (sample);
        }
    }

    template <std::size_t I>
    [[nodiscard]] LUMIS_HD Scalar density(const Point& x) const noexcept {
        if constexpr (is_delta<I>) {
            return 0;
        } else {
            return factors_[I] > 0 ? factors_[I] * static_cast<Scalar>(strategy<I>().pdf(x)) : Scalar(0);
        }
    }

    // The weight of technique I at x. own() is technique I's effective density there: a caller that has drawn x knows it.
    template <std::size_t I, class Own>
    [[nodiscard]] LUMIS_HD Scalar weight_given(const Point& x, Own own) const noexcept {
        if constexpr (number_of_smooth == 1 && !is_delta<I>) {
            return own() > 0 ? Scalar(1) : Scalar(0);
        } else if constexpr (PointHeuristic<H, Point>) {
            return heuristic_.owns(I, x) ? Scalar(1) : Scalar(0);
        } else {
            std::array<Scalar, size> q{};
            detail::for_each_index<size>([&](auto k) {
                if constexpr (k == I) {
                    q[k] = own();
                } else {
                    q[k] = density<k>(x);
                }
            });
            return detail::weigh(heuristic_, I, std::span<const Scalar, size>{q});
        }
    }

    [[no_unique_address]] H heuristic_;
    std::array<Scalar, size> factors_;
    detail::Parts<First, Rest...> strategies_;
};

}  // namespace lumis
