// What the two estimators share: strategies with their factors, n_i in the multi-sample and c_i in the one-sample model,
// the effective densities factor_i p_i(x), and the weights that a heuristic makes of them.
#pragma once

#include "lumis/combine/for_each_index.hpp"
#include "lumis/combine/heuristics.hpp"
#include "lumis/combine/nearest.hpp"
#include "lumis/combine/technique.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

namespace lumis {

namespace detail {

// An integrand is called with the point if it takes one, else with the whole sample. A delta strategy's point comes with
// a tag, which asks for the coefficient.
template <class F, class Point, bool is_delta>
inline constexpr bool takes_point =
    is_delta ? std::invocable<F&, const Point&, delta_t> : std::invocable<F&, const Point&>;

template <bool is_delta, class F, class S>
[[nodiscard]] constexpr decltype(auto) evaluate(F& f, const S& sample) {
    constexpr bool of_point = takes_point<F, decltype(sample.value), is_delta>;
    if constexpr (is_delta) {
        static_assert(of_point || std::invocable<F&, const S&, delta_t>,
                      "a delta strategy asks the integrand for its coefficient: f(x, lumis::delta)");
        if constexpr (of_point) {
            return f(sample.value, delta);
        } else {
            return f(sample, delta);
        }
    } else if constexpr (of_point) {
        return f(sample.value);
    } else {
        return f(sample);
    }
}

// A number is divided, which rounds once; of anything else no more is asked than that it scales.
template <class Value, std::floating_point T>
[[nodiscard]] constexpr auto quotient(const Value& value, T divisor) {
    if constexpr (std::same_as<Value, T>) {
        return value / divisor;
    } else {
        return value * (1 / divisor);
    }
}

}  // namespace detail

template <class Heuristic, class First, class... Rest>
    requires Composable<First, Rest...>
class Combination {
    using S0 = std::remove_cvref_t<First>;

  public:
    using Scalar = typename S0::Scalar;
    using Point = typename S0::Point;
    static constexpr std::size_t size = 1 + sizeof...(Rest);

    // The effective densities factor_i p_i(x). A technique whose factor is 0 is not asked for its density.
    [[nodiscard]] std::array<Scalar, size> densities(const Point& x) const noexcept {
        std::array<Scalar, size> result{};
        detail::for_each_index<size>([&](auto i) { result[i] = density<i>(x); });
        return result;
    }

    // The weight of technique I at a point.
    template <std::size_t I>
    [[nodiscard]] Scalar weight(const Point& x) const noexcept {
        return weight_given<I>(x, [&] { return density<I>(x); });
    }

    template <std::size_t I>
    [[nodiscard]] const auto& strategy() const noexcept {
        return std::get<I>(strategies_);
    }

  protected:
    // Each strategy is moved once, from the Take or Choose that holds it: some are large, and composing is done at every
    // point to be lit.
    template <class... Techniques>
    constexpr Combination(const Heuristic& heuristic, std::array<Scalar, size> factors, Techniques&&... techniques)
        : heuristic_{heuristic}, factors_{factors}, strategies_{std::forward<Techniques>(techniques).strategy...} {}

    // What one sample of technique I adds to an estimate: its weight times f / (factor_I pdf). Where the integrand takes
    // the point alone, no light is asked how far away it is.
    template <std::size_t I, class F, class U>
    [[nodiscard]] auto draw(F& f, U& uniforms) const {
        constexpr int dimensions = Nth<I>::dimensions;
        if constexpr (detail::takes_point<F, Point, is_delta<I>> && detail::SamplesPoints<Nth<I>>) {
            return weighted<I>(f, strategy<I>().sample_point(uniforms.template next<dimensions>()));
        } else {
            return weighted<I>(f, strategy<I>().sample(uniforms.template next<dimensions>()));
        }
    }

    [[nodiscard]] constexpr Scalar factor(std::size_t i) const noexcept { return factors_[i]; }

  private:
    template <std::size_t I>
    using Nth = std::remove_cvref_t<std::tuple_element_t<I, std::tuple<First, Rest...>>>;
    template <std::size_t I>
    static constexpr bool is_delta = DeltaStrategy<Nth<I>>;

    template <std::size_t I, class F, class S>
    [[nodiscard, gnu::always_inline]] auto weighted(F& f, const S& sample) const {
        constexpr bool only_point = detail::takes_point<F, Point, is_delta<I>>;
        using Value = decltype(detail::evaluate<is_delta<I>>(f, seen<I, only_point>(sample)) * Scalar{});
        const Scalar own = factors_[I] * sample.pdf;
        if (!(own > 0)) return Value{};
        if constexpr (is_delta<I> || number_of_smooth == 1) {
            const auto& whole = seen<I, only_point>(sample);
            return Value(detail::quotient(detail::evaluate<is_delta<I>>(f, whole), own));
        } else {
            const Scalar weight = weight_given<I>(sample.value, [&] { return own; });
            if constexpr (!requires { requires Heuristic::is_positive; }) {
                if (!(weight > 0)) return Value{};
            }
            const auto& whole = seen<I, only_point>(sample);
            return Value(detail::evaluate<false>(f, whole) * (weight / own));
        }
    }

    // A sample of technique I as an integrand sees it. Where lights are combined it has the distance to the nearest of
    // them, whichever technique drew it and whatever the counts: the integrand is the same function for all.
    template <std::size_t I, bool only_point, class S>
    [[nodiscard]] decltype(auto) seen(const S& sample) const noexcept {
        constexpr bool is_delta_light = is_delta<I> && requires {
            sample.distance;
        };
        if constexpr (only_point || size == 1 || is_delta_light) {
            return (sample);
        } else if constexpr (KnowNearest<S0, std::remove_cvref_t<Rest>...>) {
            const Scalar own = detail::own_distance<Scalar>(sample);
            return detail::with_distance(sample, detail::nearest_along<I>(strategies_, sample.value, own));
        } else if constexpr (DrawsDistance<Nth<I>>) {
            return Sample<Point, Scalar>{sample.value, sample.pdf};
        } else {
            return (sample);
        }
    }

    template <std::size_t I>
    [[nodiscard]] Scalar density(const Point& x) const noexcept {
        if constexpr (is_delta<I>) {
            return 0;
        } else {
            return factors_[I] > 0 ? factors_[I] * strategy<I>().pdf(x) : Scalar(0);
        }
    }

    // The weight of technique I at x, whose own effective density own() the caller may know already.
    template <std::size_t I, class Own>
    [[nodiscard]] Scalar weight_given(const Point& x, Own own) const noexcept {
        if constexpr (number_of_smooth == 1 && !is_delta<I>) {
            return own() > 0 ? Scalar(1) : Scalar(0);
        } else if constexpr (PointHeuristic<Heuristic, Point>) {
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

    static constexpr std::size_t number_of_smooth =
        std::size_t{!DeltaStrategy<S0>} + (std::size_t{!DeltaStrategy<std::remove_cvref_t<Rest>>} + ... + 0);

    [[no_unique_address]] Heuristic heuristic_;
    std::array<Scalar, size> factors_;
    std::tuple<First, Rest...> strategies_;
};

}  // namespace lumis
