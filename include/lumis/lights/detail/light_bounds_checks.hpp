// Bounds that no light tree can be built of.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/core/throw.hpp"
#include "lumis/lights/light_bounds.hpp"
#include "lumis/tables/detail/cumulative_counts.hpp"

#include <concepts>
#include <cstddef>
#include <limits>
#include <string>

namespace lumis::LUMIS_ISA::detail {

// Throws std::invalid_argument that names the i-th light and the value.
template <std::floating_point T>
void require_light_bounds(const LightBounds<T>& light, std::size_t i) {
    if (!is_weight(light.intensity)) {
        refuse("lumis: the intensity of light " + std::to_string(i) + " is " + std::to_string(light.intensity) +
               "; intensities must be finite and not negative");
    }
    const auto refuse_bounds = [&](const std::string& what, T value, const std::string& must) {
        refuse("lumis: " + what + " of light " + std::to_string(i) + " is " + std::to_string(value) + "; " + must);
    };
    constexpr T most = (std::numeric_limits<T>::max)() / 4;
    for (int k = 0; k < 3; ++k) {
        for (const T x : {light.lower[k], light.upper[k]}) {
            if (!(real::abs(x) <= most)) refuse_bounds("a bound", x, "bounds must be finite");
        }
        if (!(light.lower[k] <= light.upper[k])) {
            refuse_bounds("the lower bound", light.lower[k],
                          "the upper one must not be less, and is " + std::to_string(light.upper[k]));
        }
        if (!(real::abs(light.axis[k]) <= most)) {
            refuse_bounds("a component of the axis", light.axis[k], "axes must be finite");
        }
    }
    if (!(real::abs(light.cos_cone) <= T(1.001))) {
        refuse_bounds("cos_cone", light.cos_cone, "a cosine is from -1 to 1");
    }
}

}  // namespace lumis::LUMIS_ISA::detail
