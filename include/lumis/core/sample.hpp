// What a strategy draws: a point, and the density with which it was drawn.
#pragma once

#include "lumis/core/real.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <concepts>
#include <limits>

namespace lumis {

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

// The policy for densities in one line: a positive finite number stays, everything else (NaN too) is "nothing drawn".
template <Real R>
[[nodiscard]] constexpr R density_or_zero(R pdf) noexcept {
    return real::select(pdf > 0 && pdf <= std::numeric_limits<R>::max(), pdf, 0);
}

// Whether a squared length has all its digits: then it is that of a vector which can be made a unit one.
template <Real R>
[[nodiscard]] constexpr MaskOf<R> is_squared_length(R squared) noexcept {
    return squared >= std::numeric_limits<R>::min() && squared <= std::numeric_limits<R>::max();
}

// Whether no component is NaN or infinite.
template <Real R>
[[nodiscard]] constexpr MaskOf<R> all_finite(const glm::vec<3, R>& v) noexcept {
    const R none = (v.x - v.x) + (v.y - v.y) + (v.z - v.z);  // NaN if one of them is
    return none <= 0;
}

// A local direction above the horizon as it is, else the zero vector, which sees nothing; so for what is no direction.
template <std::floating_point T>
[[nodiscard]] constexpr Direction<T> above_horizon_or_zero(const Direction<T>& wo) noexcept {
    return wo.z > 0 && is_squared_length(wo.x * wo.x + wo.y * wo.y + wo.z * wo.z) ? wo : Direction<T>{T(0)};
}

}  // namespace lumis
