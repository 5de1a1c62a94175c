// The shapes a light can have, in world space, each with a geometric normal and coordinates (u, v) of its points.
// A sphere seen from outside is hidden behind its own front.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"

#include <concepts>

namespace lumis::LUMIS_ISA {

// The sides from which a light is seen: both, or only the one to which the geometric normal points.
// Behind a light of one side, or inside such a sphere, nothing is drawn and every density is 0.
enum class Sides { Both, One };

// Normal: along (b - a) x (c - a). Coordinates: barycentric, (u, v) is the point (1 - u - v) a + u b + v c.
template <Real T = float>
struct Triangle {
    using Scalar = T;
    glm::vec<3, T> a, b, c;
};

// The points corner + u edge_u + v edge_v for (u, v) in [0, 1]^2. Normal: along edge_u x edge_v.
template <Real T = float>
struct Parallelogram {
    using Scalar = T;
    glm::vec<3, T> corner, edge_u, edge_v;
};

// normal: of any length. Coordinates: u is the squared distance from the centre in radii, v a fraction of a turn from the
// tangent of Frame{unit normal} towards its bitangent; so (u, v) in [0, 1]^2 is even over the area.
template <Real T = float>
struct Disk {
    using Scalar = T;
    glm::vec<3, T> center, normal;
    T radius;

    Disk() = default;
    // The vectors decide on the scalar: a radius of another type is converted.
    template <std::convertible_to<T> Radius>
    LUMIS_HD constexpr Disk(const glm::vec<3, T>& center_, const glm::vec<3, T>& normal_, Radius radius_) noexcept
        : center{center_}, normal{normal_}, radius(static_cast<T>(radius_)) {}
};

// Normal: outward. Coordinates: u is (1 - cos(theta)) / 2 with the polar angle theta of the normal from +z, v a fraction of a
// turn from +x towards +y; so (u, v) in [0, 1]^2 is even over the area.
template <Real T = float>
struct Sphere {
    using Scalar = T;
    glm::vec<3, T> center;
    T radius;

    Sphere() = default;
    template <std::convertible_to<T> Radius>
    LUMIS_HD constexpr Sphere(const glm::vec<3, T>& center_, Radius radius_) noexcept
        : center{center_}, radius(static_cast<T>(radius_)) {}
};

namespace detail {

// Whether any coordinate of a shape is NaN.
template <Real T>
[[nodiscard]] LUMIS_HD constexpr MaskOf<T> is_nan(const Triangle<T>& shape) noexcept {
    return is_nan(shape.a) || is_nan(shape.b) || is_nan(shape.c);
}
template <Real T>
[[nodiscard]] LUMIS_HD constexpr MaskOf<T> is_nan(const Parallelogram<T>& shape) noexcept {
    return is_nan(shape.corner) || is_nan(shape.edge_u) || is_nan(shape.edge_v);
}
template <Real T>
[[nodiscard]] LUMIS_HD constexpr MaskOf<T> is_nan(const Disk<T>& shape) noexcept {
    return is_nan(shape.center) || is_nan(shape.normal) || is_nan(shape.radius);
}
template <Real T>
[[nodiscard]] LUMIS_HD constexpr MaskOf<T> is_nan(const Sphere<T>& shape) noexcept {
    return is_nan(shape.center) || is_nan(shape.radius);
}

}  // namespace detail

template <Real T>
Triangle(glm::vec<3, T>, glm::vec<3, T>, glm::vec<3, T>) -> Triangle<T>;
template <Real T>
Parallelogram(glm::vec<3, T>, glm::vec<3, T>, glm::vec<3, T>) -> Parallelogram<T>;

}  // namespace lumis::LUMIS_ISA
