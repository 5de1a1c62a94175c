#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/combine/heuristics.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <tuple>
#include <type_traits>
#include <vector>

namespace {

template <class T>
constexpr T infinity = std::numeric_limits<T>::infinity();
template <class T>
constexpr T not_a_number = std::numeric_limits<T>::quiet_NaN();
template <class T>
constexpr T epsilon = std::numeric_limits<T>::epsilon();

const std::tuple heuristics{lumis::BalanceHeuristic{},   lumis::PowerHeuristic{},   lumis::PowerHeuristic{1.5},
                            lumis::PowerHeuristic{5},    lumis::MaximumHeuristic{}, lumis::CutoffHeuristic{},
                            lumis::CutoffHeuristic{0.5}, lumis::EqualWeights{}};

// By how much the weights of three densities may change when all are scaled by a power of two. Not at all, unless the
// compiler fuses products into sums: it may do so in the short way but not in the scaled one. Either is then within five
// roundings of the exact weight: one of the square, three of the sum, one of the quotient.
#ifdef __FMA__
template <class T>
constexpr T by_fusing = 5 * epsilon<T>;
#else
template <class T>
constexpr T by_fusing = 0;
#endif

template <class Check>
void for_each_heuristic(Check check) {
    std::apply([&](const auto&... heuristic) { (check(heuristic), ...); }, heuristics);
}

template <class H, class T>
std::vector<T> weights(const H& heuristic, const std::vector<T>& densities) {
    std::vector<T> result;
    for (std::size_t i = 0; i < densities.size(); ++i) {
        result.push_back(lumis::mis_weight(heuristic, i, std::span<const T>{densities}));
    }
    return result;
}

// Spread evenly over decades; a few are 0, but not all.
template <class T>
std::vector<T> random_densities(std::size_t size, double decades, std::mt19937& engine) {
    std::uniform_real_distribution<double> exponent{-decades, decades}, uniform{0, 1};
    std::vector<T> densities(size);
    for (T& density : densities)
        density = uniform(engine) < 0.2 ? T(0) : static_cast<T>(std::pow(10, exponent(engine)));
    densities[size / 2] = static_cast<T>(std::pow(10, exponent(engine)));
    return densities;
}

}  // namespace

TEMPLATE_TEST_CASE("weights are shares that sum to 1 over all decades of densities", "[heuristics]", float, double) {
    using T = TestType;
    const double widest = std::is_same_v<T, float> ? 38 : 300;
    std::mt19937 engine{1};
    for_each_heuristic([&](const auto& heuristic) {
        for (const std::size_t size : {1u, 2u, 3u, 8u, 300u}) {
            for (const double decades : {1.0, 8.0, widest}) {
                const int rounds = size > 8 ? 20 : 1000;
                double worst = 0;
                bool in_range = true, zero_for_zero = true;
                for (int round = 0; round < rounds; ++round) {
                    const auto p = random_densities<T>(size, decades, engine);
                    const auto w = weights(heuristic, p);
                    for (std::size_t i = 0; i < size; ++i) {
                        in_range = in_range && w[i] >= 0 && w[i] <= 1;
                        zero_for_zero = zero_for_zero && (p[i] > 0 || w[i] == 0);
                    }
                    const double sum = std::accumulate(w.begin(), w.end(), 0.0);
                    worst = std::abs(sum - 1) <= worst ? worst : std::abs(sum - 1);
                }
                INFO(size << " techniques, densities from 1e-" << decades << " to 1e" << decades);
                CHECK(in_range);
                CHECK(zero_for_zero);
                CHECK(worst <= (size > 8 ? 32 : 4) * double{epsilon<T>});
            }
        }
    });
}

TEMPLATE_TEST_CASE("weights follow their definitions", "[heuristics]", float, double) {
    using T = TestType;
    std::mt19937 engine{2};
    const auto check = [&](const auto& heuristic, auto share) {
        for (int round = 0; round < 1000; ++round) {
            const auto p = random_densities<T>(4, 6, engine);
            const auto w = weights(heuristic, p);
            const double largest = double{*std::ranges::max_element(p)};
            double sum = 0;
            for (const T density : p) sum += share(double{density}, largest);
            for (std::size_t i = 0; i < p.size(); ++i) {
                const double expected = share(double{p[i]}, largest) / sum;
                REQUIRE(std::abs(double{w[i]} - expected) <= 32 * double{epsilon<T>} * expected);
            }
        }
    };
    check(lumis::BalanceHeuristic{}, [](double p, double) { return p; });
    check(lumis::PowerHeuristic{}, [](double p, double) { return p * p; });
    check(lumis::PowerHeuristic{1.5}, [](double p, double) { return std::pow(p, 1.5); });
    check(lumis::MaximumHeuristic{}, [](double p, double largest) { return p == largest ? 1.0 : 0.0; });
    check(lumis::CutoffHeuristic{0.01}, [](double p, double largest) { return p < 0.01 * largest ? 0.0 : p; });
    check(lumis::EqualWeights{}, [](double p, double) { return p > 0 ? 1.0 : 0.0; });
}

TEMPLATE_TEST_CASE("weights do not change with the scale of the densities", "[heuristics]", float, double) {
    using T = TestType;
    std::mt19937 engine{3};
    for_each_heuristic([&](const auto& heuristic) {
        for (int round = 0; round < 1000; ++round) {
            const auto p = random_densities<T>(3, 6, engine);
            const auto w = weights(heuristic, p);
            for (const int exponent : {-100, 100}) {
                auto scaled = p;
                for (T& density : scaled) density = std::ldexp(density, exponent);
                const auto v = weights(heuristic, scaled);
                for (std::size_t i = 0; i < p.size(); ++i) REQUIRE(std::abs(v[i] - w[i]) <= by_fusing<T> * w[i]);
            }
            for (const T factor : {T(1e-30), T(1e30)}) {
                auto scaled = p;
                for (T& density : scaled) density *= factor;
                const auto v = weights(heuristic, scaled);
                for (std::size_t i = 0; i < p.size(); ++i) REQUIRE(std::abs(v[i] - w[i]) <= 16 * epsilon<T> * w[i]);
            }
        }
    });
    // At every scale on the way there, subnormal squares and overflowing sums among them.
    for_each_heuristic([](const auto& heuristic) {
        const std::vector<T> p{1, T(3e-3), T(0.9), T(0.8), T(0.7), T(0.7), 0};
        const auto w = weights(heuristic, p);
        constexpr int range = std::numeric_limits<T>::max_exponent;
        for (int exponent = 12 - range; exponent < range - 1; ++exponent) {
            auto scaled = p;
            for (T& density : scaled) density = std::ldexp(density, exponent);
            const auto v = weights(heuristic, scaled);
            for (std::size_t i = 0; i < p.size(); ++i) REQUIRE(std::abs(v[i] - w[i]) <= 2 * epsilon<T> * w[i]);
        }
    });
    // Squares of these overflow or vanish.
    const T large = std::numeric_limits<T>::max() / 2, small = std::numeric_limits<T>::min();
    CHECK(lumis::mis_weight(lumis::PowerHeuristic{}, large, large) == T(0.5));
    CHECK(lumis::mis_weight(lumis::PowerHeuristic{}, small, small) == T(0.5));
    CHECK(lumis::mis_weight(lumis::BalanceHeuristic{}, large, large, large, large) == T(0.25));
    CHECK(lumis::mis_weight(lumis::PowerHeuristic{}, large, small) == 1);
    CHECK(lumis::mis_weight(lumis::PowerHeuristic{}, small, large) == 0);
}

TEMPLATE_TEST_CASE("a zero against zeros weighs nothing", "[heuristics]", float, double) {
    using T = TestType;
    for_each_heuristic([](const auto& heuristic) {
        CHECK(lumis::mis_weight(heuristic, T(0)) == 0);
        CHECK(lumis::mis_weight(heuristic, T(0), T(0)) == 0);
        CHECK(weights(heuristic, std::vector<T>(300)) == std::vector<T>(300));
        CHECK(lumis::mis_weight(heuristic, std::numeric_limits<T>::denorm_min(), T(0)) == 1);
        CHECK(lumis::mis_weight(heuristic, T(0), infinity<T>) == 0);
    });
}

TEMPLATE_TEST_CASE("an infinite density takes all, several share", "[heuristics]", float, double) {
    using T = TestType;
    for_each_heuristic([](const auto& heuristic) {
        const T inf = infinity<T>, large = std::numeric_limits<T>::max();
        CHECK(weights(heuristic, std::vector<T>{inf}) == std::vector<T>{1});
        CHECK(weights(heuristic, std::vector<T>{inf, large}) == std::vector<T>{1, 0});
        CHECK(weights(heuristic, std::vector<T>{1, inf, 0}) == std::vector<T>{0, 1, 0});
        CHECK(weights(heuristic, std::vector<T>{inf, 1, inf, 0, inf, inf}) ==
              std::vector<T>{T(0.25), 0, T(0.25), 0, T(0.25), T(0.25)});
    });
}

TEMPLATE_TEST_CASE("NaN weighs nothing and fails an assertion wherever it stands", "[heuristics]", float, double) {
    using T = TestType;
    for_each_heuristic([](const auto& heuristic) {
        for (const std::array<T, 3> others : {std::array<T, 3>{1, 2, 3}, {0, 0, 0}, {3, 1, 0}, {1, infinity<T>, 2}}) {
            for (std::size_t position = 0; position < 3; ++position) {
                std::vector<T> p{others.begin(), others.end()};
                p[position] = not_a_number<T>;
                for (std::size_t own = 0; own < 3; ++own) {
                    const CaughtAssertions caught;
                    CHECK(lumis::mis_weight(heuristic, own, std::span<const T>{p}) == 0);
                    CHECK(caught.count() >= 1);
                }
            }
        }
    });
    const CaughtAssertions caught;
    CHECK(lumis::mis_weight(lumis::BalanceHeuristic{}, T(1), T(2), infinity<T>) == 0);
    CHECK(caught.count() == 0);
}

TEMPLATE_TEST_CASE("equal densities share evenly in any order", "[heuristics]", float, double) {
    using T = TestType;
    for_each_heuristic([](const auto& heuristic) {
        for (const std::size_t size : {2u, 3u, 700u}) {
            const auto w = weights(heuristic, std::vector<T>(size, T(0.3)));
            for (const T weight : w) REQUIRE(std::abs(weight * static_cast<T>(size) - 1) <= 2 * epsilon<T>);
        }
    });
    // The technique at hand comes first here, so a tie must not go to the first.
    CHECK(lumis::mis_weight(lumis::MaximumHeuristic{}, T(2), T(2), T(1)) == T(0.5));
}

TEMPLATE_TEST_CASE("the two forms of mis_weight agree", "[heuristics]", float, double) {
    using T = TestType;
    for_each_heuristic([](const auto& heuristic) {
        const std::array<T, 4> p{T(0.1), 3, T(1e-20), 7};
        const std::span<const T> all{p};
        const auto agree = [](T a, T b) { return std::abs(a - b) <= 4 * epsilon<T> * b; };
        CHECK(lumis::mis_weight(heuristic, 0, all) == lumis::mis_weight(heuristic, p[0], p[1], p[2], p[3]));
        CHECK(agree(lumis::mis_weight(heuristic, 1, all), lumis::mis_weight(heuristic, p[1], p[0], p[2], p[3])));
        CHECK(agree(lumis::mis_weight(heuristic, 3, all), lumis::mis_weight(heuristic, p[3], p[0], p[1], p[2])));
    });
}

TEST_CASE("PartitionWeights asks the owner and nothing else", "[heuristics]") {
    const lumis::PartitionWeights by_half{[](double x) { return x < 0.5 ? 0 : 1; }};
    static_assert(lumis::PointHeuristic<decltype(by_half), double>);
    static_assert(!lumis::PointHeuristic<lumis::BalanceHeuristic, double>);
    CHECK(by_half.owns(0, 0.25));
    CHECK_FALSE(by_half.owns(1, 0.25));
    CHECK(by_half.owns(1, 0.75));
    CHECK_FALSE(by_half.owns(0, 0.75));
}
