// What is asserted of a caller's arguments, and what is made of wrong ones where assertions are compiled out: a vector that
// should be a unit one is scaled to it, so that what is drawn stays what the density says.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <concepts>
#include <limits>

namespace lumis::LUMIS_ISA::detail {

// Quiet: comparing a NaN for equality raises no exception.
template <Real T>
[[nodiscard]] LUMIS_HD constexpr MaskOf<T> is_nan(T x) noexcept {
    return !(x == x);
}
template <Real T>
[[nodiscard]] LUMIS_HD constexpr MaskOf<T> is_nan(const glm::vec<2, T>& v) noexcept {
    return is_nan(v.x) || is_nan(v.y);
}
template <Real T>
[[nodiscard]] LUMIS_HD constexpr MaskOf<T> is_nan(const glm::vec<3, T>& v) noexcept {
    return is_nan(v.x) || is_nan(v.y) || is_nan(v.z);
}

// By how much a unit vector's squared length may differ from 1. A normal passes that was scaled by a reciprocal square root
// of 12 bits (7e-4), or is kept in half precision (1e-3). The same in double, where vectors are often made of floats.
inline constexpr float unit_tolerance = 1e-3f;

template <Real T>
[[nodiscard]] LUMIS_HD constexpr T dot(const glm::vec<3, T>& a, const glm::vec<3, T>& b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <Real T>
[[nodiscard]] LUMIS_HD constexpr T squared(T x) noexcept {
    return x * x;
}

template <Real T>
[[nodiscard]] LUMIS_HD constexpr MaskOf<T> is_unit(const glm::vec<3, T>& v) noexcept {
    return squared(dot(v, v) - 1) <= squared(scalar_of<T>(unit_tolerance));
}

// A cosine between two vectors counts ten times as much as what a squared length is off by, as it does in densities: at a
// cosine of 1e-4, that of GGX with roughness 0.1 is off by 0.2 %. A frame may be left-handed, which mirrored texture
// coordinates make it.
template <Real T>
[[nodiscard]] LUMIS_HD constexpr MaskOf<T> are_orthonormal(const glm::vec<3, T>& a, const glm::vec<3, T>& b,
                                                           const glm::vec<3, T>& c) noexcept {
    const T lengths = squared(dot(a, a) - 1) + squared(dot(b, b) - 1) + squared(dot(c, c) - 1);
    const T cosines = squared(dot(a, b)) + squared(dot(b, c)) + squared(dot(c, a));
    return lengths + 100 * cosines <= squared(scalar_of<T>(unit_tolerance));
}

// A unit vector as it is, any other scaled to unit length; (none, none, none) if it has no direction. The argument is by
// value: one by reference would have to be in memory wherever this function could be called.
template <Real T>
[[nodiscard]] LUMIS_COLD glm::vec<3, T> scaled_to_unit(glm::vec<3, T> v, scalar_of<T> none) noexcept {
    const T longest = real::greater(real::greater(real::abs(v.x), real::abs(v.y)), real::abs(v.z));
    const auto has_direction =
        !is_nan(v) && longest >= (std::numeric_limits<T>::min)() && longest <= (std::numeric_limits<T>::max)();
    if (!real::any(has_direction)) return glm::vec<3, T>{T(none)};
    const glm::vec<3, T> scaled = real::divide(v, real::divisor_where(has_direction, longest));
    const glm::vec<3, T> unit = real::divide(scaled, real::length(scaled));
    return real::select(is_unit(v), v, real::select(has_direction, unit, glm::vec<3, T>{T(none)}));
}

template <Real T>
[[nodiscard]] LUMIS_INLINE constexpr glm::vec<3, T> unit_or(const glm::vec<3, T>& v, scalar_of<T> none) noexcept {
    if (real::all(is_unit(v))) [[likely]]
        return v;
    return scaled_to_unit(v, none);
}

}  // namespace lumis::LUMIS_ISA::detail
