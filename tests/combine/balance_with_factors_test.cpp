#include "assertions.hpp"
#include "catch.hpp"
#include "one_dimensional.hpp"
#include "z_test.hpp"
#include <lumis/combine/heuristics.hpp>
#include <lumis/combine/multi_sample.hpp>
#include <lumis/combine/one_sample.hpp>
#include <lumis/core/lanes.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/lights/area_light.hpp>
#include <lumis/statistics/running_moments.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <span>
#include <tuple>
#include <type_traits>

using lumis::BalanceWithFactors;

namespace {

constexpr std::array<double, 3> factors{0.3, 7, 40};
constexpr BalanceWithFactors<3> heuristic{factors};

static_assert(lumis::Heuristic<BalanceWithFactors<3>, float, float, 3>);
static_assert(std::is_same_v<decltype(BalanceWithFactors{2.0, 1.0}), BalanceWithFactors<2>>);

template <class T>
std::array<T, 3> weights(const std::array<T, 3>& densities) {
    const auto all = std::span<const T>{densities};
    return {lumis::mis_weight(heuristic, 0, all), lumis::mis_weight(heuristic, 1, all),
            lumis::mis_weight(heuristic, 2, all)};
}

template <class T>
std::array<T, 3> random_densities(std::mt19937& engine, double decades) {
    std::uniform_real_distribution<double> exponent{-decades, decades};
    std::array<T, 3> densities;
    for (T& density : densities) density = static_cast<T>(std::pow(10, exponent(engine)));
    densities[engine() % 3] *= T(engine() % 4 > 0);
    return densities;
}

}  // namespace

TEMPLATE_TEST_CASE("weights are in proportion to factor times density", "[heuristics]", float, double) {
    using T = TestType;
    constexpr T epsilon = std::numeric_limits<T>::epsilon();
    std::mt19937 engine{1};
    for (int i = 0; i < 2000; ++i) {
        const auto p = random_densities<T>(engine, i % 2 == 0 ? 3 : std::is_same_v<T, float> ? 37 : 300);
        const auto w = weights(p);
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) sum += factors[k] * (double{p[k]} / 256);
        for (std::size_t k = 0; k < 3; ++k) {
            const double expected = factors[k] * (double{p[k]} / 256) / sum;
            REQUIRE(std::abs(double{w[k]} - expected) <=
                    8 * double{epsilon} * expected + double{std::numeric_limits<T>::min()});
        }
        const std::span<const T, 3> fixed{p};
        REQUIRE(heuristic(1, fixed) == w[1]);
    }
}

TEMPLATE_TEST_CASE("weights do not change with the scale of densities or factors", "[heuristics]", float, double) {
    using T = TestType;
    constexpr T epsilon = std::numeric_limits<T>::epsilon();
    constexpr int range = std::numeric_limits<T>::max_exponent;
    const std::array<T, 3> p{1, T(3e-3), T(0.9)};
    const auto w = weights(p);
    for (int exponent = 12 - range; exponent < range; ++exponent) {
        auto scaled = p;
        for (T& density : scaled) density = std::ldexp(density, exponent - 1);
        const auto v = weights(scaled);
        for (std::size_t k = 0; k < 3; ++k) REQUIRE(std::abs(v[k] - w[k]) <= 4 * epsilon * w[k]);
    }
    const BalanceWithFactors larger{300.0, 7000.0, 40000.0};
    for (std::size_t k = 0; k < 3; ++k) {
        const T weight = lumis::mis_weight(larger, k, std::span<const T>{p});
        CHECK(std::abs(weight - w[k]) <= 4 * epsilon * w[k]);
    }
}

TEMPLATE_TEST_CASE("zero, infinity and NaN as with every heuristic", "[heuristics]", float, double) {
    using T = TestType;
    constexpr T infinity = std::numeric_limits<T>::infinity(), nan = std::numeric_limits<T>::quiet_NaN();
    using Three = std::array<T, 3>;
    CHECK(weights(Three{0, 0, 0}) == Three{0, 0, 0});
    CHECK(weights(Three{0, std::numeric_limits<T>::denorm_min(), 0}) == Three{0, 1, 0});
    CHECK(weights(Three{1, infinity, 2}) == Three{0, 1, 0});
    CHECK(weights(Three{infinity, infinity, 2}) == Three{T(0.5), T(0.5), 0});
    CHECK(weights(Three{std::numeric_limits<T>::max(), 0, 0}) == Three{1, 0, 0});
    const CaughtAssertions caught;
    CHECK(weights(Three{1, nan, infinity}) == Three{0, 0, 0});
    CHECK(caught.count() == 3);
}

TEST_CASE("factors that a density's type does not hold fail an assertion", "[heuristics]") {
    const auto asserted = [](double factor, auto density) {
        const CaughtAssertions caught;
        std::ignore = lumis::mis_weight(BalanceWithFactors{1.0, factor}, density, density);
        return caught.count();
    };
    for (const double factor : {1e-50, 1e50}) {
        CHECK(asserted(factor, 1.0f) == 1);
        CHECK(asserted(factor, 1.0) == 0);
    }
    for (const double factor : {0.0, -1.0, HUGE_VAL}) CHECK(asserted(factor, 1.0) == 1);
    CHECK(asserted(std::nan(""), 1.0) > 0);  // its product with a density is none, too
}

TEST_CASE("factors in lanes", "[heuristics][lanes]") {
    using Lanes = lumis::Lanes<float, 4>;
    std::mt19937 engine{2};
    for (int i = 0; i < 500; ++i) {
        std::array<std::array<float, 3>, 4> each;
        std::array<Lanes, 3> p;
        for (std::size_t lane = 0; lane < 4; ++lane) {
            each[lane] = random_densities<float>(engine, i % 2 == 0 ? 3 : 37);
            for (std::size_t k = 0; k < 3; ++k) p[k].set(lane, each[lane][k]);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const Lanes w = heuristic(k, std::span<const Lanes, 3>{p});
            for (std::size_t lane = 0; lane < 4; ++lane) {
                const float expected = weights(each[lane])[k];
                REQUIRE(std::abs(w[lane] - expected) <= 4e-7f * expected);
            }
        }
    }
}

// The integral of x^2 + 1 over [0, 1] is 4/3.
TEST_CASE("any factors are unbiased", "[heuristics]") {
    const auto f = [](double x) { return x * x + 1; };
    const auto check = [&](const auto& combined, std::uint64_t seed) {
        const auto test = z_test<double>([&](auto& u) { return combined.estimate(f, u); }, 4 / 3.0, seed, 3);
        INFO(test.message);
        CHECK(test.passed);
    };
    const BalanceWithFactors two{5.0, 0.2};
    check(multi_sample(two, lumis::take(1, everywhere), lumis::take(2, Ramp<double>{})), 1);
    check(one_sample(two, lumis::choose(0.3, everywhere), lumis::choose(0.7, Ramp<double>{})), 2);
    check(multi_sample(heuristic, lumis::take(1, everywhere), lumis::take(0, above), lumis::take(1, above)), 3);
}

// A small light: its own samples hardly vary, and the balance heuristic takes a share of the other's noise.
TEST_CASE("variance-aware factors", "[heuristics]") {
    CHECK(lumis::variance_aware_factor(2, 1) == 5);
    CHECK(lumis::variance_aware_factor(0, 1) == 1);
    CHECK(lumis::variance_aware_factor(0, 0) == 1);
    CHECK(lumis::variance_aware_factor(3, 0) == 1e6);
    CHECK(lumis::variance_aware_factor(1e3, 1e-3) == 1e6);
    CHECK(lumis::variance_aware_factor(3, std::numeric_limits<double>::quiet_NaN()) == 1);

    const lumis::AreaLight light{lumis::Parallelogram{glm::dvec3{-1, -1, 8}, glm::dvec3{2, 0, 0}, glm::dvec3{0, 2, 0}},
                                 glm::dvec3{0}};
    const lumis::CosineHemisphere<double> cosine;
    const auto f = [light](const glm::dvec3& w) { return light.pdf(w) > 0 ? w.z : 0.0; };
    // One technique's samples, weighed by the balance heuristic.
    const auto moments = [&](const auto& own, const auto& other) {
        return moments_of<double>(
            [&](auto& u) {
                const auto s = own.sample(u.template next<2>());
                return s.pdf > 0 ? f(s.value) / (s.pdf + other.pdf(s.value)) : 0.0;
            },
            20'000, 4);
    };
    const auto of_cosine = moments(cosine, light), of_light = moments(light, cosine);
    const BalanceWithFactors aware{lumis::variance_aware_factor(of_cosine.mean(), of_cosine.variance()),
                                   lumis::variance_aware_factor(of_light.mean(), of_light.variance())};
    const auto variance = [&](const auto& weighing) {
        const auto combined = multi_sample(weighing, lumis::take(1, cosine), lumis::take(1, light));
        return moments_of<double>([&](auto& u) { return combined.estimate(f, u); }, 20'000, 5).variance();
    };
    CHECK(variance(aware) <= 0.02 * variance(lumis::BalanceHeuristic{}));
    CHECK(variance(aware) <= variance(lumis::PowerHeuristic{}));
}
