// Strategies in lanes: a strategy that is written for a Real is called with lanes, any other for one lane after the other.
// Its points then are those of each lane: lanes of numbers, a glm::vec of such, or else an array of points.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/surface_point.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace lumis::LUMIS_ISA::detail {

template <class Point, class T, class R>
struct PointIn : std::type_identity<std::array<Point, R::size>> {};
template <class Point, class R>
struct PointIn<Point, R, R> : std::type_identity<Point> {};
template <class T, class R>
    requires(!std::same_as<T, R>)
struct PointIn<T, T, R> : std::type_identity<R> {};
template <int N, class T, glm::qualifier Q, class R>
    requires(!std::same_as<T, R>)
struct PointIn<glm::vec<N, T, Q>, T, R> : std::type_identity<glm::vec<N, R, Q>> {};

// The points of S, of numbers or in lanes.
template <class S, class R>
using PointOf = typename PointIn<typename S::Point, typename S::Scalar, R>::type;

// The Real that a point of S is made of, if it is one of S: X is a PointOf<S, RealAt<S, X>>.
template <class S, class X>
struct RealAt {};
template <class S, RealOf<typename S::Scalar> R>
struct RealAt<S, R> : std::type_identity<R> {};
template <class S, int N, RealOf<typename S::Scalar> R, glm::qualifier Q>
struct RealAt<S, glm::vec<N, R, Q>> : std::type_identity<R> {};

// A point of S in lanes, as opposed to one of numbers.
template <class X, class S>
concept PointInLanes = requires {
    typename RealAt<S, X>::type;
    requires !std::same_as<typename RealAt<S, X>::type, typename S::Scalar>;
    requires std::same_as<X, PointOf<S, typename RealAt<S, X>::type>>;
};

// One lane of lanes, of a vector of them, and of an array of points.
template <class L>
[[nodiscard]] LUMIS_INLINE inline auto lane_of(const L& lanes, std::size_t i) noexcept {
    return lanes[i];
}
template <int N, class L, glm::qualifier Q>
[[nodiscard]] LUMIS_INLINE inline auto lane_of(const glm::vec<N, L, Q>& lanes, std::size_t i) noexcept {
    glm::vec<N, scalar_of<L>, Q> result;
    for (int k = 0; k < N; ++k) result[k] = lanes[k][i];
    return result;
}
template <class L>
[[nodiscard]] LUMIS_INLINE inline auto lane_of(const SurfacePoint<L>& lanes, std::size_t i) noexcept {
    return SurfacePoint<scalar_of<L>>{lane_of(lanes.position, i), lane_of(lanes.normal, i), lane_of(lanes.uv, i)};
}
template <class L, class X>
LUMIS_INLINE inline void put_lane(L& lanes, std::size_t i, const X& x) noexcept {
    if constexpr (Real<L>) {
        lanes.set(i, static_cast<scalar_of<L>>(x));
    } else {
        lanes[i] = x;
    }
}
template <int N, class L, class T, glm::qualifier Q>
LUMIS_INLINE inline void put_lane(glm::vec<N, L, Q>& lanes, std::size_t i, const glm::vec<N, T, Q>& x) noexcept {
    for (int k = 0; k < N; ++k) lanes[k].set(i, static_cast<scalar_of<L>>(x[k]));
}
template <class L, class T>
LUMIS_INLINE inline void put_lane(SurfacePoint<L>& lanes, std::size_t i, const SurfacePoint<T>& x) noexcept {
    put_lane(lanes.position, i, x.position);
    put_lane(lanes.normal, i, x.normal);
    put_lane(lanes.uv, i, x.uv);
}

// One lane of a sample.
template <class Drawn>
[[nodiscard]] LUMIS_INLINE inline auto lane_of_sample(const Drawn& drawn, std::size_t i) noexcept;
template <class Drawn, class Index>
[[nodiscard]] LUMIS_INLINE inline auto lane_of_sample(const IndexedSample<Drawn, Index>& drawn,
                                                      std::size_t i) noexcept {
    const Drawn& unindexed = drawn;
    const auto alone = lane_of_sample(unindexed, i);
    return IndexedSample<std::remove_const_t<decltype(alone)>>{alone, drawn.index[i]};
}
template <class Drawn>
[[nodiscard]] LUMIS_INLINE inline auto lane_of_sample(const Drawn& drawn, std::size_t i) noexcept {
    using Point = decltype(lane_of(drawn.value, i));
    using T = decltype(lane_of(drawn.pdf, i));
    if constexpr (HasSurface<Drawn> && !HasDistance<Drawn>) {
        return SurfaceAreaSample<Point, T>{lane_of(drawn.value, i), drawn.pdf[i], lane_of(drawn.surface, i)};
    } else if constexpr (HasSurface<Drawn>) {
        return SurfaceLightSample<Point, T>{lane_of(drawn.value, i), drawn.pdf[i], drawn.distance[i],
                                            lane_of(drawn.surface, i)};
    } else if constexpr (HasDistance<Drawn>) {
        return LightSample<Point, T>{lane_of(drawn.value, i), drawn.pdf[i], drawn.distance[i]};
    } else {
        return Sample<Point, T>{lane_of(drawn.value, i), drawn.pdf[i]};
    }
}

// a where the condition holds, else b; of points.
template <class Mask, class X>
[[nodiscard]] LUMIS_INLINE inline X select_point(const Mask& condition, const X& a, const X& b) noexcept {
    if constexpr (Real<X>) {
        return real::select(condition, a, b);
    } else {
        X result;
        for (decltype(a.size()) i = 0; i < a.size(); ++i) result[i] = condition[i] ? a[i] : b[i];
        return result;
    }
}
template <class Mask, int N, class R, glm::qualifier Q>
[[nodiscard]] LUMIS_INLINE inline glm::vec<N, R, Q> select_point(const Mask& condition, const glm::vec<N, R, Q>& a,
                                                                 const glm::vec<N, R, Q>& b) noexcept {
    glm::vec<N, R, Q> result;
    for (int k = 0; k < N; ++k) result[k] = real::select(condition, a[k], b[k]);
    return result;
}

// Kernels written for a Real. Those for numbers alone seem to take lanes too, for GLM offers to convert any vector.
template <class S, class R>
concept SamplesLanes = requires(const S strategy, glm::vec<S::dimensions, R> u) {
    { strategy.sample(u).pdf } -> std::same_as<R&&>;
};
template <class S, class R>
concept SamplesPointsInLanes = requires(const S strategy, glm::vec<S::dimensions, R> u) {
    { strategy.sample_point(u).pdf } -> std::same_as<R&&>;
};
template <class F, class X, class R>
concept EvaluatesLanes = requires(const F function, const X x) {
    { function(x) } -> std::same_as<R>;
};

// function(lane of x) for each lane.
template <Real R, class F, class X>
[[nodiscard]] LUMIS_HD R each_lane(const F& function, const X& x) {
    R result;
    for (std::size_t i = 0; i < R::size; ++i) result.set(i, static_cast<scalar_of<R>>(function(lane_of(x, i))));
    return result;
}

// Samples in lanes that tell what Drawn does.
template <class Drawn, class Point, class R>
struct InLanes : std::type_identity<Sample<Point, R>> {};
template <HasDistance Drawn, class Point, class R>
struct InLanes<Drawn, Point, R> : std::type_identity<LightSample<Point, R>> {};
template <HasSurface Drawn, class Point, class R>
struct InLanes<Drawn, Point, R> : std::type_identity<SurfaceAreaSample<Point, R>> {};
template <class Drawn, class Point, class R>
    requires HasDistance<Drawn> && HasSurface<Drawn>
struct InLanes<Drawn, Point, R> : std::type_identity<SurfaceLightSample<Point, R>> {
};
template <class Drawn, class Point, class R>
using LaneSample = typename InLanes<Drawn, Point, R>::type;

// draw(lane of u) for each lane, as one sample of S.
template <class S, Real R, class Draw>
[[nodiscard]] LUMIS_HD auto draw_each_lane(const glm::vec<S::dimensions, R>& u, Draw draw) {
    using First = decltype(draw(lane_of(u, 0)));
    constexpr bool has_distance = HasDistance<First>;
    LaneSample<First, PointOf<S, R>, R> result;
    for (std::size_t i = 0; i < R::size; ++i) {
        const auto drawn = draw(lane_of(u, i));
        put_lane(result.value, i, typename S::Point(drawn.value));
        put_lane(result.pdf, i, drawn.pdf);
        if constexpr (has_distance) put_lane(result.distance, i, drawn.distance);
        if constexpr (HasSurface<First>) put_lane(result.surface, i, drawn.surface);
    }
    return result;
}

// strategy.sample(u), sample_point(u), pdf(x) and distance_along(w), for numbers and in lanes, with points and densities of
// the types that the strategy promises.
template <Real R, class S>
[[nodiscard]] LUMIS_INLINE inline auto sample_in(const S& strategy, const glm::vec<S::dimensions, R>& u) {
    if constexpr (std::same_as<R, typename S::Scalar> || SamplesLanes<S, R>) {
        return std::remove_cvref_t<decltype(as_promised<PointOf<S, R>, R>(strategy.sample(u)))>{
            as_promised<PointOf<S, R>, R>(strategy.sample(u))};
    } else {
        return draw_each_lane<S>(u, [&](const auto& numbers) { return strategy.sample(numbers); });
    }
}

template <Real R, class S>
[[nodiscard]] LUMIS_INLINE inline auto sample_point_in(const S& strategy, const glm::vec<S::dimensions, R>& u) {
    if constexpr (std::same_as<R, typename S::Scalar> || SamplesPointsInLanes<S, R>) {
        return strategy.sample_point(u);
    } else {
        return draw_each_lane<S>(u, [&](const auto& numbers) { return strategy.sample_point(numbers); });
    }
}

template <Real R, class S>
[[nodiscard]] LUMIS_INLINE inline R pdf_in(const S& strategy, const PointOf<S, R>& x) {
    const auto pdf = [&](const auto& at) -> decltype(strategy.pdf(at)) { return strategy.pdf(at); };
    if constexpr (std::same_as<R, typename S::Scalar> || EvaluatesLanes<decltype(pdf), PointOf<S, R>, R>) {
        return static_cast<R>(strategy.pdf(x));
    } else {
        return each_lane<R>(pdf, x);
    }
}

template <Real R, class S>
[[nodiscard]] LUMIS_INLINE inline R distance_in(const S& strategy, const PointOf<S, R>& w) {
    const auto distance = [&](const auto& along) -> decltype(strategy.distance_along(along)) {
        return strategy.distance_along(along);
    };
    if constexpr (std::same_as<R, typename S::Scalar> || EvaluatesLanes<decltype(distance), PointOf<S, R>, R>) {
        return strategy.distance_along(w);
    } else {
        return each_lane<R>(distance, w);
    }
}

// What of a light stands along w: the hit of one that tells its surface, else the distance alone.
template <Real R, class S>
[[nodiscard]] LUMIS_INLINE inline LightHit<R> hit_in(const S& light, const PointOf<S, R>& w) {
    if constexpr (!SurfaceStrategy<S>) {
        return {distance_in<R>(light, w), {}};
    } else if constexpr (requires {
                             { light.hit_along(w) } -> std::same_as<LightHit<R>>;
                         }) {
        return light.hit_along(w);
    } else {
        LightHit<R> result;
        for (std::size_t i = 0; i < R::size; ++i) {
            const auto hit = light.hit_along(lane_of(w, i));
            put_lane(result.distance, i, hit.distance);
            put_lane(result.surface, i, hit.surface);
        }
        return result;
    }
}

}  // namespace lumis::LUMIS_ISA::detail
