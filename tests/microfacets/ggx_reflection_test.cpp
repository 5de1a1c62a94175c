// What a GGX surface reflects in a white furnace (Fresnel reflectance 1, single scattering), and how many
// visible-normal samples fall below its horizon.
#include "catch.hpp"
#include "irradiance.hpp"
#include <lumis/lumis.hpp>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace {

constexpr double pi = std::numbers::pi;

// The directional albedo of isotropic GGX by the textbook's formulas, over the sphere of wi. The polar angle is warped
// towards the mirror direction's: the lobe of a smooth surface is narrow.
double albedo(double mu, double alpha) {
    using boost::math::quadrature::gauss_kronrod;
    const double sin_o = std::sqrt(1 - mu * mu);
    const auto lambda = [&](double c) { return (-1 + std::sqrt(1 + alpha * alpha * (1 - c * c) / (c * c))) / 2; };
    const auto reflected = [&](double theta, double phi) {
        const double c = std::cos(theta), s = std::sin(theta);
        if (!(c > 0)) return 0.0;
        const double x = s * std::cos(phi) + sin_o, y = s * std::sin(phi), z = c + mu;
        const double h = z * z / (x * x + y * y + z * z);
        const double k = (alpha * alpha - 1) * h + 1;
        const double D = alpha * alpha / (pi * k * k);
        return D / (1 + lambda(mu) + lambda(c)) / (4 * mu) * s;
    };
    const auto over_phi = [&](double theta) {
        return 2 *
               gauss_kronrod<double, 31>::integrate([&](double phi) { return reflected(theta, phi); }, 0, pi, 8, 1e-9);
    };
    const double mirror = std::acos(mu);
    const auto piece = [&](double a, double b) {
        return a < b ? gauss_kronrod<double, 31>::integrate(over_phi, a, b, 8, 1e-8) : 0.0;
    };
    return piece(0, mirror) + piece(mirror, pi / 2);
}

// The reflected direction's mirror image is at phi = pi here: +x is away from wo.
template <class T>
auto reflection(double mu, glm::dvec2 alpha) {
    const glm::vec<3, T> wo{static_cast<T>(std::sqrt(1 - mu * mu)), T(0), static_cast<T>(mu)};
    return std::pair{wo, lumis::GgxReflection<T>{wo, glm::vec<2, T>(alpha)}};
}

template <class T>
void check_albedo(double mu, double alpha, double answer) {
    const auto [wo, strategy] = reflection<T>(mu, glm::dvec2{alpha});
    const auto own = strategy;
    const auto f = [&, view = wo](const glm::vec<3, T>& wi) { return own.ggx().brdf(view, wi) * wi.z; };
    const std::string label = "mu " + std::to_string(mu) + ", alpha " + std::to_string(alpha);
    const auto alone = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, own));
    irradiance::check_unbiased<T>(
        label, [&](auto& uniforms) { return alone.estimate(f, uniforms); }, answer);
    const auto both =
        lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, own), lumis::take(1, lumis::CosineHemisphere<T>{}));
    irradiance::check_unbiased<T>(
        label + ", MIS", [&](auto& uniforms) { return both.estimate(f, uniforms); }, answer);
}

}  // namespace

TEMPLATE_TEST_CASE("the albedo of GGX at alpha 1 is 1 - mu ln(1 + 1/mu)", "[ggx_reflection]", float, double) {
    for (const double mu : {1.0, 0.7, 0.3, 0.05}) {
        const double closed_form = 1 - mu * std::log1p(1 / mu);
        CHECK(albedo(mu, 1) == Approx(closed_form).epsilon(1e-6));
        check_albedo<TestType>(mu, 1, closed_form);
    }
    // Its average over the hemisphere, 2 E(mu) mu dmu.
    using boost::math::quadrature::gauss_kronrod;
    const auto weighted = [](double mu) { return 2 * mu * (1 - mu * std::log1p(1 / mu)); };
    CHECK(gauss_kronrod<double, 31>::integrate(weighted, 0, 1, 10, 1e-10) ==
          Approx(4.0 / 3 * (1 - std::log(2.0))).epsilon(1e-6));
}

TEMPLATE_TEST_CASE("the albedo of GGX is what quadrature finds", "[ggx_reflection]", float, double) {
    for (const double alpha : {0.1, 0.5}) {
        for (const double mu : {0.9, 0.2}) check_albedo<TestType>(mu, alpha, albedo(mu, alpha));
    }
}

TEMPLATE_TEST_CASE("the fraction of visible normals that reflect below the horizon", "[ggx_reflection]", float,
                   double) {
    using T = TestType;
    const auto check = [](double mu, double alpha, double answer) {
        const auto pair = reflection<T>(mu, glm::dvec2{alpha});
        const auto below = [&](auto& uniforms) { return pair.second.sample(uniforms.template next<2>()).pdf == 0; };
        irradiance::check_unbiased<T>("below, mu " + std::to_string(mu) + ", alpha " + std::to_string(alpha), below,
                                      answer);
    };
    for (const double alpha : {0.3, 1.0}) check(1, alpha, alpha * alpha / (1 + alpha * alpha));
    for (const double mu : {0.5, 0.1}) check(mu, 1, mu / (1 + mu));
}
