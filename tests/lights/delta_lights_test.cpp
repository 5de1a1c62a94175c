// Lights without extent, alone and beside mirrors and smooth lobes: what comes out is the analytic value.
#include "assertions.hpp"
#include "catch.hpp"
#include "irradiance.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/stability.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace {

constexpr double pi = std::numbers::pi;

template <class T>
constexpr glm::vec<3, T> origin{T(0), T(0), T(0)};

template <class T>
double tolerance() {
    return 16 * double{std::numeric_limits<T>::epsilon()};
}

}  // namespace

TEMPLATE_TEST_CASE("irradiance from a point light at any distance", "[delta_lights]", float, double) {
    using T = TestType;
    for (const double distance : {1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e12}) {
        const glm::dvec3 towards{0.48, 0.64, 0.6};
        const glm::vec<3, T> position(distance * towards);
        const lumis::PointLight light{position, origin<T>};
        static_assert(lumis::DeltaStrategy<decltype(light)>);
        const auto sample = light.sample({T(0.3), T(0.9)});
        CHECK(sample.pdf == 1);
        CHECK(std::abs(double{sample.distance} / distance - 1) <= tolerance<T>());
        CHECK(glm::length(glm::dvec3{sample.value} - towards) <= tolerance<T>());
        CHECK(light.pdf(sample.value) == 0);
        // Intensity distance^2: an irradiance of cos(theta).
        const auto f = [&](const lumis::AnySample auto& s, lumis::delta_t) {
            return static_cast<T>(distance * distance) / (s.distance * s.distance) * s.value.z;
        };
        auto uniforms = irradiance::uniforms<T>(1);
        const auto direct = lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, light));
        CHECK(std::abs(double{direct.estimate(f, uniforms)} / 0.6 - 1) <= 4 * tolerance<T>());
        const auto thrice = lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(3, light));
        CHECK(std::abs(double{thrice.estimate(f, uniforms)} / 0.6 - 1) <= 4 * tolerance<T>());
    }
    // Relative to where it is seen from.
    const glm::vec<3, T> from{T(1), T(2), T(3)}, to{T(1), T(2), T(7)};
    const auto sample = lumis::PointLight{to, from}.sample({T(0), T(1)});
    CHECK(sample.value == glm::vec<3, T>{T(0), T(0), T(1)});
    CHECK(sample.distance == T(4));
}

TEMPLATE_TEST_CASE("point lights that are nowhere draw nothing", "[delta_lights]", float, double) {
    using T = TestType;
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    const glm::vec<3, T> here{T(1), T(-2), T(3)};
    const glm::vec<3, T> others[] = {here, {nan, T(0), T(0)}, {T(0), inf, T(0)}, {T(0), T(0), -inf}};
    for (const auto& other : others) {
        const CaughtAssertions caught;  // of NaN
        for (const auto& light : {lumis::PointLight{other, here}, lumis::PointLight{here, other}}) {
            const auto law = lumis::testing::draws_nothing(light, 10);
            INFO(law.message);
            CHECK(law.passed);
        }
    }
    // Whatever the distance: a unit direction, or nothing.
    for (int exponent = std::numeric_limits<T>::min_exponent10; exponent <= std::numeric_limits<T>::max_exponent10;
         ++exponent) {
        const T d = static_cast<T>(std::pow(10.0, exponent));
        const auto sample = lumis::PointLight{glm::vec<3, T>{d, -d, T(0.5) * d}, origin<T>}.sample({T(0), T(0)});
        INFO("1e" << exponent);
        const bool in_middle = 3 * exponent < std::numeric_limits<T>::max_exponent10 &&
                               3 * exponent > std::numeric_limits<T>::min_exponent10;
        CHECK((sample.pdf == 1 || (sample.pdf == 0 && !in_middle)));
        if (sample.pdf > 0) {
            CHECK(std::abs(glm::length(glm::dvec3{sample.value}) - 1) <= tolerance<T>());
            CHECK(std::abs(double{sample.distance} / (1.5 * double{d}) - 1) <= tolerance<T>());
        }
    }
}

TEMPLATE_TEST_CASE("a directional light comes from where it is told", "[delta_lights]", float, double) {
    using T = TestType;
    const glm::vec<3, T> towards{T(0.48), T(-0.64), T(0.6)};
    const lumis::DirectionalLight<T> sun{towards};
    static_assert(lumis::DeltaStrategy<lumis::DirectionalLight<T>>);
    for (const T u : {T(0), T(0.5), T(1)}) {
        const auto sample = sun.sample({u, u});
        CHECK((sample.value == towards && sample.pdf == 1 && std::isinf(sample.distance)));
    }
    CHECK(sun.pdf(towards) == 0);
    auto uniforms = irradiance::uniforms<T>(1);
    const auto direct = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(2, sun));
    const auto f = [](const glm::vec<3, T>& w, lumis::delta_t) { return 5 * w.z; };
    CHECK(std::abs(double{direct.estimate(f, uniforms)} - 3) <= tolerance<T>());
    const CaughtAssertions caught;
    const auto law = lumis::testing::draws_nothing(
        lumis::DirectionalLight<T>{glm::vec<3, T>{std::numeric_limits<T>::quiet_NaN(), T(0), T(1)}}, 10);
    CHECK(law.passed);
}

// A mirror under a point light and a sky: the mirror sees the sky alone, the light lights the diffuse part alone, and no
// weight of one takes from another.
TEMPLATE_TEST_CASE("mirror and point light and sky at once", "[delta_lights]", float, double) {
    using T = TestType;
    const glm::vec<3, T> wo{T(0.6), T(0), T(0.8)};
    const lumis::PerfectReflection<T> mirror{wo};
    const lumis::PointLight light{glm::vec<3, T>{T(0), T(0), T(2)}, origin<T>};
    const lumis::CosineHemisphere<T> diffuse;
    const T reflectance = T(0.3), albedo = T(0.5), intensity = T(8), sky = T(2);
    // Told apart by where they come from: a mirror's coefficient is radiance times reflectance.
    const auto f = [&](const lumis::AnySample auto& sample, auto... is_delta) -> T {
        if constexpr (sizeof...(is_delta) == 0) {
            return albedo / static_cast<T>(pi) * sky * std::max(sample.value.z, T(0));
        } else if constexpr (requires { sample.distance; }) {
            return albedo / static_cast<T>(pi) * intensity / (sample.distance * sample.distance) * sample.value.z;
        } else {
            return reflectance * sky;
        }
    };
    const double lit = 0.5 / pi * 8 / 4, diffused = 0.5 * 2, mirrored = 0.3 * 2;
    auto uniforms = irradiance::uniforms<T>(1);
    // The cosine strategy is exact for a diffuse surface under an even sky, so that every estimate is the answer.
    const auto all = lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, mirror), lumis::take(2, light),
                                         lumis::take(3, diffuse));
    for (int i = 0; i < 100; ++i) {
        CHECK(std::abs(double{all.estimate(f, uniforms)} - (lit + diffused + mirrored)) <= 8 * tolerance<T>());
    }
    const auto two = lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, mirror), lumis::take(1, light));
    CHECK(std::abs(double{two.estimate(f, uniforms)} - (lit + mirrored)) <= 8 * tolerance<T>());
}

// By selection, with probabilities that have nothing to do with densities: from rare to certain.
TEMPLATE_TEST_CASE("a mixture of mirror and smooth lobe by selection is the analytic value", "[delta_lights]", float,
                   double) {
    using T = TestType;
    const glm::vec<3, T> wo{T(0.6), T(0), T(0.8)};
    const lumis::PerfectReflection<T> mirror{wo};
    const lumis::CosineHemisphere<T> diffuse;
    const lumis::UniformHemisphere<T> even;
    const auto f = [](const auto& w, auto... is_delta) -> T {
        return sizeof...(is_delta) > 0 ? T(0.3) : T(0.5) / static_cast<T>(pi) * std::max(w.z, T(0));
    };
    for (const double c : {0.05, 0.4, 0.9}) {
        const auto both =
            lumis::one_sample(lumis::PowerHeuristic{}, lumis::choose(c, mirror), lumis::choose(1 - c, diffuse));
        irradiance::check_unbiased<T>(
            lumis::testing::detail::text("two, mirror at ", c),
            [&](auto& uniforms) { return both.estimate(f, uniforms); }, 0.8);
        const auto three = lumis::one_sample(lumis::BalanceHeuristic{}, lumis::choose(c, mirror),
                                             lumis::choose((1 - c) / 3, diffuse), lumis::choose((1 - c) * 2 / 3, even));
        irradiance::check_unbiased<T>(
            lumis::testing::detail::text("three, mirror at ", c),
            [&](auto& uniforms) { return three.estimate(f, uniforms); }, 0.8);
    }
    auto uniforms = irradiance::uniforms<T>(1);
    const auto none = lumis::one_sample(lumis::PowerHeuristic{}, lumis::choose(0, mirror), lumis::choose(1, diffuse));
    const auto only = lumis::one_sample(lumis::PowerHeuristic{}, lumis::choose(1, mirror), lumis::choose(0, diffuse));
    for (int i = 0; i < 100; ++i) {
        CHECK(std::abs(double{none.estimate(f, uniforms)} - 0.5) <= 4 * tolerance<T>());
        CHECK(std::abs(double{only.estimate(f, uniforms)} - 0.3) <= 4 * tolerance<T>());
    }
}
