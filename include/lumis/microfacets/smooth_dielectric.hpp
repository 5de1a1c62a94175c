// The two directions that light takes at a smooth boundary between dielectrics, such as glass or water: mirrored or refracted,
// chosen by Fresnel's equations. Local frame; a delta strategy: no density, and a probability for each of the two.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/microfacets/detail/dielectric_interface.hpp"
#include "lumis/microfacets/fresnel.hpp"
#include "lumis/microfacets/transport_mode.hpp"

#include <concepts>

namespace lumis::LUMIS_ISA {

template <Real T = float>
class SmoothDielectric {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions =
        3;  // as its rough kin GgxDielectric, so that a host's sampler keeps its dimensions aligned
    static constexpr bool is_delta = true;

    // wo: unit, above z = 0 or below; nothing is drawn if it lies in the plane. eta: the index of refraction below z = 0
    // over the one above: 1.5 for glass, whichever side wo is on. With 1 all passes straight. See dielectric_min_eta.
    template <std::convertible_to<T> Index>
    LUMIS_INLINE SmoothDielectric(const Direction<T>& wo, Index eta) noexcept
        : interface_{wo, detail::as_real<T>(eta)},
          wo_{above_horizon_or_zero(Direction<T>{wo.x, wo.y, real::abs(wo.z)})} {
        const T eta_cos_t = interface_.ratio().eta_cos_t(wo_.z);
        const T x = real::divide(wo_.x, interface_.ratio().eta), y = real::divide(wo_.y, interface_.ratio().eta);
        // Pythagoras gives it, not eta cos_t: then the direction has unit length to the last place.
        cos_t_ = real::sqrt_or_zero(T(1 - (x * x + y * y)));
        const auto is_drawn = wo_.z > 0 && interface_.is_valid();
        const auto passes = is_drawn && eta_cos_t > 0 && cos_t_ > 0;
        transmittance_ = real::select(passes, interface_.ratio().transmitted(wo_.z, eta_cos_t), 0);
        reflectance_ =
            real::select(passes, interface_.ratio().reflected(wo_.z, eta_cos_t), real::select(is_drawn, T(1), 0));
    }

    // The shares of the power that are reflected and transmitted, which sum to 1; 0 where nothing is drawn.
    [[nodiscard]] LUMIS_HD const T& reflectance() const noexcept { return reflectance_; }
    [[nodiscard]] LUMIS_HD const T& transmittance() const noexcept { return transmittance_; }

    // Reflects if u.z is less than the reflectance. u.x and u.y are not used.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD Sample<Direction<R>, R> sample(glm::vec<3, R> u) const noexcept {
        const auto reflects = u.z < reflectance_ || transmittance_ <= 0;
        const R shrinkage =
            real::select(reflects, R(scalar_of<R>(1)), real::divide(R(scalar_of<R>(1)), R(interface_.ratio().eta)));
        const Direction<R> wi{-wo_.x * shrinkage, -wo_.y * shrinkage, real::select(reflects, R(wo_.z), R(-cos_t_))};
        return {interface_.mirrored(wi), real::select(reflects, R(reflectance_), R(transmittance_))};
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD constexpr R pdf(const Direction<R>&) const noexcept {
        return R(scalar_of<R>(0));
    }

    // What an integrand returns for lumis::delta, times the radiance from wi: the reflectance on wo's side; on the other the
    // transmittance, over the squared relative index if radiance is carried.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R coefficient(const Direction<R>& wi,
                                         TransportMode mode = TransportMode::Radiance) const noexcept {
        const R transmitted{transmittance_ * interface_.scale(mode)};
        return real::select(interface_.mirrored(wi).z > 0, R(reflectance_), transmitted);
    }

  private:
    detail::DielectricInterface<T> interface_;
    Direction<T> wo_;  // in the mirror
    T cos_t_{0};
    T reflectance_{0}, transmittance_{0};
};

}  // namespace lumis::LUMIS_ISA
