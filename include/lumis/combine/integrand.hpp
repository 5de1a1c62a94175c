// What an estimator asks of an integrand: it takes a point or a whole sample, and returns something that can be summed.
#pragma once

#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/strategy.hpp"

#include <concepts>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

// An integrand is called with the point if it takes one, else with the whole sample. A point of a delta strategy comes
// with a tag, which asks for the coefficient.
template <class F, class Argument, bool is_delta>
concept Takes = (is_delta ? std::invocable<F&, const Argument&, delta_t> : std::invocable<F&, const Argument&>);

// What an integrand returns scales by the strategies' Scalar. A glm::dvec3 does not by a float.
template <class Value, class Scalar>
concept ScalesBy = requires(const Value value, const Scalar scale) {
    value* scale;
};

// The product adds to itself, and value-initialised it is a zero: a number, a glm::vec, a host's spectrum. Those of Eigen
// are none: its products refer to their operands.
template <class Value>
concept AddsUp = std::default_initializable<Value> && requires(const Value value) {
    { value + value } -> std::convertible_to<Value>;
};

namespace detail {

template <bool is_delta, class F, class Drawn>
[[nodiscard]] LUMIS_HD constexpr decltype(auto) evaluate(F& f, const Drawn& sample) {
    constexpr bool takes_point = Takes<F, decltype(sample.value), is_delta>;
    if constexpr (is_delta && takes_point) {
        return f(sample.value, delta);
    } else if constexpr (is_delta) {
        return f(sample, delta);
    } else if constexpr (takes_point) {
        return f(sample.value);
    } else {
        return f(sample);
    }
}

// What evaluate returns. It is not asked: its body must not be made for lanes that F seems to take, see SamplesLanes.
template <class F, class Drawn, bool is_delta>
[[nodiscard]] consteval auto result_of() {
    constexpr bool takes_point = Takes<F, decltype(Drawn::value), is_delta>;
    using Argument = std::conditional_t<takes_point, decltype(Drawn::value), Drawn>;
    if constexpr (is_delta) {
        return std::type_identity<std::invoke_result_t<F&, const Argument&, delta_t>>{};
    } else {
        return std::type_identity<std::invoke_result_t<F&, const Argument&>>{};
    }
}
template <class F, class Drawn, bool is_delta>
using ResultOf = std::remove_cvref_t<typename decltype(result_of<F, Drawn, is_delta>())::type>;

template <class Value, class Scalar>
using ScaledBy = std::remove_cvref_t<decltype(std::declval<const Value&>() * Scalar{})>;

}  // namespace detail

// F can be integrated by samples of type Drawn.
template <class F, class Drawn, class Scalar, bool is_delta = false>
concept IntegrandOfSamples = (Takes<F, decltype(Drawn::value), is_delta> || Takes<F, Drawn, is_delta>)&&ScalesBy<
    detail::ResultOf<F, Drawn, is_delta>,
    Scalar>&& AddsUp<detail::ScaledBy<detail::ResultOf<F, Drawn, is_delta>, Scalar>>;

// F can be integrated by a strategy of type S.
template <class F, class S>
concept Integrand = Strategy<S> && IntegrandOfSamples<F, decltype(std::declval<const S&>().sample(UniformsOf<S>{})),
                                                      typename S::Scalar, DeltaStrategy<S>>;

namespace detail {

// Says what F lacks to be integrated by samples of type Drawn.
template <class F, class Drawn, class Scalar, bool is_delta>
consteval void require_integrand() {
    constexpr bool takes = Takes<F, decltype(Drawn::value), is_delta> || Takes<F, Drawn, is_delta>;
    if constexpr (!takes) {
        static_assert(takes || is_delta, "an integrand takes the point, f(x), or the whole sample, f(sample)");
        static_assert(takes || !is_delta,
                      "a delta strategy asks the integrand for its coefficient: f(x, lumis::delta)");
    } else if constexpr (std::is_void_v<ResultOf<F, Drawn, is_delta>>) {
        static_assert(!std::is_void_v<ResultOf<F, Drawn, is_delta>>,
                      "an integrand returns its value, but this one returns void");
    } else if constexpr (!ScalesBy<ResultOf<F, Drawn, is_delta>, Scalar>) {
        static_assert(ScalesBy<ResultOf<F, Drawn, is_delta>, Scalar>,
                      "an integrand's value scales by the strategies' Scalar: glm::vec3 over strategies of float, "
                      "glm::dvec3 over those of double");
    } else {
        static_assert(AddsUp<ScaledBy<ResultOf<F, Drawn, is_delta>, Scalar>>,
                      "an integrand's value, scaled, adds to itself and has a zero, Value{}: expression templates such "
                      "as Eigen's are no values");
    }
}

// What an integrand over numbers returns, in lanes: of numbers, and of a glm::vec of numbers.
template <class Value, class R>
struct ValueIn {};
template <class Value, class R>
    requires std::is_arithmetic_v<Value>
struct ValueIn<Value, R> : std::type_identity<R> {
};
template <int N, class T, glm::qualifier Q, class R>
    requires std::is_arithmetic_v<T>
struct ValueIn<glm::vec<N, T, Q>, R> : std::type_identity<glm::vec<N, R, Q>> {
};

template <class Value>
concept OfNumbers = requires {
    typename ValueIn<Value, Value>::type;
};

// An integrand that is written for a Real: given lanes, it returns something that is made of lanes as well. Any other is
// called for one lane after the other.
template <class F, class Drawn, class R, bool is_delta>
concept WorksInLanes = IntegrandOfSamples<F, Drawn, R, is_delta> && !OfNumbers<ResultOf<F, Drawn, is_delta>>;

// What F is called with, given a sample: the sample itself, or one lane of it.
template <class F, class Drawn, class R, bool is_delta>
struct Asked {
    using Sample = Drawn;
    using Scalar = R;
};
template <class F, class Drawn, class R, bool is_delta>
    requires(!std::floating_point<R> && !WorksInLanes<F, Drawn, R, is_delta>)
struct Asked<F, Drawn, R, is_delta> {
    using Sample = decltype(lane_of_sample(std::declval<const Drawn&>(), 0));
    using Scalar = scalar_of<R>;
};

// f at a sample, where `drawn` holds. An integrand in lanes is called for all of them; what it returns in the others is
// dropped by selected.
template <bool is_delta, Real R, class F, class Drawn>
[[nodiscard]] LUMIS_INLINE inline decltype(auto) evaluate_in(F& f, const Drawn& sample,
                                                             [[maybe_unused]] const MaskOf<R>& drawn) {
    if constexpr (std::floating_point<R> || WorksInLanes<F, Drawn, R, is_delta>) {
        return evaluate<is_delta>(f, sample);
    } else {
        using Value = ResultOf<F, decltype(lane_of_sample(sample, 0)), is_delta>;
        static_assert(OfNumbers<Value>,
                      "lanes of estimates are summed for integrands that take lanes, or return a number or a glm::vec");
        typename ValueIn<Value, R>::type result{};
        for (std::size_t i = 0; i < R::size; ++i) {
            if (drawn[i]) put_lane(result, i, evaluate<is_delta>(f, lane_of_sample(sample, i)));
        }
        return result;
    }
}

// A value in the lanes where the condition holds, 0 in the others: selected, for a product would let NaN through. A type of
// one's own offers select(condition, a, b), found by its argument. A number's condition holds already.
template <class Mask, class Value>
[[nodiscard]] LUMIS_INLINE inline Value selected(const Mask& condition, const Value& value) {
    if constexpr (std::same_as<Mask, bool>) {
        return value;
    } else if constexpr (Real<Value>) {
        return real::select(condition, value, scalar_of<Value>(0));
    } else {
        constexpr bool has_select = requires {
            select(condition, value, Value{});
        };
        static_assert(has_select, "a type of one's own offers select(condition, a, b) where lanes of it are summed");
        return select(condition, value, Value{});
    }
}
template <class Mask, int N, class R, glm::qualifier Q>
[[nodiscard]] LUMIS_INLINE inline glm::vec<N, R, Q> selected(const Mask& condition, const glm::vec<N, R, Q>& value) {
    if constexpr (std::same_as<Mask, bool>) {
        return value;
    } else {
        return select_point(condition, value, glm::vec<N, R, Q>{R(scalar_of<R>(0))});
    }
}

}  // namespace detail

}  // namespace lumis::LUMIS_ISA
