// What a strategy draws: a point, and the density with which it was drawn.
#pragma once

#include "lumis/core/assert.hpp"
#include "lumis/core/detail/arguments.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <concepts>
#include <cstddef>
#include <limits>

namespace lumis::LUMIS_ISA {

// A unit vector that points away from the shaded point.
template <Real R>
using Direction = glm::vec<3, R>;

// pdf == 0 means that nothing was drawn: the value is then unspecified but finite.
template <class Point, Real Scalar>
struct Sample {
    Point value{};
    Scalar pdf{};
};

// A sample of a light: also how far away the light is along the direction; infinity for an environment.
template <class Point, Real Scalar>
struct LightSample {
    Point value{};
    Scalar pdf{};
    Scalar distance{};
};

// A sample of one of several lights, and its index: in lanes an array of them. no_light where a light that is none of them
// stands in front.
inline constexpr std::size_t no_light = ~std::size_t{};
template <class Drawn, class Index = std::size_t>
struct IndexedSample : Drawn {
    Index index{};
};

// The policy for densities in one line: a positive finite number stays; anything else, NaN too, means "nothing drawn".
template <Real R>
[[nodiscard]] LUMIS_HD constexpr R density_or_zero(R pdf) noexcept {
    return real::select(pdf > 0 && pdf <= (std::numeric_limits<R>::max)(), pdf, 0);
}

// Whether a squared length is a normal number, neither 0 nor subnormal nor infinite: then the vector can be normalised.
template <Real R>
[[nodiscard]] LUMIS_HD constexpr MaskOf<R> is_squared_length(R squared) noexcept {
    return squared >= (std::numeric_limits<R>::min)() && squared <= (std::numeric_limits<R>::max)();
}

// Whether no component is NaN or infinite, nor so large that their sum is.
template <Real R>
[[nodiscard]] LUMIS_HD constexpr MaskOf<R> all_finite(const glm::vec<3, R>& v) noexcept {
    return real::abs(v.x) + real::abs(v.y) + real::abs(v.z) <= (std::numeric_limits<R>::max)();
}

// A local direction above the horizon stays as it is. One below it, and what is no direction (NaN, or of a length whose
// square is out of range), becomes the zero vector, from which nothing is drawn. It is asserted to be a unit vector; a
// longer or shorter one is scaled to one.
template <Real R>
[[nodiscard]] LUMIS_HD constexpr Direction<R> above_horizon_or_zero(const Direction<R>& wo) noexcept {
    LUMIS_ASSERT(real::all(detail::is_unit(wo)));
    const Direction<R> unit = detail::unit_or(wo, scalar_of<R>(0));
    const auto above = unit.z > 0;
    if (real::all(above)) return unit;
    return real::select(above, unit, Direction<R>{R(0)});
}

}  // namespace lumis::LUMIS_ISA
