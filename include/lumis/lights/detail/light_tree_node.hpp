// A node of a light tree, and how it deals its counts out to its children as seen from a point.
//
// The tree is four wide: a node keeps the bounds of its children side by side, so that they are looked at in lanes, and half as
// many nodes lie on a path as in a tree of pairs.
//
// Counts are whole lattice points of the uniform (see cumulative_counts.hpp). The root has all of them; each node divides its
// own among its children, in their order and in proportion to their importance. A light's probability is the counts that reach
// it over all counts: the one drawn, exactly. A child that may light the point gets a count for each of its lights at least, so
// that no light that can contribute is left without.
#pragma once

#include "lumis/core/lanes.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/sample.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace lumis::LUMIS_ISA::detail {

inline constexpr std::size_t light_tree_width = 4;

//     child   | is a light: bit 31 | index of the light, or of the node: bits 0 to 30 |
template <std::floating_point T>
struct LightTreeNode {
    static constexpr std::uint32_t light_bit = std::uint32_t{1} << 31;
    template <class X>
    using OfChildren = std::array<X, light_tree_width>;

    OfChildren<T> center[3], half[3];  // of the boxes: their middle, and half of their extent
    OfChildren<T> axis[3], cos_cone;   // the normals are within this cone
    OfChildren<T> against;    // the factor of the cosine to the axis on the other side: -1 if that emits, else 1
    OfChildren<T> intensity;  // the sum over the tree is 1; 0 for a child that is none
    OfChildren<std::uint32_t> lights, child;
};

// The point that is lit. Lengths times `scale` are at most about 1.
template <std::floating_point T>
struct LitPoint {
    glm::vec<3, T> position;
    Direction<T> normal;
    T scale;
    bool has_normal;
};

// The mean of max(0, h) for heights h that lie evenly in height -+ reach. Where the middle is below 0 a quarter of the highest
// stands for it, which is more: a bright light may be all that is up there.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline R mean_above(R height, R reach) noexcept {
    const R highest = height + reach;
    const R even = highest * highest / (4 * real::divisor_where(height > 0 && height < reach, reach));
    return real::select(height >= reach, height, real::select(height > 0, even, R(highest / 4)));
}

// The same of |h|.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline R mean_off(R height, R reach) noexcept {
    const R off = real::abs(height);
    const R even = (off * off + reach * reach) / (2 * real::divisor_where(off < reach, reach));
    return real::select(off < reach, even, off);
}

// What each child sends to the point: intensity cos(theta) cos(theta_i) / d^2, as in Conty Estevez and Kulla 2018, equation 3.
// They take the least angles that the bounds allow, and the distance to the middle but no less than the radius r, half of the
// box's diagonal. That makes too much of wide boxes and too little of those around the point. Here all three are means over
// the box. 1 / (d^2 + r^2 / 5) stands for the mean of 1 / distance^2: at its middle, a ball of the volume of a cube has
// 1 / (0.171 r^2). The cosines are mean heights above the horizon and above the light's plane, over the distance.
// 0 only where no point of the box lies above the horizon, or the point lies behind all planes that box and cone allow.
// R: lanes of all children, or the number of one, the child'th.
template <Real R, std::floating_point T>
[[nodiscard]] LUMIS_INLINE inline R importance(const LightTreeNode<T>& node, const LitPoint<T>& at,
                                               [[maybe_unused]] std::size_t child) noexcept {
    using Vector = glm::vec<3, R>;
    constexpr T least = (std::numeric_limits<T>::min)(), epsilon = std::numeric_limits<T>::epsilon();
    constexpr T least_squared = std::same_as<T, float> ? T(0x1p-60) : T(0x1p-500);  // its inverse can be squared
    constexpr T least_cosine = T(1e-3);                                             // where the bounds hardly allow one
    const auto of_children = [&](const std::array<T, light_tree_width>& x) -> R {
        if constexpr (std::floating_point<R>) {
            return x[child];
        } else {
            return R::load(x.data());
        }
    };
    const auto vector = [&](const auto& x) { return Vector{of_children(x[0]), of_children(x[1]), of_children(x[2])}; };

    const Vector to_center = real::rounded(vector(node.center) - Vector(at.position)) * R(at.scale);
    const Vector half = vector(node.half) * R(at.scale);
    const auto reach_along = [&](const Vector& n) {
        return R(real::abs(n.x) * half.x + real::abs(n.y) * half.y + real::abs(n.z) * half.z);
    };
    const R squared =
        real::greater(R(real::dot(to_center, to_center) + T(0.2) * real::dot(half, half)), R(least_squared));
    const R distance = real::sqrt(squared), inverse_squared = 1 / squared;
    const R farthest = T(2.45) * distance;  // (d + r)^2 <= 6 (d^2 + r^2 / 5)
    const R rounding = 32 * epsilon * farthest;

    // How far the point is in front of the plane across the axis, and by how much other normals and places change that.
    const Vector axis = vector(node.axis);
    const R cos_cone = of_children(node.cos_cone), against = of_children(node.against);
    const R sin_cone = real::select(cos_cone > 0, real::sqrt_or_zero(R(1 - cos_cone * cos_cone)), T(1));
    const R in_front = -real::dot(axis, to_center), reach = reach_along(axis), spread = reach + sin_cone * distance;
    const auto faces = against < 0 || cos_cone <= 0 || in_front + (reach + sin_cone * farthest) > -rounding;
    const R mean =
        real::lesser(real::select(against < 0, mean_off(in_front, spread), mean_above(in_front, spread)), distance);
    const R mean_of_wide = real::select(cos_cone < 0, R(mean - cos_cone * (distance - mean)), mean);
    const R intensity = of_children(node.intensity);
    const R least_height = least_cosine * distance;
    R weight = intensity * inverse_squared * real::greater(mean_of_wide, least_height);
    auto reached = intensity > 0 && faces;

    if (at.has_normal) {
        const Vector normal(at.normal);
        const R height = real::dot(normal, to_center), reach_up = reach_along(normal);
        const R mean_height = real::lesser(mean_above(height, reach_up), distance);
        weight *= inverse_squared * real::greater(mean_height, least_height);
        reached = reached && height + reach_up > -rounding;
    } else {
        weight *= inverse_squared * distance;
    }
    return real::select(reached, real::greater(weight, R(least)), T(0));
}

template <std::floating_point T>
[[nodiscard]] LUMIS_INLINE inline std::array<T, light_tree_width> importances(const LightTreeNode<T>& node,
                                                                              const LitPoint<T>& at) noexcept {
    std::array<T, light_tree_width> result;
#ifdef LUMIS_HAS_VECTORS
    importance<Lanes<T, light_tree_width>>(node, at, 0).store(result.data());
#else
    for (std::size_t i = 0; i < light_tree_width; ++i) result[i] = importance<T>(node, at, i);
#endif
    return result;
}

// The ends of each child's counts; all 0 if none can light the point. A call, so that sampling and density compute the same to
// the last bit.
template <std::floating_point T>
[[nodiscard]] LUMIS_NOINLINE std::array<std::uint64_t, light_tree_width> deal_to_children(
    const LightTreeNode<T>& node, const LitPoint<T>& at, std::uint64_t counts) noexcept {
    std::array<T, light_tree_width> sum = importances(node, at);
    std::array<std::uint64_t, light_tree_width>
        ends{};  // the one that is returned: g++ would copy another by slow loads
    T total = 0;
    std::uint32_t lights = 0;
    for (std::size_t i = 0; i < light_tree_width; ++i) {
        lights += node.lights[i] & (0 - std::uint32_t{sum[i] > 0});  // no branch, half of which would be guessed wrong
        ends[i] = lights;
        sum[i] = total += sum[i];
    }
    if (!(total > 0)) return ends;
    // All of the counts from the last child on that has a weight: a quotient may be beside 1 (-freciprocal-math).
    const std::uint64_t spare = counts - lights;
    const auto spare_counts = static_cast<double>(static_cast<std::int64_t>(spare));
    for (std::size_t i = 0; i < light_tree_width; ++i) {
        const double share = static_cast<double>(real::divide(sum[i], total));
        const auto dealt = static_cast<std::uint64_t>(static_cast<std::int64_t>(share * spare_counts));
        ends[i] += sum[i] < total && dealt < spare ? dealt : spare;
    }
    return ends;
}

}  // namespace lumis::LUMIS_ISA::detail
