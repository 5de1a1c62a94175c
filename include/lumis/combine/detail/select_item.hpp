// One of two samples in each lane.
#pragma once

#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/surface_point.hpp"

#include <cstddef>

namespace lumis::LUMIS_ISA::detail {

// a where the condition holds, else b. Points as select_point takes them, and samples of such; any other type offers
// select(condition, a, b), found by its argument.
template <class Mask, class Item>
[[nodiscard]] LUMIS_HD Item select_item(const Mask& condition, const Item& a, const Item& b) noexcept {
    if constexpr (requires { select(condition, a, b); }) {
        return select(condition, a, b);
    } else if constexpr (AnySample<Item>) {
        Item result{b};
        result.value = select_point(condition, a.value, b.value);
        result.pdf = real::select(condition, a.pdf, b.pdf);
        if constexpr (HasDistance<Item>) result.distance = real::select(condition, a.distance, b.distance);
        if constexpr (HasSurface<Item>) result.surface = select(condition, a.surface, b.surface);
        if constexpr (requires { a.index; }) {
            for (std::size_t i = 0; i < a.index.size(); ++i) {
                if (condition[i]) result.index[i] = a.index[i];
            }
        }
        return result;
    } else {
        return select_point(condition, a, b);
    }
}

}  // namespace lumis::LUMIS_ISA::detail
