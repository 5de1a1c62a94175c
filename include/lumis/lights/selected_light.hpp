// One light of a set, and a direction to it: a strategy over pairs of both, whose density is known in constant time, however many
// lights there are. A LightSet is one over directions, whose density asks every light.
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

  private:
    Set set_;
};

template <class Set>
SelectedLight(Set&&) -> SelectedLight<detail::Held<Set>>;

}  // namespace lumis::LUMIS_ISA
