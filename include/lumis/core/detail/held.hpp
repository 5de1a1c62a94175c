// How a combination keeps the strategies it is given: by value, so that it may outlive them; but one that owns memory
// (its destructor has something to do) by reference if it is an lvalue, so that composing never copies a table. The
// owner must then outlive the combination. An rvalue is always moved in.
#pragma once

#include "lumis/core/platform.hpp"

#include <type_traits>

namespace lumis::LUMIS_ISA::detail {

template <class S>
concept HeldByReference = std::is_lvalue_reference_v<S> && !std::is_trivially_destructible_v<std::remove_cvref_t<S>>;

template <class S>
using Held = std::conditional_t<HeldByReference<S>, const std::remove_cvref_t<S>&, std::remove_cvref_t<S>>;

}  // namespace lumis::LUMIS_ISA::detail
