// The shapes a light can have, in world space. Flat shapes count from both sides: whether a light emits from its back is
// the host's business. A sphere seen from outside is hidden behind its own front.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"

#include <concepts>

namespace lumis {

template <std::floating_point T = float>
struct Triangle {
    using Scalar = T;
    glm::vec<3, T> a, b, c;
};

// The points corner + s edge_u + t edge_v for s, t in [0, 1].
template <std::floating_point T = float>
struct Parallelogram {
    using Scalar = T;
    glm::vec<3, T> corner, edge_u, edge_v;
};

// normal: of any length.
template <std::floating_point T = float>
struct Disk {
    using Scalar = T;
    glm::vec<3, T> center, normal;
    T radius;
};

template <std::floating_point T = float>
struct Sphere {
    using Scalar = T;
    glm::vec<3, T> center;
    T radius;
};

namespace detail {

// Whether any coordinate of a shape is NaN.
template <std::floating_point T>
[[nodiscard]] LUMIS_HD constexpr bool is_nan(const Triangle<T>& shape) noexcept {
    return is_nan(shape.a) || is_nan(shape.b) || is_nan(shape.c);
}
template <std::floating_point T>
[[nodiscard]] LUMIS_HD constexpr bool is_nan(const Parallelogram<T>& shape) noexcept {
    return is_nan(shape.corner) || is_nan(shape.edge_u) || is_nan(shape.edge_v);
}
template <std::floating_point T>
[[nodiscard]] LUMIS_HD constexpr bool is_nan(const Disk<T>& shape) noexcept {
    return is_nan(shape.center) || is_nan(shape.normal) || is_nan(shape.radius);
}
template <std::floating_point T>
[[nodiscard]] LUMIS_HD constexpr bool is_nan(const Sphere<T>& shape) noexcept {
    return is_nan(shape.center) || is_nan(shape.radius);
}

}  // namespace detail

template <std::floating_point T>
Triangle(glm::vec<3, T>, glm::vec<3, T>, glm::vec<3, T>) -> Triangle<T>;
template <std::floating_point T>
Parallelogram(glm::vec<3, T>, glm::vec<3, T>, glm::vec<3, T>) -> Parallelogram<T>;
template <std::floating_point T>
Disk(glm::vec<3, T>, glm::vec<3, T>, T) -> Disk<T>;
template <std::floating_point T>
Sphere(glm::vec<3, T>, T) -> Sphere<T>;

}  // namespace lumis
