// The strategies of a combination, by their index: std::tuple, but trivially copyable where they are, and on devices too.
#pragma once

#include "lumis/core/platform.hpp"

#include <cstddef>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA::detail {

// S may be a reference, see Held.
template <std::size_t I, class S>
struct IndexedPart {
    [[no_unique_address]] S strategy;
};

template <class Indices, class... S>
struct IndexedParts;
template <std::size_t... I, class... S>
struct IndexedParts<std::index_sequence<I...>, S...> : IndexedPart<I, S>... {};

// Made by {{first}, {second}, ...}.
template <class... S>
using Parts = IndexedParts<std::index_sequence_for<S...>, S...>;

template <std::size_t I, class S>
[[nodiscard]] LUMIS_INLINE constexpr const std::remove_reference_t<S>& part(const IndexedPart<I, S>& parts) noexcept {
    return parts.strategy;
}

// The I-th of some strategies, which may be references.
template <std::size_t I, class First, class... Rest>
struct NthStrategy : NthStrategy<I - 1, Rest...> {};
template <class First, class... Rest>
struct NthStrategy<0, First, Rest...> : std::type_identity<std::remove_cvref_t<First>> {};

}  // namespace lumis::LUMIS_ISA::detail
