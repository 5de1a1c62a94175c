// What a light tree knows of a light: where it is, how it faces, and how bright it is. World space.
// Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting", section 4.1: a box, and a
// cone about an axis that holds the normals. A point of the light emits into the hemisphere about its normal.
#pragma once

#include "lumis/core/assert.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/lights/detail/flat_shape.hpp"
#include "lumis/lights/detail/wide.hpp"
#include "lumis/lights/shapes.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <type_traits>

namespace lumis::LUMIS_ISA {

// lower, upper: corners of a box that holds the light; equal ones for a light at a point.
// intensity: the most that the light sends in any direction, for example in watts per steradian; all lights of a tree use the
// same unit. An area light's is its radiance times the largest area that it shows. 0: the light is never drawn.
// axis: of any length. cos_cone: of the cone about it that holds the normals; -1 for normals in every direction.
// sides: Both if the light also emits against its normals.
template <std::floating_point T = float>
struct LightBounds {
    using Scalar = T;
    glm::vec<3, T> lower{}, upper{};
    T intensity{};
    Direction<T> axis{T(0), T(0), T(1)};
    T cos_cone{-1};
    Sides sides{Sides::Both};
};

namespace detail {

// The box of center -+ half, each side moved outward by what rounding may have taken from it. magnitude: of what was added up.
template <std::floating_point T, std::floating_point W>
void set_box(LightBounds<T>& bounds, const glm::vec<3, W>& lower, const glm::vec<3, W>& upper,
             const glm::vec<3, W>& magnitude) noexcept {
    constexpr T far_out = (std::numeric_limits<T>::max)();
    for (int k = 0; k < 3; ++k) {
        const W margin = 4 * std::numeric_limits<W>::epsilon() * magnitude[k];
        const W low = lower[k] - margin, high = upper[k] + margin;
        bounds.lower[k] = static_cast<T>(low);
        bounds.upper[k] = static_cast<T>(high);
        if (!(static_cast<W>(bounds.lower[k]) <= low)) bounds.lower[k] = std::nextafter(bounds.lower[k], -far_out);
        if (!(static_cast<W>(bounds.upper[k]) >= high)) bounds.upper[k] = std::nextafter(bounds.upper[k], far_out);
    }
}

template <std::floating_point T>
[[nodiscard]] glm::vec<3, Wide<T>> magnitude(const glm::vec<3, T>& v) noexcept {
    return {std::abs(Wide<T>(v.x)), std::abs(Wide<T>(v.y)), std::abs(Wide<T>(v.z))};
}

// A flat light: its vertices lie between the corner, and it plus either edge or both.
template <std::floating_point T, class Shape>
[[nodiscard]] LightBounds<T> flat_bounds(const Shape& shape, const glm::vec<3, T>& corner, T radiance, Sides sides) {
    using W = Wide<T>;
    using Vector = glm::vec<3, W>;
    const FlatShape<Shape> edges{shape, glm::vec<3, T>{T(0)}};
    const Vector start(corner), u = edges.in_scene.edge_u, v = edges.in_scene.edge_v;
    Vector lower{start}, upper{start};
    for (int k = 0; k < 3; ++k) {
        const W both = FlatShape<Shape>::is_triangle ? W(0) : u[k] + v[k];
        lower[k] += real::lesser(real::lesser(W(0), both), real::lesser(u[k], v[k]));
        upper[k] += real::greater(real::greater(W(0), both), real::greater(u[k], v[k]));
    }
    LightBounds<T> result;
    set_box(
        result, lower, upper,
        Vector{magnitude(corner).x + std::abs(u.x) + std::abs(v.x), magnitude(corner).y + std::abs(u.y) + std::abs(v.y),
               magnitude(corner).z + std::abs(u.z) + std::abs(v.z)});
    const auto& [none, unit_u, unit_v] = edges.in_units();
    const Vector normal = cross(unit_u, unit_v);
    const W length = real::length(normal);
    if (!(length > 0)) return result;
    const W area = (FlatShape<Shape>::is_triangle ? length / 2 : length) * edges.unit * edges.unit;
    result.intensity = static_cast<T>(static_cast<W>(radiance) * area);
    result.axis = Direction<T>(normal / length);
    result.cos_cone = T(1);
    result.sides = sides;
    return result;
}

}  // namespace detail

// The bounds of an area light of a radiance (its largest, or its mean, if it varies). Shapes without area have intensity 0.
// A light of a shape of your own tells its bounds by filling in a LightBounds.
template <std::floating_point T>
[[nodiscard]] LightBounds<T> light_bounds(const Triangle<T>& shape, std::type_identity_t<T> radiance,
                                          Sides sides = Sides::Both) {
    return detail::flat_bounds(shape, shape.a, radiance, sides);
}
template <std::floating_point T>
[[nodiscard]] LightBounds<T> light_bounds(const Parallelogram<T>& shape, std::type_identity_t<T> radiance,
                                          Sides sides = Sides::Both) {
    return detail::flat_bounds(shape, shape.corner, radiance, sides);
}
template <std::floating_point T>
[[nodiscard]] LightBounds<T> light_bounds(const Disk<T>& shape, std::type_identity_t<T> radiance,
                                          Sides sides = Sides::Both) {
    using W = detail::Wide<T>;
    using Vector = glm::vec<3, W>;
    LUMIS_ASSERT(!detail::is_nan(shape));
    LightBounds<T> result{shape.center, shape.center};
    const Vector normal(shape.normal);
    const W length = real::length(normal), radius = static_cast<W>(shape.radius);
    if (!(is_squared_length(length * length) && radius > 0)) return result;
    const Vector n = normal / length, center(shape.center);
    const Vector reach = radius * Vector{std::hypot(n.y, n.z), std::hypot(n.z, n.x), std::hypot(n.x, n.y)};
    detail::set_box(result, Vector(center - reach), Vector(center + reach),
                    Vector(detail::magnitude(shape.center) + Vector(radius)));
    result.intensity = static_cast<T>(static_cast<W>(radiance) * std::numbers::pi_v<W> * radius * radius);
    result.axis = Direction<T>(n);
    result.cos_cone = T(1);
    result.sides = sides;
    return result;
}
// The same whichever sides emit: from inside it is seen all around.
template <std::floating_point T>
[[nodiscard]] LightBounds<T> light_bounds(const Sphere<T>& shape, std::type_identity_t<T> radiance,
                                          Sides = Sides::Both) {
    using W = detail::Wide<T>;
    using Vector = glm::vec<3, W>;
    LUMIS_ASSERT(!detail::is_nan(shape));
    LightBounds<T> result{shape.center, shape.center};
    const W radius = static_cast<W>(shape.radius);
    if (!(radius > 0)) return result;
    const Vector center(shape.center);
    detail::set_box(result, Vector(center - radius), Vector(center + radius),
                    Vector(detail::magnitude(shape.center) + Vector(radius)));
    result.intensity = static_cast<T>(static_cast<W>(radiance) * std::numbers::pi_v<W> * radius * radius);
    return result;
}

}  // namespace lumis::LUMIS_ISA
