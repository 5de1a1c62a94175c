// What GGX reflects: its albedo, and a nearly perfect mirror under a small light.
#include "cases.hpp"
#include "directions.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <numbers>

namespace stability {

namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

// Closed forms: the albedo at roughness 1, and the fraction of visible normals that reflect below the horizon.
template <class T>
Measured ggx_albedo(Effort) {
    Measured measured;
    const std::int64_t samples = 150'000;
    const glm::vec<2, T> one{T(1), T(1)};
    for_each_cosine([&](double mu) {
        const auto wo = at_cosine<T>(mu);
        const double answer = 1 - double{wo.z} * std::log1p(1 / double{wo.z});
        const auto check = [&](const auto& strategy) {
            const auto estimator = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, strategy));
            const auto f = [&](const auto& wi) { return strategy.ggx().brdf(wo, wi) * wi.z; };
            const auto moments = moments_of<T>(samples, [&](auto& source) { return estimator.estimate(f, source); });
            // About one ray in 1 / mu is not simply 1: too rare to tell at 1e-6, where all of it is allowed.
            measured.bias(moments, answer, rounding_of_mean<T> + (mu < 5e-4 ? 20 * mu : 0));
        };
        check(lumis::GgxReflection<T>{wo, one});
        check(lumis::GgxBoundedReflection<T>{wo, one});
    });
    for (const double alpha : {0.1, 0.3, 1.0, 10.0}) {
        const lumis::GgxReflection<T> strategy{{T(0), T(0), T(1)}, glm::vec<2, T>{glm::dvec2{alpha}}};
        const auto below = moments_of<T>(
            samples, [&](auto& source) { return strategy.sample(source.template next<2>()).pdf > 0 ? 0.0 : 1.0; });
        measured.bias(below, alpha * alpha / (1 + alpha * alpha), rounding_of_mean<T>);
    }
    return measured;
}

namespace {

// What a round light of unit radiance sends back to wo, by quadrature in double over its cone.
double reflected_by_quadrature(const glm::dvec3& wo, double alpha, const glm::dvec3& axis, double half_angle) {
    using boost::math::quadrature::gauss_kronrod;
    const lumis::Frame<double> frame{axis};
    const double alpha2 = alpha * alpha;
    const auto lambda = [&](double c) { return (std::sqrt(1 + alpha2 * (1 - c * c) / (c * c)) - 1) / 2; };
    const auto integrand = [&](double theta, double phi) {
        const glm::dvec3 wi =
            frame.to_world({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
        const glm::dvec3 half = wo + wi;
        const double cos2 = half.z * half.z / glm::dot(half, half);
        const double k = 1 + (alpha2 - 1) * cos2;  // in double, 1e-6 keeps ten digits
        const double D = alpha2 / (pi * k * k);
        return D / (1 + lambda(wo.z) + lambda(wi.z)) / (4 * wo.z) * std::sin(theta);
    };
    const auto ring = [&](double theta) {
        const auto along = [&](double phi) { return integrand(theta, phi); };
        return gauss_kronrod<double, 31>::integrate(along, 0, 2 * pi, 12, 1e-8);
    };
    return gauss_kronrod<double, 31>::integrate(ring, 0, half_angle, 12, 1e-8);
}

}  // namespace

template <class T>
Measured mirror_against_small_light(Effort effort) {
    Measured measured;
    const double alpha = 1e-3, half_angle = std::sqrt(1e-4 / pi);
    const std::int64_t samples = effort.of(100'000);
    for (const double theta : {0.0, 0.8, 1.3}) {
        const auto wo = towards<T>(theta, pi);
        // The light's centre off the mirror direction, in units of its half-angle: in the middle, at the rim, beyond it.
        for (const double offset : {0.0, 0.5, 1.0, 1.5}) {
            const auto axis = towards<T>(theta + offset * half_angle, 0);
            const T radius = static_cast<T>(std::sin(half_angle));
            const lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle> light{{axis, radius}, {T(0), T(0), T(0)}};
            const lumis::GgxReflection<T> bsdf{wo, {static_cast<T>(alpha), static_cast<T>(alpha)}};
            const double answer = reflected_by_quadrature(glm::normalize(glm::dvec3{wo}), double{static_cast<T>(alpha)},
                                                          glm::normalize(glm::dvec3{axis}),
                                                          std::asin(double{radius} / glm::length(glm::dvec3{axis})));
            const auto f = [&](const auto& wi) {
                return light.pdf(wi) > 0 ? bsdf.ggx().brdf(wo, wi) * std::max(wi.z, T(0)) : T(0);
            };
            const auto check = [&](const auto& estimator) {
                const auto moments = moments_of<T>(samples, [&](auto& u) { return estimator.estimate(f, u); });
                measured.bias(moments, answer, 1e-5);
                auto source = uniforms<T>(3);
                for (int i = 0; i < 500; ++i) {
                    for (const auto& wi : {bsdf.sample(source.template next<2>()).value,
                                           light.sample(source.template next<2>()).value}) {
                        const T first = estimator.template weight<0>(wi), second = estimator.template weight<1>(wi);
                        if (bsdf.pdf(wi) > 0 || light.pdf(wi) > 0) measured.compare(first + second, Quad{1});
                    }
                }
            };
            using lumis::BalanceHeuristic, lumis::PowerHeuristic, lumis::choose, lumis::take;
            check(lumis::multi_sample(BalanceHeuristic{}, take(1, bsdf), take(1, light)));
            check(lumis::multi_sample(PowerHeuristic{}, take(1, bsdf), take(2, light)));
            check(lumis::one_sample(PowerHeuristic{}, choose(0.5, bsdf), choose(0.5, light)));
        }
    }
    return measured;
}

template Measured ggx_albedo<float>(Effort);
template Measured ggx_albedo<double>(Effort);
template Measured mirror_against_small_light<float>(Effort);
template Measured mirror_against_small_light<double>(Effort);

}  // namespace stability
