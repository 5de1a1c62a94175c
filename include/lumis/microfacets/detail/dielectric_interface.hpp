// The boundary between two dielectrics, of any shape, as wo meets it: everything is mirrored at the plane z = 0 so that wo is
// above, and indices are named by the side that they are on, this one or the other.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/sample.hpp"
#include "lumis/microfacets/fresnel.hpp"
#include "lumis/microfacets/transport_mode.hpp"

#include <concepts>
#include <type_traits>

namespace lumis::LUMIS_ISA {

// Indices of refraction whose ratio is out of this range, or NaN, make no boundary: nothing is drawn.
inline constexpr float dielectric_min_eta = 1e-4f;
inline constexpr float dielectric_max_eta = 1e4f;

namespace detail {

// A number, of any type that converts, as a T: in lanes one for all.
template <Real T, std::convertible_to<T> Number>
[[nodiscard]] LUMIS_INLINE inline T as_real(Number x) noexcept {
    if constexpr (std::is_arithmetic_v<Number>) {
        return T(static_cast<scalar_of<T>>(x));
    } else {
        return T(x);
    }
}

template <Real T>
class DielectricInterface {
  public:
    // eta: the index below z = 0 over the one above.
    LUMIS_INLINE DielectricInterface(const Direction<T>& wo, T eta) noexcept
        : side_{real::copysign(T(1), wo.z)},
          is_valid_{eta >= scalar_of<T>(dielectric_min_eta) && eta <= scalar_of<T>(dielectric_max_eta)} {
        LUMIS_ASSERT(real::all(!is_nan(eta)));
        const T below = real::select(is_valid_, eta, 1);
        const auto from_below = wo.z < 0;
        ratio_ = index_ratio(below, from_below);
        here_ = real::select(from_below, below, 1);
        there_ = real::select(from_below, T(1), below);
    }

    // A direction in the mirror, and back.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE Direction<R> mirrored(const Direction<R>& w) const noexcept {
        return {w.x, w.y, R(side_) * w.z};
    }

    [[nodiscard]] LUMIS_HD const MaskOf<T>& is_valid() const noexcept { return is_valid_; }
    [[nodiscard]] LUMIS_HD const IndexRatio<T>& ratio() const noexcept { return ratio_; }
    // The indices of wo's side and of the other, that above z = 0 being 1.
    [[nodiscard]] LUMIS_HD const T& here() const noexcept { return here_; }
    [[nodiscard]] LUMIS_HD const T& there() const noexcept { return there_; }

    // What power that passes is worth to a path.
    [[nodiscard]] LUMIS_INLINE T scale(TransportMode mode) const noexcept {
        return mode == TransportMode::Importance ? T(1) : real::divide(T(1), T(ratio_.eta * ratio_.eta));
    }

  private:
    T side_;  // 1 if wo is above, -1 if it is below
    MaskOf<T> is_valid_;
    IndexRatio<T> ratio_{};
    T here_{}, there_{};
};

}  // namespace detail

}  // namespace lumis::LUMIS_ISA
