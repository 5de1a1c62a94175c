// The concepts that everything composes by. A strategy is a distribution one can draw from and evaluate.
#pragma once

#include "lumis/core/measure.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"

#include <glm/ext/vector_double1.hpp>
#include <glm/ext/vector_float1.hpp>
#include <glm/vec4.hpp>

#include <concepts>

namespace lumis::LUMIS_ISA {

// The uniforms that S spends on a sample, each in [0, 1); exactly 1 is tolerated.
template <class S>
using UniformsOf = glm::vec<S::dimensions, typename S::Scalar>;

// sample(u) draws a point and reports pdf(point); pdf(x) is total: 0 off the support, never negative, never NaN.
// Both are pure, noexcept, and take numbers, never a generator, so that any sampler fits (Sobol, Halton, a host's own).
template <class S>
concept Strategy = Real<typename S::Scalar> && std::integral<std::remove_cv_t<decltype(S::dimensions)>> &&
    requires(const S strategy, UniformsOf<S> u, typename S::Point x) {
    typename S::Measure;
    { strategy.sample(u).value } -> std::convertible_to<typename S::Point>;
    { strategy.sample(u).pdf } -> std::convertible_to<typename S::Scalar>;
    { strategy.pdf(x) } -> std::convertible_to<typename S::Scalar>;
};

namespace detail {

// A sample as it is, if its point and density are a Point and an R; else one that is made of what they convert to.
template <class Point, class R, class Drawn>
[[nodiscard]] LUMIS_INLINE constexpr decltype(auto) as_promised(const Drawn& sample) {
    if constexpr (std::same_as<decltype(sample.value), Point> && std::same_as<decltype(sample.pdf), R>) {
        return (sample);
    } else if constexpr (requires { sample.distance; }) {
        return LightSample<Point, R>{Point(sample.value), static_cast<R>(sample.pdf), static_cast<R>(sample.distance)};
    } else {
        return Sample<Point, R>{Point(sample.value), static_cast<R>(sample.pdf)};
    }
}

}  // namespace detail

// invert(sample(u).value) == u up to rounding.
template <class S>
concept InvertibleStrategy = Strategy<S> && requires(const S strategy, typename S::Point x) {
    { strategy.invert(x) } -> std::convertible_to<UniformsOf<S>>;
};

// Draws from a set of measure zero: pdf(x) is 0 everywhere, and sample(u).pdf is a probability.
template <class S>
concept DeltaStrategy = Strategy<S> && requires {
    requires S::is_delta;
};

// A light as seen from the shaded point: distance_along(w) is how far away it is along the direction w, infinity where w
// misses it. Combinations need it, for one light may stand before another.
template <class S>
concept LightStrategy = Strategy<S> && requires(const S light, typename S::Point w) {
    { light.distance_along(w) } -> std::same_as<typename S::Scalar>;
};

namespace detail {

template <class Drawn>
concept HasDistance = requires(const Drawn drawn) {
    drawn.distance;
};

template <class S>
concept DrawsDistance = requires(const S strategy, UniformsOf<S> u) {
    strategy.sample(u).distance;
};

// Draws a point and its density alone, too: sample looks for the nearest light as well.
template <class S>
concept SamplesPoints = requires(const S strategy, UniformsOf<S> u) {
    strategy.sample_point(u);
};

}  // namespace detail

// Tells an integrand that its point came from a delta strategy and that it is asked for the coefficient.
struct delta_t {
    explicit delta_t() = default;
};
inline constexpr delta_t delta{};

// A whole sample, for integrands that want more than the point: [](const AnySample auto& s) { ... s.value ... }.
template <class S>
concept AnySample = requires(const S s) {
    s.value;
    s.pdf;
};

}  // namespace lumis::LUMIS_ISA
