// What an estimator asks of an integrand: it takes a point or a whole sample, and returns something that can be summed.
#pragma once

#include "lumis/combine/technique.hpp"
#include "lumis/combine/zero.hpp"
#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/strategy.hpp"

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

// An integrand is called with the point if it takes one, else with the whole sample: f(x) or, if it does not take that,
// f(x, technique<I>{}), which tells it who drew. A delta strategy asks for the coefficient by f(x, technique<I>{}, delta) or,
// if it does not take that, by f(x, delta).
template <class F, class Argument, std::size_t I>
concept TakesTechnique = !std::invocable<F&, const Argument&> && std::invocable<F&, const Argument&, technique<I>>;
template <class F, class Argument, std::size_t I>
concept TakesDeltaTechnique = std::invocable<F&, const Argument&, technique<I>, delta_t>;
template <class F, class Argument, bool is_delta, std::size_t I = 0>
concept Takes = (is_delta && (TakesDeltaTechnique<F, Argument, I> || std::invocable<F&, const Argument&, delta_t>)) ||
                (!is_delta && (std::invocable<F&, const Argument&> || TakesTechnique<F, Argument, I>));

// Value, times a Scalar, is a Value again, or converts to one.
template <class Value, class Scalar>
concept ScalesBy = requires(const Value value, const Scalar scale) {
    { value* scale } -> std::convertible_to<Value>;
};

// The same of a sum: a number, a glm::vec, a host's spectrum. No expression template does, for a sum of two is of a third type.
template <class Value>
concept AddsUp = requires(const Value value) {
    { value + value } -> std::convertible_to<Value>;
};

// What an estimate is, for an integrand that returns Result: the same. An integer counts as a number R, for a weight would be
// lost in it.
template <class Result, class R>
using ValueOf = std::conditional_t<std::integral<Result>, R, Result>;

namespace detail {

// f(x) with the tags that it takes.
template <bool is_delta, std::size_t I, class F, class X>
[[nodiscard]] LUMIS_HD constexpr decltype(auto) call(F& f, const X& x) {
    if constexpr (is_delta && TakesDeltaTechnique<F, X, I>) {
        return f(x, technique<I>{}, delta);
    } else if constexpr (is_delta) {
        return f(x, delta);
    } else if constexpr (TakesTechnique<F, X, I>) {
        return f(x, technique<I>{});
    } else {
        return f(x);
    }
}

template <bool is_delta, std::size_t I, class F, class Drawn>
[[nodiscard]] LUMIS_HD constexpr decltype(auto) evaluate(F& f, const Drawn& sample) {
    if constexpr (Takes<F, decltype(sample.value), is_delta, I>) {
        return call<is_delta, I>(f, sample.value);
    } else {
        return call<is_delta, I>(f, sample);
    }
}

// What evaluate returns. It is not asked: its body must not be made for lanes that F seems to take, see SamplesLanes.
template <class F, class Drawn, bool is_delta, std::size_t I>
[[nodiscard]] consteval auto result_of() {
    constexpr bool takes_point = Takes<F, decltype(Drawn::value), is_delta, I>;
    using Argument = std::conditional_t<takes_point, decltype(Drawn::value), Drawn>;
    if constexpr (is_delta && TakesDeltaTechnique<F, Argument, I>) {
        return std::type_identity<std::invoke_result_t<F&, const Argument&, technique<I>, delta_t>>{};
    } else if constexpr (is_delta) {
        return std::type_identity<std::invoke_result_t<F&, const Argument&, delta_t>>{};
    } else if constexpr (TakesTechnique<F, Argument, I>) {
        return std::type_identity<std::invoke_result_t<F&, const Argument&, technique<I>>>{};
    } else {
        return std::type_identity<std::invoke_result_t<F&, const Argument&>>{};
    }
}
template <class F, class Drawn, bool is_delta, std::size_t I>
using ResultOf = std::remove_cvref_t<typename decltype(result_of<F, Drawn, is_delta, I>())::type>;

// The number T, or as many lanes of T as R has.
template <class R, class T>
struct AsManyOf : std::type_identity<T> {};
template <class R, class T>
    requires(!std::floating_point<R>)
struct AsManyOf<R, T> : std::type_identity<typename R::template Of<T>> {};

// Becomes a T and nothing else: it tells what a host's product takes without a conversion.
template <class T>
struct Only {
    template <std::same_as<T> U>
    LUMIS_HD operator U() const;
};

// Doubles are rounded by a product that takes floats: better once, here.
template <class Value, class R>
concept TakesFloats = std::same_as<R, double> && !ScalesBy<Value, Only<double>> && ScalesBy<Value, Only<float>>;

// What scales a Value that is weighed by an R: R, or else doubles, or else floats.
template <class Value, class R>
[[nodiscard]] consteval auto scale_of() {
    using Doubles = AsManyOf<R, double>;
    using Floats = AsManyOf<R, float>;
    if constexpr (ScalesBy<Value, R> && !TakesFloats<Value, R>) {
        return std::type_identity<R>{};
    } else if constexpr (ScalesBy<Value, typename Doubles::type> && !TakesFloats<Value, R>) {
        return Doubles{};
    } else if constexpr (ScalesBy<Value, typename Floats::type>) {
        return Floats{};
    }
}
template <class Value, class R>
using ScaleOf = decltype(scale_of<Value, R>());

template <class Value, class R>
concept Scales = requires {
    typename ScaleOf<Value, R>::type;
};

// What an integrand returned, times a factor. Converted while the operands are there: a product may be an expression that
// refers to them.
template <class Value, class Result, Real R>
[[nodiscard]] LUMIS_INLINE constexpr Value scaled(const Result& result, R factor) {
    using Scale = typename ScaleOf<Value, R>::type;
    if constexpr (std::integral<Result>) {
        return static_cast<Value>(result) * factor;
    } else {
        return static_cast<Value>(result * static_cast<Scale>(factor));
    }
}

// The same over a divisor. A number is divided, which rounds once; other values need only scale.
template <class Value, class Result, Real R>
[[nodiscard]] LUMIS_INLINE constexpr Value quotient(const Result& result, R divisor) {
    if constexpr (std::is_arithmetic_v<Result> || std::same_as<Value, R>) {
        using Wider = std::conditional_t<std::same_as<Value, R>, R, decltype(result * divisor)>;
        return static_cast<Value>(static_cast<Wider>(result) / static_cast<Wider>(divisor));
    } else {
        return scaled<Value>(result, R(1 / divisor));
    }
}

}  // namespace detail

// F can be integrated by samples of type Drawn.
template <class F, class Drawn, class Scalar, bool is_delta = false, std::size_t I = 0>
concept IntegrandOfSamples = (Takes<F, decltype(Drawn::value), is_delta, I> || Takes<F, Drawn, is_delta, I>)&&requires {
    requires detail::Scales<ValueOf<detail::ResultOf<F, Drawn, is_delta, I>, Scalar>, Scalar>;
    requires AddsUp<ValueOf<detail::ResultOf<F, Drawn, is_delta, I>, Scalar>>;
    requires HasZero<ValueOf<detail::ResultOf<F, Drawn, is_delta, I>, Scalar>>;
};

// F can be integrated by a strategy of type S.
template <class F, class S>
concept Integrand = Strategy<S> && IntegrandOfSamples<F, decltype(std::declval<const S&>().sample(UniformsOf<S>{})),
                                                      typename S::Scalar, DeltaStrategy<S>>;

namespace detail {

// Says what F lacks to be integrated by samples of type Drawn.
template <class F, class Drawn, class Scalar, bool is_delta, std::size_t I>
consteval void require_integrand() {
    constexpr bool takes = Takes<F, decltype(Drawn::value), is_delta, I> || Takes<F, Drawn, is_delta, I>;
    if constexpr (!takes) {
        static_assert(takes || is_delta,
                      "an integrand takes the point, f(x), or the whole sample, f(sample); it may take "
                      "lumis::technique<I> as well");
        static_assert(takes || !is_delta,
                      "a delta strategy asks the integrand for its coefficient: f(x, lumis::delta)");
    } else if constexpr (std::is_void_v<ResultOf<F, Drawn, is_delta, I>>) {
        static_assert(!std::is_void_v<ResultOf<F, Drawn, is_delta, I>>,
                      "an integrand returns its value, but this one returns void");
    } else {
        using Value = ValueOf<ResultOf<F, Drawn, is_delta, I>, Scalar>;
        static_assert(Scales<Value, Scalar> && AddsUp<Value>,
                      "an integrand's value, times a number, is one of the same type, and so is a sum of two; one that "
                      "returns an expression template says what value it stands for: -> Eigen::Array3f");
        static_assert(HasZero<Value> || !Scales<Value, Scalar> || !AddsUp<Value>,
                      "an integrand's value has a zero, but its default constructor may set none: template <> struct "
                      "lumis::zero<Value> { static Value value() { return ...; } };");
    }
}

// What an integrand over numbers returns, in lanes: of numbers, and of a glm::vec of numbers.
template <class Value, class R>
struct ValueIn {};
template <std::integral Value, class R>
struct ValueIn<Value, R> : std::type_identity<R> {};
template <std::floating_point Value, class R>
struct ValueIn<Value, R> : AsManyOf<R, Value> {};
template <int N, class T, glm::qualifier Q, class R>
    requires std::is_arithmetic_v<T>
struct ValueIn<glm::vec<N, T, Q>, R> : std::type_identity<glm::vec<N, typename ValueIn<T, R>::type, Q>> {
};

template <class Value>
concept OfNumbers = requires {
    typename ValueIn<Value, float>::type;
};

// An integrand that is written for a Real: given lanes, it returns something that is made of lanes as well. Any other is
// called for one lane after the other.
template <class F, class Drawn, class R, bool is_delta, std::size_t I>
concept WorksInLanes = IntegrandOfSamples<F, Drawn, R, is_delta, I> && !OfNumbers<ResultOf<F, Drawn, is_delta, I>>;

// What F is called with, given a sample: the sample itself, or one lane of it.
template <class F, class Drawn, class R, bool is_delta, std::size_t I>
struct Asked {
    using Sample = Drawn;
    using Scalar = R;
};
template <class F, class Drawn, class R, bool is_delta, std::size_t I>
    requires(!std::floating_point<R> && !WorksInLanes<F, Drawn, R, is_delta, I>)
struct Asked<F, Drawn, R, is_delta, I> {
    using Sample = decltype(lane_of_sample(std::declval<const Drawn&>(), 0));
    using Scalar = scalar_of<R>;
};

// f at a sample, where `drawn` holds. An integrand in lanes is called for all of them; what it returns in the others is
// dropped by selected.
template <bool is_delta, std::size_t I, Real R, class F, class Drawn>
[[nodiscard]] LUMIS_INLINE inline decltype(auto) evaluate_in(F& f, const Drawn& sample,
                                                             [[maybe_unused]] const MaskOf<R>& drawn) {
    if constexpr (std::floating_point<R> || WorksInLanes<F, Drawn, R, is_delta, I>) {
        return evaluate<is_delta, I>(f, sample);
    } else {
        using Value = ResultOf<F, decltype(lane_of_sample(sample, 0)), is_delta, I>;
        static_assert(OfNumbers<Value>,
                      "lanes of estimates are summed for integrands that take lanes, or return a number or a glm::vec");
        auto result = zero<typename ValueIn<Value, R>::type>::value();
        for (std::size_t i = 0; i < R::size; ++i) {
            if (drawn[i]) put_lane(result, i, evaluate<is_delta, I>(f, lane_of_sample(sample, i)));
        }
        return result;
    }
}

// A condition for lanes of another type.
template <class Lanes, class Mask>
[[nodiscard]] LUMIS_INLINE inline MaskOf<Lanes> mask_for(const Mask& condition) {
    if constexpr (std::same_as<Mask, MaskOf<Lanes>>) {
        return condition;
    } else {
        using T = scalar_of<Lanes>;
        return Lanes::of_lanes([&](auto i) { return condition[i] ? T(1) : T(0); }) > T(0);
    }
}

// A value in the lanes where the condition holds, 0 in the others: selected, for a product would let NaN through. A type of
// one's own offers select(condition, a, b), found by its argument. A number's condition holds already.
template <class Mask, class Value>
[[nodiscard]] LUMIS_INLINE inline Value selected(const Mask& condition, const Value& value) {
    if constexpr (std::same_as<Mask, bool>) {
        return value;
    } else if constexpr (Real<Value>) {
        return real::select(mask_for<Value>(condition), value, scalar_of<Value>(0));
    } else {
        constexpr bool has_select = requires {
            select(condition, value, value);
        };
        static_assert(has_select, "a type of one's own offers select(condition, a, b) where lanes of it are summed");
        return select(condition, value, zero<Value>::value());
    }
}
template <class Mask, int N, class R, glm::qualifier Q>
[[nodiscard]] LUMIS_INLINE inline glm::vec<N, R, Q> selected(const Mask& condition, const glm::vec<N, R, Q>& value) {
    if constexpr (std::same_as<Mask, bool>) {
        return value;
    } else {
        return select_point(mask_for<R>(condition), value, glm::vec<N, R, Q>{R(scalar_of<R>(0))});
    }
}

}  // namespace detail

}  // namespace lumis::LUMIS_ISA
