// What a strategy draws: a point, and the density with which it was drawn.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <concepts>
#include <limits>

namespace lumis {

// A unit vector that points away from the shaded point.
template <std::floating_point T>
using Direction = glm::vec<3, T>;

// pdf == 0 means that nothing was drawn: the value is then unspecified but finite.
template <class Point, std::floating_point Scalar>
struct Sample {
    Point value{};
    Scalar pdf{};
};

// A sample of a light: also how far away the light is along the direction; infinity for an environment.
template <class Point, std::floating_point Scalar>
struct LightSample {
    Point value{};
    Scalar pdf{};
    Scalar distance{};
};

// The policy for densities in one line: a positive finite number stays, everything else (NaN too) is "nothing drawn".
template <std::floating_point T>
[[nodiscard]] constexpr T density_or_zero(T pdf) noexcept {
    return pdf > 0 && pdf <= std::numeric_limits<T>::max() ? pdf : T(0);
}

// Whether a squared length has all its digits: then it is that of a vector which can be made a unit one.
template <std::floating_point T>
[[nodiscard]] constexpr bool is_squared_length(T squared) noexcept {
    return squared >= std::numeric_limits<T>::min() && squared <= std::numeric_limits<T>::max();
}

// Whether no component is NaN or infinite.
template <std::floating_point T>
[[nodiscard]] constexpr bool all_finite(const glm::vec<3, T>& v) noexcept {
    constexpr T largest = std::numeric_limits<T>::max();
    return v.x >= -largest && v.x <= largest && v.y >= -largest && v.y <= largest && v.z >= -largest && v.z <= largest;
}

}  // namespace lumis
