// What a std::span can be made of: the C++20 concept std::ranges::contiguous_range, without <ranges>, which would take as
// long to compile as all of Lumis.
#pragma once

#include <span>
#include <utility>

namespace lumis::detail {

template <class R>
concept Spannable = requires(const R& range) {
    std::span{range};
};

template <Spannable R>
using ElementOf = typename decltype(std::span{std::declval<const R&>()})::value_type;

}  // namespace lumis::detail
