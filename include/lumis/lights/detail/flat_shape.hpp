// A triangle or parallelogram relative to a reference point: a corner, and the two edges from it.
#pragma once

#include "lumis/core/assert.hpp"
#include "lumis/core/detail/arguments.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/lights/detail/wide.hpp"
#include "lumis/lights/shapes.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace lumis::LUMIS_ISA::detail {

template <Real T>
[[nodiscard]] LUMIS_HD T longest_component(const glm::vec<3, T>& v) noexcept {
    return real::greater(real::greater(real::abs(v.x), real::abs(v.y)), real::abs(v.z));
}

// The largest power of two that is not above x, but at least the smallest normal number.
template <Real T>
[[nodiscard]] LUMIS_HD T power_of_two(T x) noexcept {
    if constexpr (std::floating_point<T>) {
        using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
        constexpr Bits sign = Bits{1} << (8 * sizeof(T) - 1),
                       exponent = sign - (Bits{1} << (std::numeric_limits<T>::digits - 1));
        T power = real::greater((std::numeric_limits<T>::min)(), x);
        Bits bits;  // std::bit_cast is not in every standard library
        std::memcpy(&bits, &power, sizeof bits);
        bits &= exponent;
        std::memcpy(&power, &bits, sizeof bits);
        return power;
    } else {
        return T::of_lanes([&](auto i) { return power_of_two(x[i]); });
    }
}

// Products and differences as rounded: of two vectors nearly in line the differences are all that is left, and of two in
// line they are 0.
template <Real T>
[[nodiscard]] LUMIS_INLINE inline glm::vec<3, T> cross(const glm::vec<3, T>& a, const glm::vec<3, T>& b) noexcept {
    return {real::rounded(T(real::product(a.y, b.z) - real::product(a.z, b.y))),
            real::rounded(T(real::product(a.z, b.x) - real::product(a.x, b.z))),
            real::rounded(T(real::product(a.x, b.y) - real::product(a.y, b.x)))};
}

// Vertices are taken relative to the reference point before anything else, and edges before that, so that a scene far from
// its origin loses no more than its coordinates have lost already.
template <class Shape>
struct FlatShape {
    using Scalar = typename Shape::Scalar;
    using Wide = detail::Wide<Scalar>;
    using Vector = glm::vec<3, Wide>;
    static constexpr bool has_unit = std::same_as<Wide, Scalar>;
    static constexpr bool is_triangle = std::same_as<Shape, Triangle<Scalar>>;

    struct Edges {
        Vector corner, edge_u, edge_v;
    };

    // The scene's coordinates.
    Edges in_scene;
    Wide unit{1};

    // In a unit near the longest edge where Scalar is double, as squares of tiny or huge edges would leave its range. The
    // unit is a power of two, which rounds nothing.
    [[nodiscard]] LUMIS_INLINE const Edges& in_units() const noexcept {
        if constexpr (has_unit) {
            return scaled_;
        } else {
            return in_scene;
        }
    }

    LUMIS_INLINE FlatShape(const Shape& shape, const glm::vec<3, Scalar>& reference_point) noexcept requires is_triangle
        : FlatShape{difference(shape.a, reference_point), difference(shape.b, shape.a), difference(shape.c, shape.a)} {
        LUMIS_ASSERT(real::all(!is_nan(shape) && !is_nan(reference_point)));
    }

    LUMIS_INLINE FlatShape(const Shape& shape, const glm::vec<3, Scalar>& reference_point) noexcept
        requires(!is_triangle)
        : FlatShape{difference(shape.corner, reference_point), Vector(shape.edge_u), Vector(shape.edge_v)} {
        LUMIS_ASSERT(real::all(!is_nan(shape) && !is_nan(reference_point)));
    }

    // The same seen from one side: without edges from behind, whence it draws nothing.
    [[nodiscard]] LUMIS_INLINE FlatShape facing(Sides sides) const noexcept {
        if (sides == Sides::Both) return *this;
        const auto& [corner, u, v] = in_units();
        const auto behind = glm::dot(corner, cross(u, v)) > 0;
        const auto hide = [&](Edges& edges) {
            edges.edge_u = real::select(behind, Vector{Wide(0)}, edges.edge_u);
            edges.edge_v = real::select(behind, Vector{Wide(0)}, edges.edge_v);
        };
        FlatShape seen{*this};
        hide(seen.in_scene);
        if constexpr (has_unit) hide(seen.scaled_);
        return seen;
    }

  private:
    LUMIS_INLINE FlatShape(const Vector& corner, const Vector& u, const Vector& v) noexcept : in_scene{corner, u, v} {
        if constexpr (has_unit) {
            // Not so small that the square of the corner would leave its range: then the shape subtends nothing.
            const Wide least = longest_component(corner) * scalar_of<Wide>(0x1p-500);
            const Wide longest = real::greater(longest_component(u), longest_component(v));
            unit = power_of_two(real::greater(longest, least));
            const Wide inverse = 1 / unit;
            scaled_ = {corner * inverse, u * inverse, v * inverse};
        }
    }

    LUMIS_HD static Vector difference(const glm::vec<3, Scalar>& to, const glm::vec<3, Scalar>& from) noexcept {
        return real::rounded(Vector(to) - Vector(from));
    }

    struct None {};
    [[no_unique_address]] std::conditional_t<has_unit, Edges, None> scaled_;
};

// Whether a parallelogram's edges are at right angles; up to the rounding of T, unless the reference point is so close by that such
// a shear shows.
template <std::floating_point T>
[[nodiscard]] LUMIS_HD bool is_rectangle(const FlatShape<Parallelogram<T>>& shape) noexcept {
    const auto& [corner, edge_u, edge_v] = shape.in_units();
    const auto dot = glm::dot(edge_u, edge_v);
    if (dot == 0) return true;
    const auto u = real::length(edge_u), v = real::length(edge_v), volume = glm::dot(corner, cross(edge_u, edge_v));
    return std::abs(dot) <= 4 * std::numeric_limits<T>::epsilon() * u * v &&
           32 * std::abs(volume) >= u * v * real::greater(u, v);
}

}  // namespace lumis::LUMIS_ISA::detail
