// Points of the unit square with a density in proportion to the bilinear interpolant of four positive weights at its corners,
// from evenly distributed ones, and back (Hart et al. 2020, "Practical Product Sampling by Fitting and Composing Warps").
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <concepts>

namespace lumis::LUMIS_ISA::detail {

// x in [0, 1] with a density in proportion to start (1 - x) + end x.
template <Real R>
[[nodiscard]] LUMIS_INLINE inline R linear_from_even(R u, R start, R end) noexcept {
    const R root = real::sqrt(R((1 - u) * (start * start) + u * (end * end)));
    return real::lesser(real::divide(R(u * (start + end)), R(start + root)), 1);
}
template <Real R>
[[nodiscard]] LUMIS_HD R even_from_linear(R x, R start, R end) noexcept {
    return real::divide(R(x * (start * (2 - x) + end * x)), R(start + end));
}

// A point in [0, 1]^2, for a NaN too, which is what a direction that is none inverts to.
template <std::floating_point T>
[[nodiscard]] LUMIS_HD glm::vec<2, T> within_square(const glm::vec<2, T>& u) noexcept {
    return {real::greater(T(0), real::lesser(T(1), u.x)), real::greater(T(0), real::lesser(T(1), u.y))};
}

template <std::floating_point T>
class BilinearWarp {
  public:
    BilinearWarp() = default;
    // w01: at x = 0 and y = 1.
    LUMIS_HD BilinearWarp(T w00, T w10, T w01, T w11) noexcept : w00_{w00}, w10_{w10}, w01_{w01}, w11_{w11} {}

    [[nodiscard]] LUMIS_HD T mean() const noexcept { return (w00_ + w10_ + w01_ + w11_) / 4; }

    template <Real R>
    [[nodiscard]] LUMIS_HD R weight(const glm::vec<2, R>& at) const noexcept {
        return (1 - at.x) * start(at.y) + at.x * end(at.y);
    }

    // First the line y, then the point on it.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE glm::vec<2, R> sample(const glm::vec<2, R>& u) const noexcept {
        const R y = linear_from_even(u.y, R(w00_ + w10_), R(w01_ + w11_));
        return {linear_from_even(u.x, start(y), end(y)), y};
    }

    [[nodiscard]] LUMIS_HD glm::vec<2, T> invert(const glm::vec<2, T>& at) const noexcept {
        return {even_from_linear(at.x, start(at.y), end(at.y)), even_from_linear(at.y, w00_ + w10_, w01_ + w11_)};
    }

  private:
    // The weights at x = 0 and at x = 1.
    template <Real R>
    [[nodiscard]] LUMIS_HD R start(R y) const noexcept {
        return (1 - y) * w00_ + y * w01_;
    }
    template <Real R>
    [[nodiscard]] LUMIS_HD R end(R y) const noexcept {
        return (1 - y) * w10_ + y * w11_;
    }

    T w00_{1}, w10_{1}, w01_{1}, w11_{1};
};

}  // namespace lumis::LUMIS_ISA::detail
