// GGX against the textbook's formulas in double (Walter et al. 2007; Heitz 2014), and out of its range.
#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/stability.hpp>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <type_traits>

namespace {

namespace laws = lumis::testing;
using V = glm::dvec3;
constexpr double pi = std::numbers::pi;

namespace textbook {

double tan2_alpha2(const V& w, glm::dvec2 alpha) {
    return (w.x * w.x * alpha.x * alpha.x + w.y * w.y * alpha.y * alpha.y) / (w.z * w.z);
}
double D(const V& m, glm::dvec2 alpha) {
    const double slope = (m.x * m.x / (alpha.x * alpha.x) + m.y * m.y / (alpha.y * alpha.y)) / (m.z * m.z);
    return 1 / (pi * alpha.x * alpha.y * std::pow(m.z, 4) * (1 + slope) * (1 + slope));
}
double lambda(const V& w, glm::dvec2 alpha) {
    return (-1 + std::sqrt(1 + tan2_alpha2(w, alpha))) / 2;
}
double brdf(const V& wo, const V& wi, glm::dvec2 alpha) {
    const double G2 = 1 / (1 + lambda(wo, alpha) + lambda(wi, alpha));
    return D(glm::normalize(wo + wi), alpha) * G2 / (4 * wo.z * wi.z);
}

}  // namespace textbook

V random_direction(std::mt19937_64& engine) {
    std::uniform_real_distribution<double> uniform{0, 1};
    const double z = 0.05 + 0.95 * uniform(engine), phi = 2 * pi * uniform(engine);
    return {std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z};
}

}  // namespace

TEMPLATE_TEST_CASE("GGX equals the textbook", "[ggx]", float, double) {
    using T = TestType;
    const double tolerance = std::is_same_v<T, float> ? 2e-5 : 1e-12;
    std::mt19937_64 engine{1};
    for (const glm::dvec2 alpha : {glm::dvec2{1, 1}, glm::dvec2{0.3, 0.3}, glm::dvec2{0.1, 0.7}}) {
        const lumis::Ggx<T> ggx{glm::vec<2, T>(alpha)};
        for (int i = 0; i < 200; ++i) {
            const V a = random_direction(engine), b = random_direction(engine);
            const glm::vec<3, T> wo(a), wi(b);
            const double lambda_a = textbook::lambda(a, alpha), lambda_b = textbook::lambda(b, alpha);
            CHECK(ggx.D(wo) == Approx(textbook::D(a, alpha)).epsilon(tolerance));
            CHECK(ggx.lambda(wo) == Approx(lambda_a).epsilon(tolerance));
            CHECK(ggx.G1(wo) == Approx(1 / (1 + lambda_a)).epsilon(tolerance));
            CHECK(ggx.G2(wo, wi) == Approx(1 / (1 + lambda_a + lambda_b)).epsilon(tolerance));
            CHECK(ggx.brdf(wo, wi) == Approx(textbook::brdf(a, b, alpha)).epsilon(tolerance));
            const double separable = 1 / ((1 + lambda_a) * (1 + lambda_b));
            CHECK(ggx.G2_separable(wo, wi) == Approx(separable).epsilon(tolerance));
            CHECK(ggx.brdf_separable(wo, wi) ==
                  Approx(textbook::brdf(a, b, alpha) * separable * (1 + lambda_a + lambda_b)).epsilon(tolerance));
            // Heitz 2014, eq. 16; and the reflection of wo about a normal wm, through which wi came.
            const V half = glm::normalize(a + b);
            const double vndf = textbook::D(half, alpha) * glm::dot(a, half) / ((1 + lambda_a) * a.z);
            CHECK(lumis::GgxVndf<T>(wo, ggx.alpha()).pdf(glm::vec<3, T>(half)) == Approx(vndf).epsilon(tolerance));
            CHECK(lumis::GgxReflection<T>(wo, ggx.alpha()).pdf(wi) ==
                  Approx(vndf / (4 * glm::dot(a, half))).epsilon(tolerance));
        }
    }
}

TEMPLATE_TEST_CASE("GGX's normals cover the surface below them", "[ggx]", float, double) {
    using T = TestType;
    for (const double alpha : {0.001, 0.05, 0.4, 1.0}) {
        const lumis::Ggx<T> ggx{glm::vec<2, T>(static_cast<T>(alpha))};
        // In x = tan^2(theta) / alpha^2, mapped from y = x / (1 + x).
        const auto projected = [&](double y) {
            const double tan = alpha * std::sqrt(y / (1 - y)), cosine = 1 / std::sqrt(1 + tan * tan);
            const double D = double{ggx.D({static_cast<T>(cosine * tan), T(0), static_cast<T>(cosine)})};
            return D * std::pow(cosine, 4) * pi * alpha * alpha / ((1 - y) * (1 - y));
        };
        using boost::math::quadrature::gauss_kronrod;
        const double integral = gauss_kronrod<double, 31>::integrate(projected, 0, 1, 5, 1e-6);
        CHECK(integral == Approx(1).epsilon(std::is_same_v<T, float> ? 1e-5 : 1e-9));
    }
}

TEMPLATE_TEST_CASE("GGX roughness out of range", "[ggx]", float, double) {
    using T = TestType;
    const T nan = std::numeric_limits<T>::quiet_NaN(), least = T(lumis::ggx_min_alpha);
    const glm::vec<3, T> wo{T(0.6), T(0), T(0.8)};
    SECTION("too small a roughness is raised, each axis alone") {
        CHECK(lumis::Ggx<T>{{T(0), T(0.5)}}.alpha() == glm::vec<2, T>{least, T(0.5)});
        CHECK(lumis::Ggx<T>{{T(0.5), T(1e-30)}}.alpha() == glm::vec<2, T>{T(0.5), least});
        const lumis::GgxReflection<T> smoothest{wo, {T(0), T(0)}}, least_smooth{wo, {least, least}};
        CHECK(smoothest.sample({T(0.3), T(0.4)}).pdf == least_smooth.sample({T(0.3), T(0.4)}).pdf);
        CHECK(smoothest.sample({T(0.3), T(0.4)}).pdf > 0);
    }
    SECTION("others draw nothing") {
        for (const T alpha : {T(-1), T(-1e-6), nan, T(1e9), std::numeric_limits<T>::infinity()}) {
            for (const auto& both : {glm::vec<2, T>{alpha, alpha}, glm::vec<2, T>{T(0.5), alpha}}) {
                const CaughtAssertions caught;  // of NaN
                const lumis::Ggx<T> ggx{both};
                CHECK(ggx.D({T(0), T(0), T(1)}) == 0);
                CHECK(ggx.G1(wo) == 0);
                CHECK(ggx.brdf(wo, wo) == 0);
                for (const auto& law : {laws::draws_nothing(lumis::GgxVndf<T>{wo, both}),
                                        laws::draws_nothing(lumis::GgxReflection<T>{wo, both})}) {
                    INFO("alpha " << both.x << ", " << both.y << ": " << law.message);
                    CHECK(law.passed);
                }
            }
        }
    }
}

TEMPLATE_TEST_CASE("GGX seen from on or below the horizon draws nothing", "[ggx]", float, double) {
    using T = TestType;
    const T nan = std::numeric_limits<T>::quiet_NaN();
    for (const auto& wo :
         {glm::vec<3, T>{T(1), T(0), T(0)}, glm::vec<3, T>{T(0.6), T(0), T(-0.8)}, glm::vec<3, T>{T(0), T(0), T(-1)},
          glm::vec<3, T>{nan, nan, nan}, glm::vec<3, T>{T(0), T(0), T(0)}}) {
        for (const T alpha : {T(0), T(0.01), T(1)}) {
            const glm::vec<2, T> both{alpha, alpha};
            const CaughtAssertions caught;  // of NaN and of the zero vector
            for (const auto& law : {laws::draws_nothing(lumis::GgxVndf<T>{wo, both}),
                                    laws::draws_nothing(lumis::GgxReflection<T>{wo, both})}) {
                INFO("wo " << wo.x << ", " << wo.y << ", " << wo.z << ": " << law.message);
                CHECK(law.passed);
            }
        }
    }
}

TEMPLATE_TEST_CASE("GGX stays finite from mirror to rough, from above to grazing", "[ggx]", float, double) {
    using T = TestType;
    const T smallest = std::numeric_limits<T>::denorm_min(), largest = T(lumis::ggx_max_alpha);
    for (const double cosine : {1.0, 0.5, 1e-2, 1e-4, 1e-6, 1e-12, 1e-30, 1e-40}) {
        const T z = std::max(static_cast<T>(cosine), smallest);
        const T sine = static_cast<T>(std::sqrt(1 - cosine * cosine));
        for (const T alpha_x : {T(1e-6), T(1e-4), T(1e-2), T(1), largest}) {
            for (const T alpha_y : {T(0), T(1e-3), T(1), largest}) {
                const glm::vec<2, T> alpha{alpha_x, alpha_y};
                const glm::vec<3, T> wo{sine * T(0.8), sine * T(0.6), z};
                for (const auto& law : {laws::stays_finite(lumis::GgxVndf<T>{wo, alpha}, 200),
                                        laws::stays_finite(lumis::GgxReflection<T>{wo, alpha}, 200)}) {
                    INFO("cosine " << z << ", alpha " << alpha_x << ", " << alpha_y << ": " << law.message);
                    CHECK(law.passed);
                }
            }
        }
    }
}
