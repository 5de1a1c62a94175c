// The sun: irradiance by its closed form, alone and in combinations, and suns that are none.
#include "assertions.hpp"
#include "catch.hpp"
#include "irradiance.hpp"
#include <lumis/lights/sun.hpp>
#include <lumis/lumis.hpp>
#include <lumis/testing/stability.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace {

namespace laws = lumis::testing;

constexpr double pi = std::numbers::pi;
const glm::dvec3 aslant{0.48, 0.36, 0.8};

// The midpoint rule over n x n cells of the uniforms.
template <class T>
double irradiance_from(const lumis::Sun<T>& sun, int n) {
    double sum = 0;
    for (int i = 0; i < n * n; ++i) {
        const T x = (static_cast<T>(i % n) + T(0.5)) / static_cast<T>(n);
        const T y = (static_cast<T>(i / n) + T(0.5)) / static_cast<T>(n);
        const auto drawn = sun.sample({x, y});
        if (drawn.pdf > 0) sum += std::max(double{drawn.value.z}, 0.0) / double{drawn.pdf};
    }
    return sum / n / n;
}

}  // namespace

TEMPLATE_TEST_CASE("irradiance from the sun is pi sin^2(half-angle) cos(theta)", "[sun]", float, double) {
    using T = TestType;
    const double epsilon = std::numeric_limits<T>::epsilon();
    for (const double half_angle : {1e-7, 1e-4, 0.00465, 0.1, 0.9}) {
        const lumis::Sun<T> sun{lumis::Direction<T>(aslant), static_cast<T>(half_angle)};
        INFO("half-angle " << half_angle);
        const double sine = std::sin(double{static_cast<T>(half_angle)}), answer = pi * sine * sine * aslant.z;
        CHECK(std::abs(double{sun.projected_solid_angle()} / (pi * sine * sine) - 1) <= 8 * epsilon);
        CHECK(std::abs(irradiance_from(sun, 32) / answer - 1) <= 16 * epsilon);
        const auto drawn = sun.sample({T(0.5), T(0.25)});
        CHECK(drawn.distance == std::numeric_limits<T>::infinity());
        CHECK(sun.distance_along(drawn.value) == std::numeric_limits<T>::infinity());
    }
    CHECK(double{lumis::Sun<T>{{T(0), T(0), T(1)}, T(3)}.projected_solid_angle()} == Approx(pi));
}

// The rim's directions are found though their cosine to the axis is that of directions beyond it.
TEMPLATE_TEST_CASE("the sun ends at its half-angle", "[sun]", float, double) {
    using T = TestType;
    const lumis::Frame<double> frame{aslant};
    const lumis::Sun<T> sun{lumis::Direction<T>(aslant), T(0.00465)};
    for (const double turn : {0.0, 0.3, 0.6, 0.9}) {
        const auto at = [&](double angle) {
            const double x = std::sin(angle) * std::cos(2 * pi * turn), y = std::sin(angle) * std::sin(2 * pi * turn);
            return lumis::Direction<T>(frame.to_world(glm::dvec3{x, y, std::cos(angle)}));
        };
        CHECK(sun.pdf(at(0.00465 * 0.999)) > 0);
        CHECK(sun.pdf(at(0.00465 * 1.001)) == 0);
        CHECK(sun.pdf(lumis::Direction<T>(-at(0.0))) == 0);
    }
}

TEMPLATE_TEST_CASE("the sun among other techniques and lights", "[sun]", float, double) {
    using T = TestType;
    const lumis::Sun<T> sun{lumis::Direction<T>(aslant), T(0.3)};
    const auto cosine_of_sun = [&](const lumis::Direction<T>& w) {
        return sun.pdf(w) > 0 ? std::max(w.z, T(0)) : T(0);
    };
    const double answer = pi * std::pow(std::sin(0.3), 2) * aslant.z;
    const auto direct =
        lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, lumis::CosineHemisphere<T>{}), lumis::take(1, sun));
    irradiance::check_unbiased<T>(
        "beside the BSDF", [&](auto& uniforms) { return direct.estimate(cosine_of_sun, uniforms); }, answer);

    // A second one beside it, in a set: their rims are 0.04 apart.
    const lumis::LightSet set{std::vector{sun, lumis::Sun<T>{{T(0), T(0.6), T(0.8)}, T(0.2)}},
                              std::vector<T>{T(2), T(1)}};
    const auto both = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, set));
    const auto cosine = [](const lumis::Direction<T>& w) { return std::max(w.z, T(0)); };
    irradiance::check_unbiased<T>(
        "in a set", [&](auto& uniforms) { return both.estimate(cosine, uniforms); },
        answer + pi * std::pow(std::sin(0.2), 2) * 0.8);
}

// The direction decides on the scalar.
static_assert(std::same_as<decltype(lumis::Sun{lumis::Direction<float>{}, 0.25}), lumis::Sun<float>>);

TEMPLATE_TEST_CASE("suns that are none", "[sun]", float, double) {
    using T = TestType;
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    const lumis::Direction<T> up{T(0), T(0), T(1)};
    const CaughtAssertions caught;
    using Case = std::pair<lumis::Direction<T>, T>;
    for (const auto& [direction, half_angle] : {Case{up, T(0)},
                                                {up, T(-1)},
                                                {up, nan},
                                                {{T(0), T(0), T(0)}, T(0.1)},
                                                {{nan, T(0), T(1)}, T(0.1)},
                                                {{T(0), inf, T(0)}, T(0.1)}}) {
        const auto law = laws::draws_nothing(lumis::Sun<T>{direction, half_angle});
        INFO(half_angle << ": " << law.message);
        CHECK(law.passed);
    }
}
