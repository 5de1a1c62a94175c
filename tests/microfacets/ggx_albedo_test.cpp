// The fitted albedo of GGX against the closed form and quadrature, and a white furnace with what is lost given back.
#include "assertions.hpp"
#include "catch.hpp"
#include "white_furnace.hpp"
#include <lumis/core/lanes.hpp>
#include <lumis/lumis.hpp>
#include <lumis/microfacets/ggx_albedo.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace {

template <class T>
glm::vec<3, T> towards(double mu, double phi) {
    const double sine = std::sqrt((1 - mu) * (1 + mu));
    return glm::vec<3, T>(glm::dvec3{sine * std::cos(phi), sine * std::sin(phi), mu});
}

template <class T>
double albedo(double mu, glm::dvec2 alpha, double phi = 0.7) {
    return double{lumis::ggx_albedo(lumis::Ggx<T>{glm::vec<2, T>(alpha)}, towards<T>(mu, phi))};
}

// What is reflected to wo of a white sky, over a grid of samples: the mean of their weights.
template <class T, class Fresnel>
double reflected(const lumis::GgxReflection<T>& bsdf, int n, Fresnel fresnel) {
    double sum = 0;
    for (int i = 0; i < n * n; ++i) {
        const glm::dvec2 u{(i % n + 0.5) / n, (i / n + 0.5) / n};
        const auto drawn = bsdf.sample(glm::vec<2, T>(u));
        if (drawn.pdf > 0) sum += double{fresnel(drawn.value) * bsdf.weight(drawn.value)};
    }
    return sum / n / n;
}
template <class T>
double reflected(const lumis::GgxReflection<T>& bsdf, int n) {
    return reflected(bsdf, n, [](const glm::vec<3, T>&) { return T(1); });
}

}  // namespace

TEMPLATE_TEST_CASE("the albedo of roughness 1 has a closed form", "[ggx_albedo]", float, double) {
    using T = TestType;
    double average = 0;
    constexpr int n = 1000;
    for (int i = 0; i < n; ++i) {
        const double mu = (i + 0.5) / n, exact = 1 - mu * std::log1p(1 / mu);
        const double fitted = albedo<T>(mu, glm::dvec2{1});
        CHECK(fitted / exact >= 1);
        CHECK(fitted / exact <= 1.009);
        average += 2 * mu * fitted / n;
    }
    CHECK(std::abs(average / (4 * (1 - std::numbers::ln2) / 3) - 1.004) <= 0.005);
}

TEST_CASE("the albedo of other roughnesses is that of quadrature", "[ggx_albedo]") {
    for (const double alpha : {1e-4, 0.05, 0.2, 0.7}) {
        for (const double mu : {0.02, 0.1, 0.4, 1.0}) {
            INFO("alpha " << alpha << ", mu " << mu);
            const double exact = white_furnace::albedo(towards<double>(mu, 0.7), glm::dvec2{alpha});
            const double fitted = albedo<double>(mu, glm::dvec2{alpha});
            CHECK(fitted / exact >= 1 - 1e-5);
            CHECK(fitted / exact <= 1.009);
            CHECK(std::abs(albedo<float>(mu, glm::dvec2{alpha}) / fitted - 1) <= 5e-5);
        }
    }
}

TEST_CASE("the albedo of two roughnesses is nearly that of quadrature", "[ggx_albedo]") {
    const auto check = [](glm::dvec2 alpha, double too_small, double too_large) {
        for (const double mu : {0.05, 0.2, 0.5, 1.0}) {
            for (const double phi : {0.0, 0.6, 1.2, 1.57}) {
                INFO("alpha " << alpha.x << ", " << alpha.y << ", mu " << mu << ", phi " << phi);
                const double exact = reflected(lumis::GgxReflection<double>{towards<double>(mu, phi), alpha}, 100);
                const double error = albedo<double>(mu, alpha, phi) / exact - 1;
                CHECK(error >= -too_small);
                CHECK(error <= too_large);
            }
        }
    };
    check({0.3, 0.6}, 0.037, 0.04);
    check({1.0, 0.5}, 0.037, 0.04);
    check({0.8, 0.4}, 0.037, 0.045);  // the most of one twice the other
    check({0.05, 0.5}, 0.06, 0.07);
    check({1.0, 0.01}, 0.06, 0.075);
}

TEMPLATE_TEST_CASE("a white metal reflects all of a white sky", "[ggx_albedo]", float, double) {
    using T = TestType;
    const glm::vec<3, T> f0{T(1), T(0.5), T(0)};
    for (const double alpha : {0.001, 0.03, 0.1, 0.3, 0.5, 0.8, 1.0}) {
        for (const double mu : {0.01, 0.1, 0.3, 0.6, 1.0}) {
            INFO("alpha " << alpha << ", mu " << mu);
            const lumis::GgxReflection<T> bsdf{towards<T>(mu, 0.3), static_cast<T>(alpha)};
            const glm::vec<3, T> factor = lumis::ggx_compensation(bsdf.ggx(), towards<T>(mu, 0.3), f0);
            const double single = reflected(bsdf, 100);
            CHECK(single * double{factor.x} >= 0.99);
            CHECK(single * double{factor.x} <= 1.0005);  // the grid's own error
            // Half of what is lost, and nothing.
            CHECK(std::abs(double{factor.y} - 0.5 - double{factor.x} / 2) <= 1e-6);
            CHECK(factor.z == 1);
            CHECK(lumis::ggx_compensation(bsdf.ggx(), towards<T>(mu, 0.3), T(1)) == factor.x);
            CHECK(lumis::ggx_compensation(bsdf.ggx(), towards<T>(mu, 0.3), 1) == factor.x);
        }
    }
}

// No colour returns more light than came, with Schlick's Fresnel term as well.
TEST_CASE("metals with Fresnel reflectance reflect no more than all", "[ggx_albedo]") {
    for (const double f0 : {0.04, 0.5, 1.0}) {
        for (const double alpha : {0.1, 0.5, 1.0}) {
            for (const double mu : {0.05, 0.4, 1.0}) {
                const auto wo = towards<double>(mu, 0.3);
                const lumis::GgxReflection<double> bsdf{wo, alpha};
                const double single = reflected(bsdf, 100, [&](const glm::dvec3& wi) {
                    return f0 + (1 - f0) * std::pow(1 - glm::dot(wo, glm::normalize(wo + wi)), 5);
                });
                const double all = single * lumis::ggx_compensation(bsdf.ggx(), wo, f0);
                CHECK(all >= single);
                CHECK(all <= 1.0005);
            }
        }
    }
}

TEMPLATE_TEST_CASE("albedos from below, out of range, and in lanes", "[ggx_albedo]", float, double) {
    using T = TestType;
    const glm::vec<3, T> wo = towards<T>(0.4, 0.3), below{wo.x, wo.y, -wo.z};
    const lumis::Ggx<T> rough{T(0.5)};
    CHECK(lumis::ggx_albedo(rough, below) == 0);
    CHECK(lumis::ggx_compensation(rough, below, T(1)) == 1);
    CHECK(lumis::ggx_albedo(lumis::Ggx<T>{T(-1)}, wo) == 0);
    CHECK(lumis::ggx_compensation(lumis::Ggx<T>{T(-1)}, wo, T(1)) == 1);
    // It reflects less, and that is not given back.
    CHECK(double{lumis::ggx_albedo(lumis::Ggx<T>{T(3)}, wo)} == Approx(albedo<T>(0.4, glm::dvec2{1})));
    CHECK(lumis::ggx_albedo(rough, {T(1), T(0), std::numeric_limits<T>::denorm_min()}) <= 1);

    using L = lumis::Lanes<T, 4>;
    glm::vec<3, L> directions;
    for (std::size_t i = 0; i < L::size; ++i) {
        const auto w = towards<T>(0.3 * static_cast<double>(i) - 0.1, 0.3);
        for (int k = 0; k < 3; ++k) directions[k].set(i, w[k]);
    }
    const L albedos = lumis::ggx_albedo(rough, directions), factors = lumis::ggx_compensation(rough, directions, 0.5);
    for (std::size_t i = 0; i < L::size; ++i) {
        const glm::vec<3, T> w{directions.x[i], directions.y[i], directions.z[i]};
        CHECK(std::abs(double{albedos[i] - lumis::ggx_albedo(rough, w)}) <= 1e-6);
        CHECK(std::abs(double{factors[i] - lumis::ggx_compensation(rough, w, T(0.5))}) <= 1e-6);
    }
}
