#include "assertions.hpp"
#include "catch.hpp"
#include "instrumented.hpp"
#include "optimal_subjects.hpp"
#include <lumis/combine/optimal.hpp>
#include <lumis/core/lanes.hpp>
#include <lumis/statistics/running_moments.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <span>
#include <vector>

using lumis::take;

namespace {

const auto exponential = [](double x) { return std::exp(x); };
const auto techniques = lumis::rounds_of(take(2, Monomial{1}), take(1, Monomial{2}), take(0, Monomial{3}));
using Pixel = lumis::CrossFitted<double, 3>;
using OneRound = lumis::Round<double, 3>;

std::vector<OneRound> rounds(std::size_t count, unsigned seed) {
    lumis::Uniforms<std::mt19937_64, double> uniforms{std::mt19937_64{seed}};
    std::vector<OneRound> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(techniques.round(exponential, uniforms));
    return result;
}

Pixel sum_of(std::span<const OneRound> some) {
    Pixel pixel;
    for (const OneRound& round : some) pixel.add(round);
    return pixel;
}

bool agree(double a, double b) {
    return std::abs(a - b) <= 1e-10 * std::abs(b);
}

// A float's digits, the last component exactly.
bool nearly(const glm::vec3& a, const glm::vec3& b) {
    return std::abs(a.x - b.x) <= 1e-6f * std::abs(b.x) && std::abs(a.y - b.y) <= 1e-6f * std::abs(b.y) && a.z == b.z;
}

void check_same(const Pixel& a, const Pixel& b) {
    CHECK(a.rounds() == b.rounds());
    CHECK(agree(a.estimate(), b.estimate()));
    CHECK(agree(a.standard_error(), b.standard_error()));
    CHECK(agree(a.estimate({}), b.estimate({})));
    CHECK(agree(a.standard_error({1, 2, 3}), b.standard_error({1, 2, 3})));
    CHECK(agree(a.control_standard_error(2), b.control_standard_error(2)));
    for (std::size_t k = 0; k < 3; ++k) CHECK(agree(a.weights()[k], b.weights()[k]));
}

}  // namespace

TEST_CASE("each fold takes its weights from the others", "[cross_fitted]") {
    // All counts up to a few rounds a fold, and one of many.
    for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 100u}) {
        const auto all = rounds(count, 1);
        lumis::RunningMoments<double> moments;
        for (std::size_t fold = 0; fold < Pixel::folds; ++fold) {
            std::vector<OneRound> others;
            for (std::size_t i = 0; i < count; ++i) {
                if (i % Pixel::folds != fold) others.push_back(all[i]);
            }
            const auto alpha = sum_of(others).weights();
            for (std::size_t i = fold; i < count; i += Pixel::folds) moments.add(all[i].estimate(alpha));
        }
        const Pixel pixel = sum_of(all);
        INFO(count << " rounds");
        CHECK(pixel.rounds() == count);
        CHECK(agree(pixel.estimate(), moments.mean()));
        CHECK((count == 1 ? std::isnan(pixel.standard_error())
                          : agree(pixel.standard_error(), moments.standard_error())));
    }
    CHECK(Pixel{}.estimate() == 0);
    CHECK(std::isnan(Pixel{}.standard_error()));
    CHECK(Pixel{}.weights() == Pixel::Weights{});
    const auto one = rounds(1, 2);
    CHECK(sum_of(one).estimate() == one[0].balanced);
}

TEST_CASE("merging is adding, wherever rounds are split", "[cross_fitted]") {
    const auto all = rounds(23, 3);
    const std::span<const OneRound> some{all};
    const Pixel expected = sum_of(some);
    for (std::size_t split = 0; split <= some.size(); ++split) {
        Pixel merged = sum_of(some.first(split));
        merged.merge(sum_of(some.subspan(split)));
        check_same(merged, expected);
    }
    // A round in each: they come to lie in different folds.
    Pixel merged;
    for (const OneRound& round : all) merged.merge(sum_of(std::span{&round, 1}));
    check_same(merged, expected);
}

// Weights of a first pass, and no rounds of it in the second.
TEST_CASE("weights from elsewhere leave each estimate as it is without them, on the mean", "[cross_fitted]") {
    const auto alpha = sum_of(rounds(200, 4)).weights();
    lumis::RunningMoments<double> estimates, balance;
    for (unsigned seed = 5; seed < 4005; ++seed) {
        const Pixel pixel = sum_of(rounds(2, seed));
        estimates.add(pixel.estimate(alpha));
        balance.add(pixel.estimate({}));
    }
    CHECK(std::abs(estimates.mean() - (std::exp(1) - 1)) <= 4 * estimates.standard_error());
    // The quadratic fits e^x to 0.3 %: what is left of the variance, from the first of two rounds on.
    CHECK(estimates.variance() <= 0.05 * balance.variance());
    const Pixel last = sum_of(rounds(1000, 6));
    CHECK(agree(last.estimate(alpha), [&] {
        double sum = 0;
        for (const OneRound& round : rounds(1000, 6)) sum += round.estimate(alpha);
        return sum / 1000;
    }()));
}

TEST_CASE("the mean of whole numbers is none", "[cross_fitted]") {
    auto half = lumis::optimal<int>(take(1, Monomial{1}), take(1, Monomial{2}));
    CountingUniforms<double> uniforms;
    for (int i = 0; i < 1000; ++i) half.add([](double x) { return x < 0.5 ? 1 : 0; }, uniforms);
    CHECK(half.standard_error() <= 0.02);
    CHECK(std::abs(half.estimate() - 0.5) <= 4 * half.standard_error());
}

TEST_CASE("the square of what is large makes an infinite standard error, not NaN", "[cross_fitted]") {
    auto large = lumis::optimal(take(1, Monomial{1}), take(1, Monomial{2}));
    auto even = lumis::optimal(take(1, Monomial{1}));
    CountingUniforms<double> uniforms;
    for (int i = 0; i < 100; ++i) {
        large.add([](double x) { return 1e200 * x * x; }, uniforms);
        even.add([](double) { return 1e200; }, uniforms);
    }
    CHECK(std::abs(large.estimate() - 1e200 / 3) <= 0.1e200);
    CHECK(large.standard_error() == std::numeric_limits<double>::infinity());
    CHECK(large.standard_error({}) == std::numeric_limits<double>::infinity());
    CHECK(large.rejected() == 0);
    CHECK(even.standard_error({}) == 0);  // without a deviation nothing overflows
}

TEST_CASE("a colour's components have weights of their own", "[cross_fitted]") {
    auto color = lumis::optimal<glm::vec3>(take(1, Monomial{1}), take(1, Monomial{2}));
    auto red = lumis::optimal<float>(take(1, Monomial{1}), take(1, Monomial{2})), green = red;
    CountingUniforms<double> a, b, c;
    const auto f = [](double x) { return glm::dvec3{x * x, std::exp(x), 0}; };
    for (int i = 0; i < 500; ++i) {
        color.add(f, a);
        red.add([](double x) { return x * x; }, b);
        green.add(exponential, c);
    }
    CHECK(nearly(color.estimate(), glm::vec3{red.estimate(), green.estimate(), 0}));
    CHECK(nearly(color.standard_error(), glm::vec3{red.standard_error(), green.standard_error(), 0}));
    for (std::size_t k = 0; k < 2; ++k) {
        CHECK(nearly(color.weights()[k], glm::vec3{red.weights()[k], green.weights()[k], 0}));
    }
}

namespace {

// Each lane has as many numbers, one lane's after the other's.
struct LaneUniforms {
    using Lanes = lumis::Lanes<double, 4>;
    std::array<CountingUniforms<double>, Lanes::size>& sources;

    template <int N>
    [[nodiscard]] glm::vec<N, Lanes> next() {
        glm::vec<N, Lanes> u;
        for (std::size_t lane = 0; lane < Lanes::size; ++lane) {
            const auto own = sources[lane].next<N>();
            for (int i = 0; i < N; ++i) u[i].set(lane, own[i]);
        }
        return u;
    }
};

// Those of one round: a lane that selects nothing may spend less than the others.
std::array<CountingUniforms<double>, 4> sources_of(std::size_t round) {
    std::array<CountingUniforms<double>, 4> sources;
    for (auto& source : sources) source.source = lumis::Uniforms<std::mt19937_64, double>{std::mt19937_64{round++}};
    return sources;
}

}  // namespace

TEST_CASE("each lane makes a round", "[cross_fitted][lanes]") {
    const auto compare = [](auto in_lanes, auto f) {
        auto one_by_one = in_lanes;
        for (std::size_t i = 0; i < 200; i += 4) {
            auto sources = sources_of(i), again = sources;
            in_lanes.add(f, LaneUniforms{sources});
            for (auto& source : again) one_by_one.add(f, source);
        }
        CHECK(in_lanes.rounds() == 200);
        CHECK(agree(in_lanes.estimate(), one_by_one.estimate()));
        CHECK(agree(in_lanes.standard_error(), one_by_one.standard_error()));
        for (std::size_t k = 0; k < 2; ++k) CHECK(agree(in_lanes.weights()[k], one_by_one.weights()[k]));
    };
    const auto for_lanes = [](const auto& x) { return x * x; };
    compare(lumis::optimal(take(1, HalfTheTime{}), take(2, Falling{}), take(0, Monomial{2})), for_lanes);
    compare(lumis::optimal(take(1, HalfTheTime{}), take(2, Falling{}), take(0, Monomial{2})), exponential);
    // Each selects a technique of its own, or none.
    compare(lumis::optimal(lumis::choose(0.5, HalfTheTime{}), lumis::choose(0.3, Falling{})), for_lanes);
}
