// One light of a set, and a direction to it: a strategy over pairs of both, whose density is known in constant time, however many
// lights there are. A LightSet is one over directions, whose density asks every light.
// MetLight carries a strategy over directions, that of a BSDF, to such pairs: so both combine in constant time.
//
//     const SelectedLight one{LightSet{lights, tree.from(point, normal)}};
//     const MetLight met{one, in_frame(frame, bsdf), [&](vec3 w) { return scene.trace(point, w).light; }};
//     const auto direct = multi_sample(PowerHeuristic{}, take(1, met), take(1, one));
//     direct.estimate([&](const AnySample auto& s) { ... s.value.index, s.value.direction, s.distance }, uniforms);
#pragma once

#include "lumis/core/detail/held.hpp"
#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/surface_point.hpp"

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

// One of several lights, and where it is looked for.
template <class Point>
struct ToLight {
    std::size_t index{};
    Point direction{};
};

// Meant for many lights, and as a source of candidates for resample. An integrand is told light x.index and the direction
// x.direction, and returns what this light alone contributes; where another hides it, 0. Measure: counting over the lights, times
// solid angle. u is that of the set. Samples have the distance to the light, and its surface if it tells one. Strategies over
// directions do not compose with it: their points are others. Set is a LightSet, and may be a reference, see Held.
template <class Set>
class SelectedLight {
    using Held = std::remove_cvref_t<Set>;
    using OfLight = typename Held::LightSampleType;

  public:
    using Scalar = typename Held::Scalar;
    using Point = ToLight<typename Held::Point>;
    struct Measure {};  // of its own: those of other sets have other integrals
    static constexpr int dimensions = Held::dimensions;
    using SampleType = detail::LaneSample<OfLight, Point, Scalar>;

    LUMIS_HD explicit constexpr SelectedLight(Set set LUMIS_LIFETIME_BOUND) : set_{std::forward<Set>(set)} {}

    [[nodiscard]] LUMIS_HD SampleType sample(glm::vec<dimensions, Scalar> u) const noexcept {
        const auto [index, drawn] = set_.sample_one(u);
        SampleType result{};
        result.value = {index, typename Held::Point(drawn.value)};
        result.pdf = static_cast<Scalar>(drawn.pdf);
        if constexpr (detail::HasDistance<SampleType>) result.distance = drawn.distance;
        if constexpr (detail::HasSurface<SampleType>) result.surface = drawn.surface;
        return result;
    }

    [[nodiscard]] LUMIS_HD Scalar pdf(const Point& x) const noexcept { return set_.pdf_of(x.index, x.direction); }

    // The distance to light x.index; infinity where x.direction misses it.
    [[nodiscard]] LUMIS_HD Scalar distance_along(const Point& x) const noexcept requires requires(const Held& set) {
        set.distance_of(x.index, x.direction);
    }
    { return set_.distance_of(x.index, x.direction); }

  private:
    Set set_;
};

template <class Set>
SelectedLight(Set&&) -> SelectedLight<detail::Held<Set>>;

// A direction drawn by S, and the light that it meets: met(w) is the index of the light that a ray along w meets first, or
// no_light; then nothing is drawn. A ray is traced in sample alone: the density is that of S, for pairs whose light is the one
// that is met; where it is another the integrand is 0, as SelectedLight demands. One: the SelectedLight that this is to be
// combined with.
template <class One, class S, class Meet>
class MetLight {
    using Selected = std::remove_cvref_t<One>;
    using Drawing = std::remove_cvref_t<S>;

  public:
    using Scalar = typename Selected::Scalar;
    using Point = typename Selected::Point;
    using Measure = typename Selected::Measure;
    static constexpr int dimensions = Drawing::dimensions;
    static constexpr bool is_delta = DeltaStrategy<Drawing>;

    static_assert(std::same_as<typename Drawing::Scalar, Scalar> &&
                      std::same_as<typename Drawing::Point, decltype(Point::direction)>,
                  "lights are met by directions of their own scalar type");

    // The type alone of `one` counts.
    LUMIS_HD constexpr MetLight(const Selected&, S strategy LUMIS_LIFETIME_BOUND, Meet met)
        : strategy_{std::forward<S>(strategy)}, met_{std::move(met)} {}

    [[nodiscard]] LUMIS_HD Sample<Point, Scalar> sample(glm::vec<dimensions, Scalar> u) const noexcept {
        const auto drawn = strategy_.sample(u);
        const auto pdf = static_cast<Scalar>(drawn.pdf);
        if (!(pdf > 0)) return {};
        const decltype(Point::direction) w(drawn.value);
        const std::size_t index = met_(w);
        return {{index, w}, index != no_light ? pdf : Scalar(0)};
    }

    [[nodiscard]] LUMIS_HD Scalar pdf(const Point& x) const noexcept {
        return x.index != no_light ? static_cast<Scalar>(strategy_.pdf(x.direction)) : Scalar(0);
    }

  private:
    S strategy_;
    Meet met_;
};

template <class Selected, class S, class Meet>
MetLight(const Selected&, S&&, Meet) -> MetLight<Selected, detail::Held<S>, Meet>;

}  // namespace lumis::LUMIS_ISA
