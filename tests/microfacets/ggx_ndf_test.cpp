// All GGX normals: the textbook's density, the textbook's map, and what they reflect of a white sky.
#include "assertions.hpp"
#include "catch.hpp"
#include "irradiance.hpp"
#include "white_furnace.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/stability.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace {

namespace laws = lumis::testing;

constexpr glm::dvec2 roughnesses[] = {{1, 1},       {0.5, 0.5},  {0.1, 0.1}, {1e-2, 1e-2}, {1e-3, 1e-3},
                                      {1e-4, 1e-4}, {0.05, 0.6}, {1, 1e-3},  {5, 0.2}};

// Walter et al. 2007, eq. 33, anisotropic (Heitz 2014, eq. 85), times the cosine.
template <class T>
long double textbook_pdf(const glm::vec<3, T>& wm, const glm::vec<2, T>& alpha) {
    const long double z = wm.z, ax = alpha.x, ay = alpha.y;
    const long double slope = (wm.x / (ax * z)) * (wm.x / (ax * z)) + (wm.y / (ay * z)) * (wm.y / (ay * z));
    return z / (std::numbers::pi_v<long double> * ax * ay * z * z * z * z * (1 + slope) * (1 + slope));
}

}  // namespace

TEMPLATE_TEST_CASE("the density of GGX normals is the textbook's at every roughness", "[ggx_ndf]", float, double) {
    using T = TestType;
    lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{3}};
    for (const auto& alpha : roughnesses) {
        const glm::vec<2, T> rough(alpha);
        const lumis::GgxNdf<T> ndf{rough};
        double worst = 0;
        for (int i = 0; i < 4000; ++i) {
            // Half of them drawn, half from all over the hemisphere.
            const auto u = uniforms.template next<2>();
            const glm::vec<3, T> wm = i % 2 == 0 ? ndf.sample(u).value : lumis::UniformHemisphere<T>{}.sample(u).value;
            if (!(wm.z > T(1e-3))) continue;
            const long double reference = textbook_pdf(wm, rough);
            worst = std::fmax(worst, static_cast<double>(std::abs(ndf.pdf(wm) / reference - 1)));
        }
        INFO("alpha " << alpha.x << ", " << alpha.y);
        CHECK(worst <= 16 * double{std::numeric_limits<T>::epsilon()});
        CHECK(ndf.pdf({T(0), T(0), T(-1)}) == 0);
        CHECK(ndf.pdf({T(1), T(0), T(0)}) == 0);
    }
}

// tan(theta) = alpha sqrt(u / (1 - u)) along each axis of the ellipse, in long double.
TEMPLATE_TEST_CASE("where a uniform puts a GGX normal", "[ggx_ndf]", float, double) {
    using T = TestType;
    const double epsilon = std::numeric_limits<T>::epsilon();
    lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{4}};
    for (const auto& alpha : roughnesses) {
        const lumis::GgxNdf<T> ndf{glm::vec<2, T>(alpha)};
        double worst = 0, worst_return = 0;
        for (int i = 0; i < 2000; ++i) {
            const auto u = uniforms.template next<2>();
            const long double ux = u.x, slope = std::sqrt(ux / (1 - ux));
            const long double phi = 2 * std::numbers::pi_v<long double> * u.y;
            const glm::vec<3, long double> expected = glm::normalize(glm::vec<3, long double>{
                static_cast<T>(alpha.x) * slope * std::cos(phi), static_cast<T>(alpha.y) * slope * std::sin(phi), 1});
            const auto sample = ndf.sample(u);
            const glm::vec<3, long double> error = glm::vec<3, long double>(sample.value) - expected;
            // In units of the lobe's own width along each axis, out to this normal.
            const double reach = static_cast<double>(slope);
            worst = std::fmax(worst, static_cast<double>(std::abs(error.x)) / std::fmin(alpha.x * reach, 1));
            worst = std::fmax(worst, static_cast<double>(std::abs(error.y)) / std::fmin(alpha.y * reach, 1));
            worst = std::fmax(worst, static_cast<double>(std::abs(error.z)));
            const auto again = ndf.invert(sample.value);
            const double turn = std::abs(double{again.y} - double{u.y});
            worst_return = std::fmax(worst_return, std::abs(double{again.x} - double{u.x}));
            worst_return = std::fmax(worst_return, std::fmin(turn, 1 - turn) * std::sqrt(double{u.x}));
            if (!(again.x >= 0 && again.y >= 0)) worst_return = 1;
        }
        INFO("alpha " << alpha.x << ", " << alpha.y << ": " << worst / epsilon << ", " << worst_return / epsilon);
        CHECK(worst <= 20 * epsilon);
        CHECK(worst_return <= 20 * epsilon);
    }
}

TEMPLATE_TEST_CASE("the albedo of GGX by all its normals", "[ggx_ndf]", float, double) {
    using T = TestType;
    for (const auto& alpha : {glm::dvec2{1, 1}, glm::dvec2{0.5, 0.5}, glm::dvec2{0.1, 0.4}}) {
        for (const double mu : {1.0, 0.5}) {
            const double s = std::sqrt(1 - mu * mu);
            const glm::dvec3 wo{0.6 * s, 0.8 * s, mu};
            const glm::vec<3, T> view(wo);
            const lumis::GgxNdf<T> ndf{glm::vec<2, T>(alpha)};
            const lumis::Reflected strategy{view, ndf};
            const auto f = [&](const glm::vec<3, T>& wi) { return ndf.ggx().brdf(view, wi) * wi.z; };
            const auto alone = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, strategy));
            irradiance::check_unbiased<T>(
                laws::detail::text("mu ", mu, ", alpha ", alpha),
                [&](auto& uniforms) { return alone.estimate(f, uniforms); }, white_furnace::albedo(wo, alpha));
        }
    }
}

TEMPLATE_TEST_CASE("GGX normals of a roughness out of range are none", "[ggx_ndf]", float, double) {
    using T = TestType;
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    const auto check = [](const laws::LawResult& law) {
        INFO(law.message);
        CHECK(law.passed);
    };
    for (const T alpha : {T(-1), T(1.1e4), inf, nan}) {
        const CaughtAssertions caught;  // of NaN
        check(laws::draws_nothing(lumis::GgxNdf<T>{{alpha, T(0.5)}}));
        check(laws::draws_nothing(lumis::GgxNdf<T>{{T(0.5), alpha}}));
    }
    for (const T alpha : {T(0), T(1e-6), T(1e-4), T(1), T(1e4)}) {
        check(laws::stays_finite(lumis::GgxNdf<T>{{alpha, alpha}}));
        check(laws::stays_finite(lumis::GgxNdf<T>{{alpha, T(1)}}));
        // A raised roughness is as if it had been given.
        const T raised = std::max(alpha, T(lumis::ggx_min_alpha));
        const glm::vec<3, T> wm = lumis::GgxNdf<T>{{raised, T(1)}}.sample({T(0.3), T(0.1)}).value;
        CHECK(lumis::GgxNdf<T>{{alpha, T(1)}}.pdf(wm) == lumis::GgxNdf<T>{{raised, T(1)}}.pdf(wm));
    }
}
