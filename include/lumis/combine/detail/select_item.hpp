// One of two samples, of numbers or in each lane.
#pragma once

#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/core/surface_point.hpp"

#include <concepts>
#include <cstddef>

namespace lumis::LUMIS_ISA::detail {

// a where the condition holds, else b; select_item of what it was not written for is a call of the item's own select(condition,
// a, b), found by its argument. Samples of numbers are selected part by part, too: to copy one as a whole, g++ stores it
// by component first and waits for that.
template <class Mask, class Item>
[[nodiscard]] LUMIS_INLINE inline Item select_item(const Mask& condition, const Item& a, const Item& b) noexcept {
    if constexpr (requires { select(condition, a, b); }) {
        return select(condition, a, b);
    } else if constexpr (std::same_as<Mask, bool>) {
        return condition ? a : b;
    } else {
        return select_point(condition, a, b);
    }
}
template <class Mask, int N, Real R, glm::qualifier Q>
[[nodiscard]] LUMIS_INLINE inline glm::vec<N, R, Q> select_item(const Mask& condition, const glm::vec<N, R, Q>& a,
                                                                const glm::vec<N, R, Q>& b) noexcept {
    return select_point(condition, a, b);
}
template <class Mask, class Point, Real R>
[[nodiscard]] LUMIS_INLINE inline Sample<Point, R> select_item(const Mask& condition, const Sample<Point, R>& a,
                                                               const Sample<Point, R>& b) noexcept {
    return {select_item(condition, a.value, b.value), real::select(condition, a.pdf, b.pdf)};
}
template <class Mask, class Point, Real R>
[[nodiscard]] LUMIS_INLINE inline LightSample<Point, R> select_item(const Mask& condition,
                                                                    const LightSample<Point, R>& a,
                                                                    const LightSample<Point, R>& b) noexcept {
    return {select_item(condition, a.value, b.value), real::select(condition, a.pdf, b.pdf),
            real::select(condition, a.distance, b.distance)};
}
template <class Mask, class Point, Real R>
[[nodiscard]] LUMIS_INLINE inline SurfaceLightSample<Point, R> select_item(
    const Mask& condition, const SurfaceLightSample<Point, R>& a, const SurfaceLightSample<Point, R>& b) noexcept {
    return {select_item(condition, a.value, b.value), real::select(condition, a.pdf, b.pdf),
            real::select(condition, a.distance, b.distance), select(condition, a.surface, b.surface)};
}
template <class Mask, class Point, Real R>
[[nodiscard]] LUMIS_INLINE inline SurfaceAreaSample<Point, R> select_item(
    const Mask& condition, const SurfaceAreaSample<Point, R>& a, const SurfaceAreaSample<Point, R>& b) noexcept {
    return {select_item(condition, a.value, b.value), real::select(condition, a.pdf, b.pdf),
            select(condition, a.surface, b.surface)};
}
template <class Mask, class Drawn, class Index>
[[nodiscard]] LUMIS_INLINE inline IndexedSample<Drawn, Index> select_item(
    const Mask& condition, const IndexedSample<Drawn, Index>& a, const IndexedSample<Drawn, Index>& b) noexcept {
    const Drawn &unindexed_a = a, &unindexed_b = b;
    return {select_item(condition, unindexed_a, unindexed_b), select_item(condition, a.index, b.index)};
}

}  // namespace lumis::LUMIS_ISA::detail
