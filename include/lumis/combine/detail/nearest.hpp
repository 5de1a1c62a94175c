// How far away the nearest of several lights is. A light in front of another hides it, whichever of them drew the
// direction: a shadow ray that stops at the nearest light finds what is really seen there.
#pragma once

#include "lumis/combine/detail/parts.hpp"
#include "lumis/core/detail/for_each_index.hpp"
#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/strategy.hpp"

#include <concepts>
#include <cstddef>
#include <limits>
#include <utility>

namespace lumis::LUMIS_ISA::detail {

// Combined strategies know the nearest light if there is a light among them, and each whose samples have a distance
// tells it along any direction. A delta light hides nothing: its samples keep the distance that they come with.
template <class... S>
concept KnowNearest = (LightStrategy<S> || ...) && ((LightStrategy<S> || DeltaStrategy<S> || !DrawsDistance<S>)&&...);

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

// A strategy's own kind of sample, and how far away the nearest light is along it.
template <class Drawn, Real R>
struct WithDistance : Drawn {
    R distance;
};

template <class Drawn, Real R>
[[nodiscard]] LUMIS_HD auto with_distance(const Drawn& sample, R distance) noexcept {
    if constexpr (HasDistance<Drawn>) {
        Drawn result{sample};
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
    if constexpr (requires { sample.distance; }) {
        return sample.distance;
    } else {
        return std::numeric_limits<R>::infinity();
    }
}

}  // namespace lumis::LUMIS_ISA::detail
