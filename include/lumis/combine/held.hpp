// How a combination keeps the strategies it is given: small ones by value; one that owns memory (it is not trivially
// copyable) by reference if it is an lvalue, so that composing never copies a table. The owner must then outlive the
// combination; an rvalue is moved in.
#pragma once

#include "lumis/core/strategy.hpp"

#include <type_traits>

namespace lumis {

template <class S>
using Held = std::conditional_t<std::is_lvalue_reference_v<S> && !std::is_trivially_copyable_v<std::remove_cvref_t<S>>,
                                const std::remove_cvref_t<S>&, std::remove_cvref_t<S>>;

}  // namespace lumis
