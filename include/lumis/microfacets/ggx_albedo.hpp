// What a rough metal loses, and its return. Smith's GGX lets light leave after one reflection or not at all: of a white sky a
// surface of roughness 1 reflects 31 % at normal incidence. Turquin 2019, "Practical multiple scattering compensation for
// microfacet models": the reflectance is scaled so that with Fresnel reflectance 1 all light leaves.
#pragma once

#include "lumis/core/elementary.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/microfacets/ggx.hpp"

#include <array>
#include <cstddef>
#include <type_traits>

namespace lumis::LUMIS_ISA {

namespace detail {

// The light that a surface of one roughness alpha in (0, 1] loses, over x = mu (1 + alpha) / (mu + alpha), where mu = wo.z: a
// polynomial in x whose coefficients are polynomials in alpha. In x, smooth surfaces are all alike. Least largest error,
// relative to the light that leaves, over 28 x 28 Chebyshev nodes; 0.42 % over all.
struct GgxLoss {
    static constexpr auto x0 = std::array{0.029453721f, -0.17530081f, 6.6167095f, -6.3895882f, 2.3115461f};
    static constexpr auto x1 = std::array{3.2501856f, -6.4299362f, -24.488359f, 27.259719f, -11.088595f};
    static constexpr auto x2 = std::array{-18.06523f, 47.096454f, 40.639566f, -39.998501f, 15.85962f};
    static constexpr auto x3 = std::array{49.734031f, -132.61171f, -35.750996f, 21.293374f, -6.3092419f};
    static constexpr auto x4 = std::array{-72.877528f, 190.85546f, 17.40133f, -4.8228796f};
    static constexpr auto x5 = std::array{52.235956f, -135.41744f, -1.6339415f};
    static constexpr auto x6 = std::array{-14.303005f, 36.472281f};
};

}  // namespace detail

// The directional albedo, with Fresnel reflectance 1 and height-correlated shadowing: how much of a white sky is reflected to
// wo, by a fitted function. For one roughness of at most 1 it is at most 0.9 % too large and never too small. For two it is
// from 3.7 % too small to 4.5 % too large where one is twice the other, and from 6 % to 7.5 % where it is up to a hundred times. A
// roughness beyond 1 counts as 1, which reflects more. 0 from below.
template <Real T, RealOf<T> R = T>
[[nodiscard]] LUMIS_INLINE inline R ggx_albedo(const Ggx<T>& ggx, const Direction<R>& wo) noexcept {
    using Number = scalar_of<T>;
    using Loss = detail::GgxLoss;
    const glm::vec<2, T> alpha = ggx.alpha();
    // The mean slope of all facets, and the cosine at which they would be seen as steep as they are from wo, were they alike in
    // all directions.
    const T mean = real::sqrt(T((alpha.x * alpha.x + alpha.y * alpha.y) * Number(0.5)));
    const R x = alpha.x * wo.x, y = alpha.y * wo.y, z = mean * wo.z;
    const auto valid = wo.z > 0 && mean > 0;
    const R mu = real::quotient_where(valid, z, real::sqrt(R(x * x + y * y + z * z)));
    const T a = real::lesser(mean, Number(1));
    const R s = real::quotient_where(valid, R(mu * (1 + a)), R(mu + a));
    R loss = detail::polynomial(a, [] { return Loss::x6; });
    loss = real::mul_add(loss, s, detail::polynomial(a, [] { return Loss::x5; }));
    loss = real::mul_add(loss, s, detail::polynomial(a, [] { return Loss::x4; }));
    loss = real::mul_add(loss, s, detail::polynomial(a, [] { return Loss::x3; }));
    loss = real::mul_add(loss, s, detail::polynomial(a, [] { return Loss::x2; }));
    loss = real::mul_add(loss, s, detail::polynomial(a, [] { return Loss::x1; }));
    loss = real::mul_add(loss, s, detail::polynomial(a, [] { return Loss::x0; })) * s;
    const Number never_too_small = Number(1.0043);
    return real::select(valid, real::lesser(R((1 - loss) * never_too_small), Number(1)), 0);
}

// The factor that gives back what is lost: 1 + f0 (1 - E) / E, with E of ggx_albedo. f0: the metal's reflectance at normal
// incidence, a number or a colour. From below 1.
//
//     const glm::vec3 reflected = f * bsdf.ggx().brdf(wo, wi) * ggx_compensation(bsdf.ggx(), wo, f0);
//     const glm::vec3 weight = f * bsdf.weight(wi) * ggx_compensation(bsdf.ggx(), wo, f0);  // of a sample
//
// f is Fresnel's reflectance at the half vector. In a white sky a white metal of one roughness then reflects between 99.1 % and
// all, whatever the angle; of two, more than all by as much as their albedo is too small. The density stays as it is: the shape
// of the lobe does not change. Not reciprocal: wo is the direction that light leaves along, towards the camera; paths from
// lights ask with the one they leave along as well.
template <Real T, RealOf<T> R, class Reflectance>
    requires(!std::is_arithmetic_v<Reflectance>)
[[nodiscard]] LUMIS_INLINE inline Reflectance ggx_compensation(const Ggx<T>& ggx, const Direction<R>& wo,
                                                               const Reflectance& f0) noexcept {
    const R albedo = ggx_albedo<T, R>(ggx, wo);
    return Reflectance(scalar_of<T>(1)) + f0 * real::quotient_where(albedo > 0, R(1 - albedo), albedo);
}
// The same of a number of any type, 1 for a white metal: the factor is none of that type.
template <Real T, RealOf<T> R, class Number>
    requires std::is_arithmetic_v<Number>
[[nodiscard]] LUMIS_INLINE inline R ggx_compensation(const Ggx<T>& ggx, const Direction<R>& wo, Number f0) noexcept {
    const R albedo = ggx_albedo<T, R>(ggx, wo);
    const scalar_of<T> reflectance = static_cast<scalar_of<T>>(f0);
    return 1 + reflectance * real::quotient_where(albedo > 0, R(1 - albedo), albedo);
}

}  // namespace lumis::LUMIS_ISA
