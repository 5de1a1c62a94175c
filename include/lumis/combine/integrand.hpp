// What an estimator asks of an integrand: it takes a point or a whole sample, and returns something that can be summed.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/strategy.hpp"

#include <concepts>
#include <type_traits>
#include <utility>

namespace lumis {

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

template <class F, class Drawn, bool is_delta>
using ResultOf = std::remove_cvref_t<decltype(evaluate<is_delta>(std::declval<F&>(), std::declval<const Drawn&>()))>;

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

}  // namespace detail

}  // namespace lumis
