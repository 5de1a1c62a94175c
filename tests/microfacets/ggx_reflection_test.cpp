// What a GGX surface reflects in a white furnace (Fresnel reflectance 1, single scattering), and how many
// visible-normal samples fall below its horizon.
#include "catch.hpp"
#include "irradiance.hpp"
#include <lumis/core/lanes.hpp>
#include <lumis/lumis.hpp>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <type_traits>

namespace {

constexpr double pi = std::numbers::pi;

// The directional albedo of isotropic GGX by the textbook's formulas, over the sphere of wi. The polar angle is warped
// towards the mirror direction's: the lobe of a smooth surface is narrow.
double albedo(double mu, double alpha, bool separable = false) {
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
        const double both = separable ? lambda(mu) * lambda(c) : 0.0;
        return D / (1 + lambda(mu) + lambda(c) + both) / (4 * mu) * s;
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

// At alpha 1 every stretched length is 1, so that D G2 / (4 cos cos) is 1 / (pi (1 + mu) (1 + cos)).
TEMPLATE_TEST_CASE("the albedo of GGX with separable shadowing", "[ggx_reflection]", float, double) {
    using T = TestType;
    const auto check = [](double mu, double alpha, double answer) {
        const auto [wo, strategy] = reflection<T>(mu, glm::dvec2{alpha});
        const auto own = strategy;
        const lumis::GgxBoundedReflection bounded{wo, static_cast<T>(alpha)};
        const auto check_mean = [&](const char* what, const auto& of_sample) {
            irradiance::check_unbiased<T>(
                what + std::string{" of mu "} + std::to_string(mu) + ", alpha " + std::to_string(alpha),
                [&](auto& uniforms) { return of_sample(uniforms.template next<2>()); }, answer);
        };
        check_mean("weight", [&](glm::vec<2, T> u) { return own.weight_separable(own.sample(u).value); });
        check_mean("bounded weight",
                   [&](glm::vec<2, T> u) { return bounded.weight_separable(bounded.sample(u).value); });
        check_mean("reflectance", [&, view = wo](glm::vec<2, T> u) {
            const auto drawn = lumis::CosineHemisphere<T>{}.sample(u);
            return own.ggx().brdf_separable(view, drawn.value) * std::numbers::pi_v<T>;
        });
    };
    for (const double mu : {1.0, 0.3}) {
        CHECK(albedo(mu, 1, true) == Approx(2 * (1 - std::log(2.0)) / (1 + mu)).epsilon(1e-6));
        check(mu, 1, 2 * (1 - std::log(2.0)) / (1 + mu));
        check(mu, 0.5, albedo(mu, 0.5, true));
    }
}

TEMPLATE_TEST_CASE("the weight of a reflection is reflectance times cosine over density", "[ggx_reflection]", float,
                   double) {
    using T = TestType;
    using Vector = glm::vec<3, T>;
    auto uniforms = irradiance::uniforms<T>(3);
    const double tolerance = std::is_same_v<T, float> ? 2e-5 : 1e-12;
    for (const glm::dvec2 alpha : {glm::dvec2{1, 1}, glm::dvec2{0.1, 0.7}, glm::dvec2{1e-3, 1e-3}}) {
        for (const double mu : {1.0, 0.6, 0.01}) {
            const auto [wo, strategy] = reflection<T>(mu, alpha);
            const lumis::GgxBoundedReflection bounded{wo, glm::vec<2, T>(alpha)};
            std::size_t wrong = 0;
            const auto check = [&, view = wo](const auto& own, const Vector& wi) {
                const double cosine_over_pdf = double{wi.z} / double{own.pdf(wi)};
                const double weight = own.weight(wi), separable = own.weight_separable(wi);
                const auto is_close = [&](double a, double b) { return std::abs(a - b) <= tolerance * b; };
                wrong += !is_close(weight, double{own.ggx().brdf(view, wi)} * cosine_over_pdf);
                wrong += !is_close(separable, double{own.ggx().brdf_separable(view, wi)} * cosine_over_pdf);
                wrong += !(separable > 0 && separable <= weight * (1 + tolerance) && weight <= 1 + tolerance);
                return separable;
            };
            for (int i = 0; i < 200; ++i) {
                const auto drawn = strategy.sample(uniforms.template next<2>());
                if (drawn.pdf > 0) {
                    const double masking = strategy.ggx().G1(drawn.value);
                    wrong += !(std::abs(check(strategy, drawn.value) - masking) <= tolerance * masking);
                } else {
                    wrong += strategy.weight(drawn.value) != 0 || strategy.weight_separable(drawn.value) != 0;
                }
                const auto other = bounded.sample(uniforms.template next<2>());
                if (other.pdf > 0) check(bounded, other.value);
            }
            INFO("alpha " << alpha.x << " " << alpha.y << ", mu " << mu);
            CHECK(wrong == 0);
        }
    }
    const lumis::GgxReflection<T> from_below{Vector{T(0.6), T(0), T(-0.8)}, T(0.3)};
    CHECK(from_below.weight(Vector{T(0.6), T(0), T(0.8)}) == 0);
    CHECK(from_below.weight_separable(Vector{T(0.6), T(0), T(0.8)}) == 0);
    const lumis::GgxReflection<T> out_of_range{Vector{T(0.6), T(0), T(0.8)}, T(-1)};
    CHECK(out_of_range.weight(Vector{T(0), T(0), T(1)}) == 0);
    CHECK(out_of_range.weight_separable(Vector{T(0), T(0), T(1)}) == 0);

    using L = lumis::Lanes<T, 4>;
    const auto [wo, strategy] = reflection<T>(0.6, glm::dvec2{0.2, 0.4});
    const Vector wi = strategy.sample({T(0.3), T(0.6)}).value;
    CHECK(double{strategy.weight(glm::vec<3, L>{wi})[2]} == Approx(double{strategy.weight(wi)}).epsilon(tolerance));
    CHECK(double{strategy.weight_separable(glm::vec<3, L>{wi})[2]} ==
          Approx(double{strategy.weight_separable(wi)}).epsilon(tolerance));
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
