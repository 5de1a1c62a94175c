// Lights that a tree is built of, and what a number of them together costs: Conty Estevez and Kulla 2018, section 4.3.
//
// The cost is their intensity, times the squared radius of their box, times 1 + r^2, where r is the radius of the box about
// their axes, as points of [-1, 1]^3. pi (1 + r^2) stands for the paper's M_Omega for emission into hemispheres: both are pi
// where all axes agree and 4 pi where any may occur; in between it takes no trigonometry.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <glm/geometric.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace lumis::LUMIS_ISA::detail {

template <std::floating_point T>
struct Box {
    glm::vec<3, T> lower{(std::numeric_limits<T>::max)()}, upper{-(std::numeric_limits<T>::max)()};

    void add(const Box& box) noexcept {
        for (int k = 0; k < 3; ++k) {
            lower[k] = real::lesser(lower[k], box.lower[k]);
            upper[k] = real::greater(upper[k], box.upper[k]);
        }
    }
    [[nodiscard]] glm::vec<3, T> center() const noexcept { return lower / T(2) + upper / T(2); }
    [[nodiscard]] glm::vec<3, T> half() const noexcept { return upper / T(2) - lower / T(2); }
};

// A light on its way into the tree.
template <std::floating_point T>
struct LightToPlace {
    Box<T> place, axes;
    T intensity;  // the largest of all is 1
    std::uint32_t index;
};

// A number of lights together.
template <std::floating_point T>
struct LightGroup {
    Box<T> place{}, axes{};
    double intensity{};
    std::size_t lights{};

    void add(const auto& other) noexcept {
        place.add(other.place);
        axes.add(other.axes);
        intensity += static_cast<double>(other.intensity);
        if constexpr (requires { other.lights; }) {
            lights += other.lights;
        } else {
            ++lights;
        }
    }
    // The cost in units of the squared extent of what is divided.
    [[nodiscard]] double cost(double inverse_extent) const noexcept {
        const glm::vec<3, double> half = glm::vec<3, double>(place.half()) * inverse_extent, spread(axes.half());
        return intensity * glm::dot(half, half) * (1 + glm::dot(spread, spread));
    }
};

}  // namespace lumis::LUMIS_ISA::detail
