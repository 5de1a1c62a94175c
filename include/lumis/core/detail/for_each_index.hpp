// A loop over the parts of a combination, unrolled by the compiler.
#pragma once

#include "lumis/core/platform.hpp"

#include <cstddef>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA::detail {

// Calls visit(0), visit(1), ..., visit(N - 1) with the index as a constant.
template <std::size_t N, class Visit>
LUMIS_HD constexpr void for_each_index(Visit visit) {
    const auto visit_all = [&]<std::size_t... I>(std::index_sequence<I...>) {
        (visit(std::integral_constant<std::size_t, I>{}), ...);
    };
    visit_all(std::make_index_sequence<N>{});
}

}  // namespace lumis::LUMIS_ISA::detail
