// How far away the nearest of several lights is, and its surface there if lights tell it. A light in front of another hides
// it, whichever of them drew the direction: a shadow ray that stops at the nearest light finds what is really seen there.
#pragma once

#include "lumis/combine/detail/parts.hpp"
#include "lumis/core/detail/for_each_index.hpp"
#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/surface_point.hpp"

#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA::detail {

// Combined strategies know the nearest light if there is a light among them, and each whose samples have a distance
// tells it along any direction. A delta light hides nothing: its samples keep the distance that they come with.
template <class... S>
concept KnowNearest = (LightStrategy<S> || ...) && ((LightStrategy<S> || DeltaStrategy<S> || !DrawsDistance<S>)&&...);

// And the surface of the nearest, where lights among them tell theirs; that of one which does not is all zeros.
template <class... S>
concept KnowSurface = KnowNearest<S...> &&(SurfaceStrategy<S> || ...);

inline constexpr std::size_t no_index = ~std::size_t{};

// The least of `nearest` and the distances to the lights among the strategies along w, except that to number `skipped`.
template <std::size_t skipped = no_index, std::size_t... I, class... S, class Point, Real R>
[[nodiscard]] LUMIS_HD R nearest_along(const IndexedParts<std::index_sequence<I...>, S...>& strategies, const Point& w,
                                       R nearest) noexcept {
    for_each_index<sizeof...(S)>([&](auto k) {
        if constexpr (k != skipped && LightStrategy<typename NthStrategy<k, S...>::type>) {
            nearest = real::lesser(nearest, distance_in<R>(part<k>(strategies), w));
        }
    });
    return nearest;
}

// The same with what stands there.
template <std::size_t skipped = no_index, std::size_t... I, class... S, class Point, Real R>
[[nodiscard]] LUMIS_HD LightHit<R> nearest_hit(const IndexedParts<std::index_sequence<I...>, S...>& strategies,
                                               const Point& w, LightHit<R> nearest) noexcept {
    for_each_index<sizeof...(S)>([&](auto k) {
        if constexpr (k != skipped && LightStrategy<typename NthStrategy<k, S...>::type>) {
            keep_nearer(nearest, hit_in<R>(part<k>(strategies), w));
        }
    });
    return nearest;
}

// The samples of several strategies as one: with a distance where one of them is a light, and with a surface where one tells it.
template <class X, Real R, bool with_distance, bool with_surface>
using SampleOfSeveral =
    std::conditional_t<!with_distance, Sample<X, R>,
                       std::conditional_t<with_surface, SurfaceLightSample<X, R>, LightSample<X, R>>>;

// A sample of a set whose light lies behind another strategy's, which is `nearest`, has the index of none.
template <class Drawn, Real R>
LUMIS_HD void forget_hidden(Drawn& sample, const R& nearest) noexcept {
    if constexpr (requires { sample.index; }) {
        const auto hidden = nearest < sample.distance;
        if constexpr (std::floating_point<R>) {
            if (hidden) sample.index = no_light;
        } else {
            for (std::size_t i = 0; i < R::size; ++i) {
                if (hidden[i]) sample.index[i] = no_light;
            }
        }
    }
}

// A strategy's own kind of sample, and how far away the nearest light is along it.
template <class Drawn, Real R>
struct WithDistance : Drawn {
    R distance;
};

template <class Drawn, Real R>
[[nodiscard]] LUMIS_HD auto with_distance(const Drawn& sample, R distance) noexcept {
    if constexpr (HasDistance<Drawn>) {
        Drawn result{sample};
        forget_hidden(result, distance);
        result.distance = distance;
        return result;
    } else if constexpr (std::same_as<Drawn, Sample<decltype(Drawn::value), R>>) {
        return LightSample<decltype(Drawn::value), R>{sample.value, sample.pdf, distance};
    } else {
        return WithDistance<Drawn, R>{sample, distance};
    }
}

// A drawn sample's own distance; infinity for one that has none.
template <Real R>
[[nodiscard]] LUMIS_HD R own_distance(const auto& sample) noexcept {
    if constexpr (HasDistance<std::remove_cvref_t<decltype(sample)>>) {
        return sample.distance;
    } else {
        return std::numeric_limits<R>::infinity();
    }
}

// The same, and the surface of that light.
template <class Drawn, Real R>
struct WithHit : Drawn {
    R distance;
    SurfacePoint<R> surface;
};

template <class Drawn, Real R>
[[nodiscard]] LUMIS_HD auto with_hit(const Drawn& sample, const LightHit<R>& hit) noexcept {
    using Point = decltype(Drawn::value);
    if constexpr (HasSurface<Drawn>) {
        Drawn result{sample};
        forget_hidden(result, hit.distance);
        result.distance = hit.distance;
        result.surface = hit.surface;
        return result;
    } else if constexpr (std::same_as<Drawn, Sample<Point, R>> || std::same_as<Drawn, LightSample<Point, R>>) {
        return SurfaceLightSample<Point, R>{sample.value, sample.pdf, hit.distance, hit.surface};
    } else {
        WithHit<Drawn, R> result{sample, hit.distance, hit.surface};
        forget_hidden(static_cast<Drawn&>(result), hit.distance);
        return result;
    }
}

// A drawn sample's own distance and surface.
template <Real R>
[[nodiscard]] LUMIS_HD LightHit<R> own_hit(const auto& sample) noexcept {
    if constexpr (HasSurface<std::remove_cvref_t<decltype(sample)>>) {
        return {sample.distance, sample.surface};
    } else {
        return {own_distance<R>(sample), {}};
    }
}

}  // namespace lumis::LUMIS_ISA::detail
