// Reflection and refraction of wo at a rough boundary between dielectrics, such as ground glass: one density over the whole
// sphere of wi, per solid angle. A visible GGX normal is drawn; Fresnel's reflectance at this normal says whether wo is
// mirrored or refracted about it. Local frame. Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces".
// A normal that mirrors wo below the surface, or refracts it above, draws nothing.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/microfacets/detail/dielectric_interface.hpp"
#include "lumis/microfacets/fresnel.hpp"
#include "lumis/microfacets/ggx.hpp"
#include "lumis/microfacets/ggx_reflection.hpp"
#include "lumis/microfacets/transport_mode.hpp"

#include <concepts>
#include <type_traits>

namespace lumis::LUMIS_ISA {

template <Real T = float>
class GgxDielectric {
  public:
    using Scalar = T;
    using Point = Direction<T>;
    using Measure = measure::SolidAngle;
    static constexpr int dimensions = 3;

    // wo: unit, above z = 0 or below; nothing is drawn if it lies in the plane. alpha: roughness along x and y, see
    // ggx_min_alpha. eta: the index of refraction below z = 0 over the one above: 1.5 for glass, whichever side wo is on;
    // see dielectric_min_eta. The refracted lobe is about alpha |eta - 1| wide: below 1e-4 a float direction cannot resolve
    // it. With eta = 1 all passes straight, which has no density, and nothing is drawn: use SmoothDielectric.
    LUMIS_INLINE GgxDielectric(const Direction<T>& wo, glm::vec<2, T> alpha, std::type_identity_t<T> eta) noexcept
        : interface_{wo, eta},
          wo_{above_horizon_or_zero(Direction<T>{wo.x, wo.y, real::abs(wo.z)})},
          reflection_{Direction<T>{wo.x, wo.y, real::abs(wo.z)},
                      glm::vec<2, T>{real::select(interface_.is_valid(), alpha.x, -1), alpha.y}} {}
    // One roughness for both axes.
    template <std::convertible_to<T> Roughness, std::convertible_to<T> Index>
    LUMIS_INLINE GgxDielectric(const Direction<T>& wo, Roughness alpha, Index eta) noexcept
        : GgxDielectric{wo, detail::on_both_axes<T>(alpha), detail::as_real<T>(eta)} {}

    // u.x and u.y draw the normal, as GgxReflection does; wo is mirrored if u.z is less than the reflectance there.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_INLINE Sample<Direction<R>, R> sample(glm::vec<3, R> u) const noexcept {
        const Direction<R> wo{wo_}, along = reflection_.normals().template along_normal<R>({u.x, u.y});
        const R length = real::length(along);
        const Direction<R> wm = real::divide(along, real::divisor_where(length > 0, length));
        const R cosine = real::greater(real::dot(wo, wm), 0), eta_cos_t = ratio().eta_cos_t(cosine);
        const auto mirrors = u.z < ratio().reflected(cosine, eta_cos_t) || eta_cos_t <= 0;
        const Direction<R> towards = real::rounded(scattered(mirrors, wm, cosine, eta_cos_t));
        // What arrives on the wrong side may be drawn otherwise, and so have a density; the zero vector has none.
        const auto arrives = (mirrors && towards.z > 0) || (!mirrors && towards.z < 0 && cosine > 0);
        const Direction<R> wi = real::select(arrives, towards, Direction<R>{R(scalar_of<R>(0))});
        return {interface_.mirrored(wi), density(wi)};
    }

    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R pdf(const Direction<R>& wi) const noexcept {
        return density(interface_.mirrored(wi));
    }

    // Radiance towards wo per unit of irradiance from wi, reflected or transmitted, without a cosine. In the mode Importance
    // the same for power: wo is where it comes from. f(wo, wi) / n^2 is reciprocal, with the index n on the side of wo.
    // Shadowing is height-correlated where light is reflected. Where it is transmitted, it is separable, G1(wo) G1(wi), as
    // Walter et al. 2007 have it. Heights are correlated there too, the other way, which would transmit a little less: the G2
    // would be the beta function B(1 + Lambda(wo), 1 + Lambda(wi)), Heitz et al. 2016.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R bsdf(const Direction<R>& wi, TransportMode mode = TransportMode::Radiance) const noexcept {
        const Direction<R> w = interface_.mirrored(wi);
        const T scale = interface_.scale(mode) * interface_.there() * interface_.there();
        return real::either(
            w.z > 0, [&] { return R(reflectance_at(w) * ggx().template brdf<R>(wo_, w)); },
            [&] {
                const R visibility = ggx().template visibility_separable<R>(wo_, below_to_above(w));
                const Refraction<R> refraction{*this, w};
                return R(4 * visibility * scale * ggx().template D<R>(refraction.normal) * refraction.passed());
            });
    }

    // What a sample is worth, bsdf(wi) |wi.z| / pdf(wi), without forming D or the reflectance: from 0 to 1, or to the squared
    // index of wo's side over that of wi's side where radiance is carried and wi is on the other side. 0 where no normal
    // refracts wo into wi.
    template <RealOf<T> R = T>
    [[nodiscard]] LUMIS_HD R weight(const Direction<R>& wi,
                                    TransportMode mode = TransportMode::Radiance) const noexcept {
        const Direction<R> w = interface_.mirrored(wi);
        return real::either(
            w.z > 0, [&] { return R(reflection_.template weight<R>(w)); },
            [&] {
                const R seen = ggx().template G1<R>(below_to_above(w));
                return R(real::select(Refraction<R>{*this, w}.is_possible(), seen * interface_.scale(mode), 0));
            });
    }

    [[nodiscard]] LUMIS_HD const Ggx<T>& ggx() const noexcept { return reflection_.ggx(); }

  private:
    // All directions below are in the interface's mirror: wo is above.

    // The normal that refracts wo into wi, and its cosines, from n_wo wo + n_wi wi (Walter et al. 2007, eq. 16), which points
    // to the side of the lesser index.
    template <Real R>
    struct Refraction {
        const GgxDielectric& surface;
        Direction<R> normal;  // of any length, which cancels in all that follows
        R cos_o, cos_i;       // of wo and of -wi, times that length

        LUMIS_INLINE Refraction(const GgxDielectric& rough, const Direction<R>& wi) noexcept : surface{rough} {
            const T here = rough.interface_.here(), there = rough.interface_.there();
            const Direction<R> wo{rough.wo_};
            // n w = w + (n - 1) w: the sum of the directions, which are nearly opposite where the indices are nearly the same,
            // is formed before anything is rounded.
            const Direction<R> sum = real::rounded(wo + wi);
            const Direction<R> weighed = sum + R(there - 1) * wi + R(here - 1) * wo;
            normal = real::select(MaskOf<R>(there > here), -weighed, weighed);
            cos_o = real::dot(wo, normal);
            cos_i = -real::dot(wi, normal);
        }

        [[nodiscard]] LUMIS_INLINE MaskOf<R> is_possible() const noexcept {
            return cos_o > 0 && cos_i > 0 && normal.z > 0;
        }

        // wo.wm times the transmittance times the Jacobian n_wi^2 |wi.wm| / (n_wo wo.wm + n_wi wi.wm)^2 (eq. 17), all over
        // n_wi^2. The divisor is the squared length of the normal, and nothing cancels in it.
        [[nodiscard]] LUMIS_INLINE R passed() const noexcept {
            const T here = surface.interface_.here(), there = surface.interface_.there();
            const auto possible = is_possible();
            const R square = real::dot(normal, normal);
            const R per_square = real::quotient_where(possible && square > 0, R(scalar_of<R>(1)), square);
            // The transmittance as in IndexRatio, times the squares of both indices.
            const R o = here * cos_o, i = there * cos_i, s = o + i, p = there * cos_o + here * cos_i;
            const R by_s = real::quotient_where(possible, R(scalar_of<R>(1)), s);
            const R by_p = real::quotient_where(possible, R(scalar_of<R>(1)), p);
            const R transmitted = 2 * ((o * by_s) * (i * by_s) + (o * by_p) * (i * by_p));
            return transmitted * (cos_o * per_square) * (cos_i * per_square);
        }
    };

    [[nodiscard]] LUMIS_HD const detail::IndexRatio<T>& ratio() const noexcept { return interface_.ratio(); }

    template <Real R>
    [[nodiscard]] LUMIS_INLINE static Direction<R> below_to_above(const Direction<R>& w) noexcept {
        return {w.x, w.y, -w.z};
    }

    // wm is unit, up to its rounding; refraction into a thinner medium multiplies what that took from it. One step of Newton's
    // brings wi back to unit length.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE Direction<R> scattered(const MaskOf<R>& mirrors, const Direction<R>& wm, R cosine,
                                                      R eta_cos_t) const noexcept {
        const Direction<R> wo{wo_};
        const Direction<R> wi = real::either(
            mirrors, [&]() -> Direction<R> { return 2 * cosine * wm - wo; },
            [&]() -> Direction<R> {
                // (wo.wm - eta cos_t) wm - wo, over eta; the difference is extended to a fraction because it cancels.
                const R sum = cosine + eta_cos_t;
                const R along = real::divide(R(ratio().excess), real::divisor_where(sum > 0, sum));
                return real::divide(R(scalar_of<R>(-1)), R(ratio().eta)) * Direction<R>(along * wm + wo);
            });
        return (scalar_of<R>(1.5) - scalar_of<R>(0.5) * real::dot(wi, wi)) * wi;
    }

    // The length of wo + wi is 2 wo.wm.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE R reflectance_at(const Direction<R>& wi) const noexcept {
        const R cosine = real::length(Direction<R>(Direction<R>(wo_) + wi)) / 2;
        return ratio().reflected(cosine, ratio().eta_cos_t(cosine));
    }

    template <Real R>
    [[nodiscard]] LUMIS_INLINE R density(const Direction<R>& wi) const noexcept {
        return real::either(
            wi.z > 0, [&] { return density_or_zero(R(reflectance_at(wi) * reflection_.template pdf<R>(wi))); },
            [&] { return transmitted_density(wi); });
    }

    // The density of the visible normal, which has wo.wm as a factor, times transmittance and Jacobian.
    template <Real R>
    [[nodiscard]] LUMIS_INLINE R transmitted_density(const Direction<R>& wi) const noexcept {
        const Refraction<R> refraction{*this, wi};
        const R normals = reflection_.normals().template pdf_per_cosine<R>(refraction.normal);
        const T index = interface_.there();
        return density_or_zero(real::select(wi.z < 0, R(index * index * normals * refraction.passed()), 0));
    }

    detail::DielectricInterface<T> interface_;
    Direction<T> wo_;
    GgxReflection<T> reflection_;
};

}  // namespace lumis::LUMIS_ISA
