// Densities of points that a host has found itself: what of a light they need, and no more. In double where Scalar is float.
#pragma once

#include "lumis/core/measure.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/lights/area_light_by_solid_angle.hpp"
#include "lumis/lights/detail/flat_shape.hpp"
#include "lumis/lights/detail/wide.hpp"
#include "lumis/lights/shapes.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

namespace lumis::LUMIS_ISA::detail {

// The area of a triangle or parallelogram; 0 from behind, if it is seen from one side.
template <class Shape>
[[nodiscard]] LUMIS_INLINE inline Wide<typename Shape::Scalar> seen_area(const FlatShape<Shape>& shape,
                                                                         Sides sides) noexcept {
    using W = typename FlatShape<Shape>::Wide;
    const auto& [corner, u, v] = shape.in_units();
    const auto normal = cross(u, v);
    const W area = real::length(normal) * shape.unit * shape.unit * scalar_of<W>(shape.is_triangle ? 0.5 : 1);
    return sides == Sides::Both ? area : real::select(glm::dot(corner, normal) > 0, W(0), area);
}

// A point of a surface with an area, drawn evenly: distance^2 / (area |cos_light|).
template <Real T>
[[nodiscard]] LUMIS_INLINE inline T density_by_area(Wide<T> area, T distance, T cos_light) noexcept {
    using W = Wide<T>;
    if constexpr (std::same_as<W, T>) {
        return area_to_solid_angle(real::quotient_where(area > 0, T(1), area), distance, cos_light);
    } else {
        const W d{distance}, projected = area * real::abs(W{cos_light});
        return density_or_zero(static_cast<T>(real::quotient_where(projected > 0, W(d * d), projected)));
    }
}

// Half the solid angle of a triangle as the angle of a complex number (Van Oosterom and Strackee 1983): the vertices' lengths
// times 1 + i tan(solid angle / 2). vertices: lengths |a|, |b|, |c|; dots a.b, b.c, c.a.
template <Real W>
struct HalfAngle {
    W real_part;
    // Unless both parts are differences next to 0, as where two vertices are nearly opposite to each other.
    bool has_digits;

    template <std::floating_point T>
    [[nodiscard]] LUMIS_INLINE static HalfAngle of(const glm::vec<3, W>& lengths, const glm::vec<3, W>& dots,
                                                   W volume) noexcept {
        // Rounding moves the angle by epsilon over this share: nothing to a float.
        constexpr W share = std::same_as<W, T> ? W(0.25) : W(1e-4);
        const W product = lengths.x * lengths.y * lengths.z;
        const W part = product + dots.x * lengths.z + dots.y * lengths.x + dots.z * lengths.y;
        return {part, volume + std::abs(part) >= share * product && product >= (std::numeric_limits<W>::min)()};
    }
};

// Where the short way has no digits.
template <class Shape, class T>
[[nodiscard]] LUMIS_COLD T density_of_light(const Shape& shape, const glm::vec<3, T>& reference_point,
                                            Sides sides) noexcept {
    return AreaLight<Shape, BySolidAngle>{shape, reference_point, sides}.pdf_from_hit(T(0), T(0));
}

// Whether products of six lengths stay in range: of a shape that is seen from as far as 2^160 of its edges away.
template <class W>
[[nodiscard]] LUMIS_INLINE inline bool is_in_reach(W length) noexcept {
    return length <= W(0x1p160);
}

// 1 / solid angle, for an angle whose half is that of (x, y).
template <std::floating_point T, class W>
[[nodiscard]] LUMIS_INLINE inline T density_of_half_angle(W x, W y) noexcept {
    const W turn = signed_turn_of(x, y);
    return density_or_zero(static_cast<T>(real::quotient_where(turn > 0, std::numbers::inv_pi_v<W> / 4, turn)));
}

template <std::floating_point T>
[[nodiscard]] LUMIS_INLINE inline T density_by_solid_angle(const Triangle<T>& triangle,
                                                           const glm::vec<3, T>& reference_point,
                                                           Sides sides) noexcept {
    using W = Wide<T>;
    const FlatShape<Triangle<T>> shape{triangle, reference_point};
    const auto& [a, ab, ac] = shape.in_units();
    const auto b = a + ab, c = a + ac;
    const W aa = real::length(a);
    if (!is_in_reach(aa)) [[unlikely]]
        return density_of_light(triangle, reference_point, sides);
    const W signed_volume = glm::dot(cross(a, ab), ac), volume = std::abs(signed_volume);
    const glm::vec<3, W> lengths{aa, real::length(b), real::length(c)};
    const auto half = HalfAngle<W>::template of<T>(lengths, {glm::dot(a, b), glm::dot(b, c), glm::dot(c, a)}, volume);
    if (!half.has_digits) [[unlikely]]
        return density_of_light(triangle, reference_point, sides);
    if (!(sides == Sides::One ? signed_volume < 0 : volume > 0)) return T(0);
    return density_of_half_angle<T>(half.real_part, volume);
}

// Multiplies the half angles of both triangles at the diagonal as complex numbers. The two triangles have the same volume.
template <std::floating_point T>
[[nodiscard]] LUMIS_INLINE inline T density_by_solid_angle(const Parallelogram<T>& parallelogram,
                                                           const glm::vec<3, T>& reference_point,
                                                           Sides sides) noexcept {
    using W = Wide<T>;
    const FlatShape<Parallelogram<T>> shape{parallelogram, reference_point};
    const auto& [a, u, v] = shape.in_units();
    const auto b = a + u, c = a + (u + v), d = a + v;
    const W aa = real::length(a);
    if (!is_in_reach(aa)) [[unlikely]]
        return density_of_light(parallelogram, reference_point, sides);
    const W signed_volume = glm::dot(cross(a, u), v), volume = std::abs(signed_volume);
    const W bb = real::length(b), cc = real::length(c), dd = real::length(d), ac = glm::dot(a, c);
    const auto abc = HalfAngle<W>::template of<T>({aa, bb, cc}, {glm::dot(a, b), glm::dot(b, c), ac}, volume);
    const auto acd = HalfAngle<W>::template of<T>({aa, cc, dd}, {ac, glm::dot(c, d), glm::dot(d, a)}, volume);
    const W x = abc.real_part * acd.real_part - volume * volume, y = volume * (abc.real_part + acd.real_part);
    if (!(abc.has_digits && acd.has_digits && std::abs(x) + std::abs(y) >= (std::numeric_limits<W>::min)()))
        [[unlikely]]
        return density_of_light(parallelogram, reference_point, sides);
    if (!(sides == Sides::One ? signed_volume < 0 : volume > 0)) return T(0);
    return density_of_half_angle<T>(x, y);
}

// What of a sphere is seen: nothing from its surface, and nothing that is out of range, as in SphereView.
template <Real T>
struct SeenSphere {
    T distance, tangent_squared;
    MaskOf<T> inside, seen;

    LUMIS_INLINE SeenSphere(const Sphere<T>& sphere, const glm::vec<3, T>& reference_point, Sides sides) noexcept {
        const glm::vec<3, Wide<T>> center{real::rounded(sphere.center - reference_point)};
        const Wide<T> squared = glm::dot(center, center), r{sphere.radius};
        distance = real::sqrt(static_cast<T>(squared));
        tangent_squared = static_cast<T>(real::rounded(Wide<T>(squared - r * r)));
        inside = tangent_squared < 0;
        const auto outside = tangent_squared > 0 && is_squared_length(T(distance * distance));
        seen = (outside || (inside && MaskOf<T>(sides == Sides::Both))) && sphere.radius > 0 &&
               sphere.radius <= (std::numeric_limits<T>::max)();
    }
};

// 1 / (2 pi versine), where the cone's versine is (r / d)^2 / (1 + sqrt(1 - (r / d)^2)): so one division does.
template <Real T>
[[nodiscard]] LUMIS_INLINE inline T density_by_solid_angle(const Sphere<T>& sphere,
                                                           const glm::vec<3, T>& reference_point,
                                                           Sides sides) noexcept {
    constexpr auto inverse_turn = std::numbers::inv_pi_v<scalar_of<T>> / 2;
    const SeenSphere<T> seen{sphere, reference_point, sides};
    const T inverse = real::quotient_where(seen.seen, T(1), sphere.radius);
    const T tangent = real::sqrt_or_zero(seen.tangent_squared);
    const T outside = (seen.distance * inverse) * ((seen.distance + tangent) * inverse) * inverse_turn;
    return real::select(seen.seen, real::select(seen.inside, T(inverse_turn / 2), density_or_zero(outside)), 0);
}

}  // namespace lumis::LUMIS_ISA::detail
