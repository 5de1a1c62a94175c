// What a shape is prepared in: double. A float shape that passes close by needs it: where the reference point is 1e-6 of an
// edge away from the plane, a height formed of float products is wrong by a tenth. float coordinates differ exactly in double.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <type_traits>

namespace lumis::LUMIS_ISA::detail {

template <Real T>
struct WideOf : std::type_identity<T> {};
template <>
struct WideOf<float> : std::type_identity<double> {};
template <class L>
    requires RealOf<L, float>
struct WideOf<L> : std::type_identity<typename L::template Of<double>> {
};

template <Real T>
using Wide = typename WideOf<T>::type;

}  // namespace lumis::LUMIS_ISA::detail
