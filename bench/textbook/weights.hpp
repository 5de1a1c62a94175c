// MIS weights of two techniques as books have them: squares of densities, which overflow from 2e19 on in float (Pharr,
// Jakob and Humphreys 2023, section 2.2.3).
#pragma once

#include <concepts>

namespace textbook {

struct BalanceHeuristic {
    template <std::floating_point T>
    [[nodiscard]] T operator()(T own, T other) const noexcept {
        return own / (own + other);
    }
};

struct PowerHeuristic {
    template <std::floating_point T>
    [[nodiscard]] T operator()(T own, T other) const noexcept {
        return own * own / (own * own + other * other);
    }
};

}  // namespace textbook
