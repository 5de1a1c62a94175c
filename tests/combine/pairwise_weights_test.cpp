#include "assertions.hpp"
#include "catch.hpp"
#include "instrumented.hpp"
#include "one_dimensional.hpp"
#include "z_test.hpp"
#include <lumis/combine/multi_sample.hpp>
#include <lumis/combine/one_sample.hpp>
#include <lumis/combine/pairwise_weights.hpp>
#include <lumis/core/lanes.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/directions/uniform_hemisphere.hpp>
#include <lumis/directions/uniform_sphere.hpp>
#include <lumis/microfacets/perfect_reflection.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>

namespace {

using lumis::choose;
using lumis::multi_sample;
using lumis::one_sample;
using lumis::PairwiseWeights;
using lumis::take;

TEMPLATE_TEST_CASE("pairs are weighed by balance, and all weights sum to 1", "[pairwise]", float, double) {
    using T = TestType;
    const T tolerance = 8 * std::numeric_limits<T>::epsilon();
    // The canonical technique draws nothing where x > 0.8.
    const auto three = multi_sample(PairwiseWeights{}, take(2, Interval<T>{0, T(0.8)}), take(3, Ramp<T>{}),
                                    take(5, Interval<T>{T(0.5), 1}), take(0, Ramp<T>{}));
    for (const T x : {T(0), T(0.3), T(0.6), T(0.9), T(1), T(2)}) {
        const auto q = three.densities(x);
        const T sum = three.template weight<0>(x) + three.template weight<1>(x) + three.template weight<2>(x) +
                      three.template weight<3>(x);
        CHECK(std::abs(sum - (x > 1 ? T(0) : T(1))) <= tolerance);
        if (x > T(0.8)) {
            CHECK(three.template weight<1>(x) == lumis::mis_weight(lumis::BalanceHeuristic{}, q[1], q[0], q[2], q[3]));
        } else {
            CHECK(std::abs(three.template weight<1>(x) - q[1] / (q[1] * T(8) / 3 + q[0])) <= tolerance);
            CHECK(std::abs(three.template weight<2>(x) - q[2] / (q[2] * T(8) / 5 + q[0])) <= tolerance);
        }
    }
    // Two are balanced, and so are copies of one technique.
    const auto two = multi_sample(PairwiseWeights{}, take(2, Interval<T>{0, 1}), take(3, Ramp<T>{}));
    const auto balanced = multi_sample(lumis::BalanceHeuristic{}, take(2, Interval<T>{0, 1}), take(3, Ramp<T>{}));
    const auto copies =
        one_sample(PairwiseWeights{}, choose(0.1, Ramp<T>{}), choose(0.2, Ramp<T>{}), choose(0.7, Ramp<T>{}));
    for (const T x : {T(0), T(0.3), T(1)}) {
        CHECK(std::abs(two.template weight<0>(x) - balanced.template weight<0>(x)) <= tolerance);
        CHECK(std::abs(two.template weight<1>(x) - balanced.template weight<1>(x)) <= tolerance);
        CHECK(std::abs(copies.template weight<0>(x) - T(0.1)) <= tolerance);
        CHECK(std::abs(copies.template weight<1>(x) - T(0.2)) <= tolerance);
        CHECK(std::abs(copies.template weight<2>(x) - T(0.7)) <= tolerance);
    }
}

// A density that is what it is told to be.
template <class T>
struct Told : Ramp<T> {
    T density;
    [[nodiscard]] lumis::Sample<T, T> sample(glm::vec<1, T> u) const noexcept { return {u.x, density}; }
    [[nodiscard]] T pdf(T) const noexcept { return density; }
};

TEMPLATE_TEST_CASE("pairwise weights of extreme densities", "[pairwise]", float, double) {
    using T = TestType;
    using Limits = std::numeric_limits<T>;
    const auto weights = [](T a, T b, T c) {
        const auto all =
            multi_sample(PairwiseWeights{}, take(1, Told<T>{{}, a}), take(1, Told<T>{{}, b}), take(2, Told<T>{{}, c}));
        return std::array{all.template weight<0>(0), all.template weight<1>(0), all.template weight<2>(0)};
    };
    for (const T scale : {T(1e-30), T(1), T(1e30)}) {
        const auto w = weights(scale, 2 * scale, 4 * scale);
        // q = 1, 2, 8 and shares 1/3, 2/3.
        CHECK(std::abs(w[1] - T(2) / 7) <= 4 * Limits::epsilon());
        CHECK(std::abs(w[2] - T(8) / 13) <= 4 * Limits::epsilon());
        CHECK(std::abs(w[0] - (T(1) / 21 + T(2) / 39)) <= 4 * Limits::epsilon());
    }
    CHECK(weights(0, 0, 0) == std::array<T, 3>{0, 0, 0});
    CHECK(weights((Limits::max)(), (Limits::min)(), 0) == std::array<T, 3>{1, 0, 0});
    CHECK(weights(Limits::infinity(), 1, 1) == std::array<T, 3>{1, 0, 0});
    CHECK(weights(Limits::infinity(), Limits::infinity(), 1) == std::array<T, 3>{T(0.5), T(0.5), 0});
    const CaughtAssertions caught;
    // The third does not ask for the second's.
    CHECK(weights(1, Limits::quiet_NaN(), 1) == std::array<T, 3>{0, 0, T(0.5)});
    CHECK(caught.count() > 0);
}

TEST_CASE("a sample of a pair asks for one density", "[pairwise]") {
    std::array<Calls, 4> calls;
    const auto four = multi_sample(PairwiseWeights{}, take(1, Instrumented{everywhere, &calls[0]}),
                                   take(8, Instrumented{Ramp<double>{}, &calls[1]}),
                                   take(8, Instrumented{above, &calls[2]}), take(0, Instrumented{above, &calls[3]}));
    CountingUniforms<double> uniforms;
    std::ignore = four.estimate(Step{}, uniforms);
    CHECK(calls[0].pdf == 16);
    CHECK(calls[1].pdf == 1);
    CHECK(calls[2].pdf == 1);
    CHECK(calls[3].pdf == 0);
}

TEST_CASE("pairwise estimates are unbiased, beside a mirror too, and in lanes", "[pairwise]") {
    const auto f = [](const glm::dvec3& w) { return w.z > 0 ? w.z : 0.0; };
    const lumis::UniformSphere<double> sphere;
    const lumis::CosineHemisphere<double> cosine;
    const lumis::UniformHemisphere<double> uniform;
    const auto check = [&](const auto& estimator, double answer, const auto& integrand) {
        const auto law = z_test<double>([&](auto& u) { return estimator.estimate(integrand, u); }, answer, 6, 3);
        INFO(law.message);
        CHECK(law.passed);
    };
    const double pi = std::acos(-1.0);
    const auto multi = multi_sample(PairwiseWeights{}, take(1, cosine), take(2, sphere), take(1, uniform));
    check(multi, pi, f);
    check(one_sample(PairwiseWeights{}, choose(0.3, sphere), choose(0.3, cosine), choose(0.4, uniform)), pi, f);
    struct Coated {
        double operator()(const glm::dvec3& w) const { return w.z > 0 ? w.z : 0; }
        double operator()(const glm::dvec3&, lumis::delta_t) const { return 1; }
    };
    check(multi_sample(PairwiseWeights{}, take(1, lumis::PerfectReflection<double>{glm::dvec3{0, 0, 1}}),
                       take(1, cosine), take(1, uniform)),
          pi + 1, Coated{});

    using Four = lumis::Lanes<double, 4>;
    const lumis::Direction<Four> w{Four(0.6), Four(0.0),
                                   Four::of_lanes([](auto i) { return 0.8 - 0.8 * static_cast<double>(i); })};
    const auto lanes = multi.densities(w);
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 one{0.6, 0, w.z[i]};
        CHECK(lanes[0][i] == multi.densities(one)[0]);
        CHECK(std::abs(multi.weight<0>(w)[i] - multi.weight<0>(one)) <= 1e-15);
        CHECK(std::abs(multi.weight<1>(w)[i] - multi.weight<1>(one)) <= 1e-15);
        CHECK(std::abs(multi.weight<2>(w)[i] - multi.weight<2>(one)) <= 1e-15);
    }
}

}  // namespace
