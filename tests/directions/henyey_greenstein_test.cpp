// Henyey and Greenstein's phase function: its angles against the closed form, from evenly to nearly straight, its mean cosine
// and which way it points, and those that are none.
#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/directions/henyey_greenstein.hpp>
#include <lumis/lumis.hpp>
#include <lumis/testing/stability.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <initializer_list>
#include <limits>
#include <numbers>

namespace {

namespace laws = lumis::testing;

// 1 - cos(theta) by the distribution's inverse: d = 1 - 2 g cos(theta) + g^2 is the square of this root.
template <class Wide>
Wide versine_at(Wide g, Wide u) {
    const Wide root = (1 - g) * (1 + g) / (1 - g + 2 * g * (1 - u));
    return (root - (1 - g)) * (root + (1 - g)) / (2 * g);
}

}  // namespace

// Looking along +z. The closed form in long double loses digits itself where u is next to 0 or 1.
TEMPLATE_TEST_CASE("angles keep their digits for every g", "[henyey_greenstein]", float, double) {
    using T = TestType;
    const double epsilon = std::numeric_limits<T>::epsilon();
    const glm::vec<3, T> wo{T(0), T(0), T(-1)};
    const T nearly_one = 1 - std::numeric_limits<T>::epsilon() / 2;
    for (const T g : {T(1e-3), T(0.1), T(-0.1), T(0.5), T(0.9), T(-0.9), T(0.999), T(-0.999), T(1 - 64 * epsilon)}) {
        const lumis::HenyeyGreenstein<T> phase{wo, g};
        for (const T u : {T(1e-6), T(0.01), T(0.3), T(0.5), T(0.9), T(0.999), nearly_one}) {
            INFO("g " << g << ", u " << u);
            const auto drawn = phase.sample({u, T(0)});
            // Negative g: u counts from the peak, which is behind.
            using Wide = long double;
            const Wide versine = versine_at(std::abs(Wide{g}), Wide{u}), sine = std::sqrt(versine * (2 - versine));
            const Wide cosine = g < 0 ? versine - 1 : 1 - versine;
            const double lost = 16 * static_cast<double>(std::numeric_limits<Wide>::epsilon()) /
                                (std::abs(double{g}) * std::fmin(double{u}, 1 - double{u}));
            CHECK(std::abs(double(Wide{drawn.value.x} / sine - 1)) <= 12 * epsilon + lost);
            CHECK(std::abs(double(Wide{drawn.value.z} - cosine)) <= 4 * epsilon + lost);
            const Wide d = (1 - std::abs(Wide{g})) * (1 - std::abs(Wide{g})) + 2 * std::abs(Wide{g}) * versine;
            const Wide density = (1 - Wide{g}) * (1 + Wide{g}) / (4 * std::numbers::pi_v<Wide> * d * std::sqrt(d));
            CHECK(std::abs(double(Wide{drawn.pdf} / density - 1)) <= 12 * epsilon + lost);
        }
    }
}

TEMPLATE_TEST_CASE("g = 0 is the uniform sphere, and its neighbours nearly", "[henyey_greenstein]", float, double) {
    using T = TestType;
    const glm::vec<3, T> wo{T(0.48), T(0.6), T(-0.64)};
    for (const T g : {T(0), std::numeric_limits<T>::denorm_min(), T(-1e-30), T(1e-12)}) {
        const lumis::HenyeyGreenstein<T> phase{wo, g};
        for (const T u : {T(0), T(0.25), T(0.999), T(1)}) {
            const auto drawn = phase.sample({u, T(0.3)});
            CHECK(double{drawn.pdf} == Approx(0.25 / std::numbers::pi).epsilon(1e-6));
            const T cosine = glm::dot(drawn.value, wo) * (g < 0 ? T(-1) : T(1));
            CHECK(double{cosine} == Approx(2 * double{u} - 1).margin(1e-6));
        }
    }
}

// The mean of cos(theta) about -wo is g; that of the square 1/3 + 2/3 g^2.
TEMPLATE_TEST_CASE("the mean cosine is g, forward where positive", "[henyey_greenstein]", float, double) {
    using T = TestType;
    const glm::vec<3, T> wo{T(0.48), T(0.6), T(-0.64)};
    for (const double g : {-0.95, -0.3, 0.0, 0.2, 0.8, 0.99}) {
        INFO("g " << g);
        const lumis::HenyeyGreenstein<T> phase{wo, static_cast<T>(g)};
        double sum = 0, squares = 0, worst = 0;
        constexpr int n = 4000;
        for (int i = 0; i < n; ++i) {
            const T u = (static_cast<T>(i) + T(0.5)) / T(n), turn = static_cast<T>((i * 7919) % n) / T(n);
            const auto drawn = phase.sample({u, turn});
            const double cosine = -glm::dot(glm::dvec3(drawn.value), glm::dvec3(wo));
            sum += cosine / n;
            squares += cosine * cosine / n;
            CHECK(double{phase.pdf(drawn.value) / drawn.pdf} == Approx(1).epsilon(1e-4));
            const auto back = phase.invert(drawn.value);
            worst = std::fmax(worst, std::abs(double{back.x - u}));
            worst = std::fmax(worst, std::abs(std::remainder(double{back.y - turn}, 1)) * double{u * (1 - u)});
        }
        CHECK(std::abs(sum - g) <= 1e-5);
        CHECK(std::abs(squares - (1 + 2 * g * g) / 3) <= 1e-5);
        CHECK(worst <= 40 * double{std::numeric_limits<T>::epsilon()} / (1 - std::abs(g)));
    }
}

// The direction decides on the scalar.
static_assert(
    std::same_as<decltype(lumis::HenyeyGreenstein{lumis::Direction<float>{}, 0.5}), lumis::HenyeyGreenstein<float>>);

TEMPLATE_TEST_CASE("what is no phase function draws nothing", "[henyey_greenstein]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const T nan = std::numeric_limits<T>::quiet_NaN(), infinity = std::numeric_limits<T>::infinity();
    const V up{T(0), T(0), T(1)};
    const CaughtAssertions caught;
    const auto check = [](const V& wo, T g) {
        const auto law = laws::draws_nothing(lumis::HenyeyGreenstein<T>{wo, g});
        INFO(g << ": " << law.message);
        CHECK(law.passed);
    };
    for (const T g : {T(1), T(-1), T(1.5), nan, infinity}) check(up, g);
    for (const V& wo : {V{T(0)}, V{nan, T(0), T(1)}, V{infinity, T(0), T(0)}}) check(wo, T(0.5));
    for (const T g :
         {T(0), T(0.5), 1 - std::numeric_limits<T>::epsilon() / 2, -1 + std::numeric_limits<T>::epsilon()}) {
        const auto law = laws::stays_finite(lumis::HenyeyGreenstein<T>{up, g});
        INFO(g << ": " << law.message);
        CHECK(law.passed);
    }
}
