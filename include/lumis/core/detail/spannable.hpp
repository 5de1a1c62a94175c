// What a std::span can be made of: the C++20 concept std::ranges::contiguous_range, without <ranges>, which would take as
// long to compile as all of Lumis.
#pragma once

#include "lumis/core/platform.hpp"

#include <concepts>
#include <span>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA::detail {

template <class R>
concept Spannable = requires(const R& range) {
    std::span{range};
};

template <Spannable R>
using ElementOf = typename decltype(std::span{std::declval<const R&>()})::value_type;

// A range of numbers that are not T.
template <class R, class T>
concept RangeOfOther = Spannable<R> && std::is_arithmetic_v<ElementOf<R>> && !std::same_as<ElementOf<R>, T>;

template <Spannable R>
[[nodiscard]] std::span<const ElementOf<R>> span_of(const R& range) {
    return std::span{range};
}

}  // namespace lumis::LUMIS_ISA::detail
