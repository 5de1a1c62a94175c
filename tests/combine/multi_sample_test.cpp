#include "assertions.hpp"
#include "catch.hpp"
#include "instrumented.hpp"
#include "one_dimensional.hpp"
#include "z_test.hpp"
#include <lumis/combine/multi_sample.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/directions/uniform_hemisphere.hpp>
#include <lumis/microfacets/perfect_reflection.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <tuple>
#include <type_traits>

using lumis::multi_sample;
using lumis::take;

TEST_CASE("a step: one technique is blind, two are not, and an estimate has two values", "[multi_sample]") {
    CountingUniforms<double> uniforms;
    const auto blind = multi_sample(lumis::BalanceHeuristic{}, take(1, above));
    const auto both = multi_sample(lumis::BalanceHeuristic{}, take(1, everywhere), take(1, above));
    int low = 0;
    for (int i = 0; i < 10'000; ++i) {
        REQUIRE(std::abs(blind.estimate(Step{}, uniforms) - Step::integral_above) <= 1e-12);
        const double estimate = both.estimate(Step{}, uniforms);
        const bool is_low = std::abs(estimate - 160 / 11.0) <= 1e-12;
        REQUIRE((is_low || std::abs(estimate - (8 + 80 / 11.0)) <= 1e-12));
        low += is_low;
    }
    CHECK(std::abs(low - 1000) <= 150);  // five standard deviations

    const auto test = z_test<double>([&](auto& u) { return both.estimate(Step{}, u); }, Step::integral, 1);
    INFO(test.message);
    CHECK(test.passed);
}

// The integral of x^2 + 1 over [0, 1] is 4/3.
TEMPLATE_TEST_CASE("every heuristic and every pair of counts is unbiased", "[multi_sample]", float, double) {
    using T = TestType;
    const auto f = [](T x) { return x * x + 1; };
    constexpr std::size_t family = 2 * 7 * 5;
    std::uint64_t seed = 100;
    const auto check = [&](const auto& heuristic, int n0, int n1) {
        const auto combined = multi_sample(heuristic, take(n0, Interval<T>{0, 1}), take(n1, Ramp<T>{}));
        const auto test = z_test<T>([&](auto& u) { return combined.estimate(f, u); }, 4 / 3.0, ++seed, family);
        INFO("heuristic " << (seed - 101) / 5 << " with counts " << n0 << ", " << n1);
        INFO(test.message);
        CHECK(test.passed);
        CHECK(test.relative_standard_error <= 0.001);
    };
    const auto check_counts = [&](const auto& heuristic_for) {
        for (const auto [n0, n1] : {std::array{1, 1}, {1, 4}, {4, 1}, {3, 0}, {0, 2}}) {
            check(heuristic_for(n0, n1), n0, n1);
        }
    };
    check_counts([](int, int) { return lumis::BalanceHeuristic{}; });
    check_counts([](int, int) { return lumis::PowerHeuristic{}; });
    check_counts([](int, int) { return lumis::PowerHeuristic{3.5}; });
    check_counts([](int, int) { return lumis::MaximumHeuristic{}; });
    check_counts([](int, int) { return lumis::CutoffHeuristic{0.7}; });
    check_counts([](int, int) { return lumis::EqualWeights{}; });
    check_counts([](int n0, int n1) {
        return lumis::PartitionWeights{[=](T x) { return n0 == 0 || (n1 > 0 && x > T(0.4)) ? 1 : 0; }};
    });
}

TEMPLATE_TEST_CASE("weights and densities are those of the definition", "[multi_sample]", float, double) {
    using T = TestType;
    const T epsilon = std::numeric_limits<T>::epsilon();
    const lumis::PowerHeuristic power;
    const auto combined = multi_sample(power, take(2, Interval<T>{0, 1}), take(3, Ramp<T>{}),
                                       take(1'000'000, Interval<T>{T(0.5), 1}), take(0, Ramp<T>{}));
    for (const T x : {T(0), T(0.125), T(0.7), T(1), T(2)}) {
        const T outside = x > 1 ? T(0) : T(1);
        const std::array<T, 4> q{2 * outside, 3 * (T(0.5) + x) * outside, (x < T(0.5) ? 0 : T(2'000'000)) * outside, 0};
        CHECK(combined.densities(x) == q);
        const T sum = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
        const auto agree = [&](T weight, T own) {
            return std::abs(weight - (sum > 0 ? own * own / sum : T(0))) <= 8 * epsilon * weight;
        };
        CHECK(agree(combined.template weight<0>(x), q[0]));
        CHECK(agree(combined.template weight<1>(x), q[1]));
        CHECK(agree(combined.template weight<2>(x), q[2]));
        CHECK(combined.template weight<3>(x) == 0);
        CHECK(combined.template weight<0>(x) == lumis::mis_weight(power, q[0], q[1], q[2], q[3]));
        CHECK(std::abs(combined.template weight<1>(x) - lumis::mis_weight(power, q[1], q[0], q[2])) <= 4 * epsilon);
    }
    // What a sample adds is its weight times f / (n p): here f / (n p) is 1 / 5.
    CountingUniforms<T> uniforms;
    const auto one_kind = multi_sample(power, take(5, Interval<T>{0, 1}), take(0, Ramp<T>{}));
    CHECK(std::abs(one_kind.estimate([](T) { return T(1); }, uniforms) - 1) <= 2 * epsilon);
}

TEST_CASE("a technique with count 0 is neither sampled nor evaluated", "[multi_sample]") {
    Calls used, unused;
    const auto combined = multi_sample(lumis::PowerHeuristic{}, take(3, Instrumented{everywhere, &used}),
                                       take(0, Instrumented{Ramp<double>{}, &unused}));
    CountingUniforms<double> uniforms;
    CHECK(std::abs(combined.estimate([](double) { return 1.0; }, uniforms) - 1) <= 1e-15);
    CHECK(used.sample == 3);
    CHECK(combined.weight<0>(0.5) == 1);
    CHECK(combined.weight<1>(0.5) == 0);
    CHECK(combined.densities(0.5) == std::array{3.0, 0.0});
    CHECK(unused.sample == 0);
    CHECK(unused.pdf == 0);
    CHECK(uniforms.spent == 3);
}

TEST_CASE("uniforms are spent by count and dimension, densities are asked once for each sample", "[multi_sample]") {
    Calls line, normal;
    const auto combined = multi_sample(lumis::BalanceHeuristic{}, take(2, Instrumented{everywhere, &line}),
                                       take(3, Instrumented{too_narrow, &normal}));
    CountingUniforms<double> uniforms;
    std::ignore = combined.estimate(TwoBumps{}, uniforms);
    CHECK(uniforms.spent == 2 * 1 + 3 * 2);
    CHECK(line.sample == 2);
    CHECK(normal.sample == 3);
    // The own density comes with the sample.
    CHECK(line.pdf == 3);
    CHECK(normal.pdf == 2);
}

TEST_CASE("a heuristic by point asks for no density", "[multi_sample]") {
    Calls first, second;
    const lumis::PartitionWeights by_half{[](double x) { return x < 0.5 ? 0 : 1; }};
    const auto combined = multi_sample(by_half, take(4, Instrumented{everywhere, &first}),
                                       take(4, Instrumented{Ramp<double>{}, &second}));
    CountingUniforms<double> uniforms;
    std::ignore = combined.estimate([](double x) { return x; }, uniforms);
    CHECK(combined.weight<0>(0.25) == 1);
    CHECK(combined.weight<1>(0.25) == 0);
    CHECK(first.pdf + second.pdf == 0);
    CHECK(first.sample + second.sample == 8);
}

TEST_CASE("one technique is plain Monte Carlo: no weight code, no density", "[multi_sample]") {
    Calls calls;
    const auto plain = multi_sample(Unasked{}, take(2, Instrumented{Ramp<double>{}, &calls}));
    CountingUniforms<double> uniforms, again;
    const double estimate = plain.estimate([](double x) { return x; }, uniforms);
    const auto a = Ramp<double>{}.sample(again.next<1>()), b = Ramp<double>{}.sample(again.next<1>());
    CHECK(std::abs(estimate - (a.value / a.pdf + b.value / b.pdf) / 2) <= 1e-15);
    CHECK(calls.sample == 2);
    CHECK(calls.pdf == 0);
    CHECK(uniforms.spent == 2);
}

namespace {

// A value of a host's own: what the documentation asks for and nothing more.
struct Spectrum {
    std::array<float, 2> bands;
    friend Spectrum operator+(const Spectrum& a, const Spectrum& b) {
        return {{a.bands[0] + b.bands[0], a.bands[1] + b.bands[1]}};
    }
    friend Spectrum operator*(const Spectrum& a, float s) { return {{a.bands[0] * s, a.bands[1] * s}}; }
};

}  // namespace

TEST_CASE("an integrand takes the point or the sample and returns any value", "[multi_sample]") {
    const auto combined = multi_sample(lumis::BalanceHeuristic{}, take(1, lumis::CosineHemisphere{}),
                                       take(2, lumis::UniformHemisphere{}));
    using Point = lumis::Direction<float>;
    const auto run = [&](auto f) {
        CountingUniforms<float> uniforms;
        return combined.estimate(f, uniforms);
    };
    const float expected = run([](const Point& w) { return w.z; });
    static_assert(std::is_same_v<decltype(run([](const Point& w) { return w.z; })), float>);
    CHECK(expected > 0);
    CHECK(run([](const lumis::AnySample auto& s) { return s.value.z; }) == expected);
    CHECK(run([](const lumis::AnySample auto& s) { return s.pdf > 0 ? s.value.z : 0; }) == expected);

    const glm::vec3 color = run([](const Point& w) { return w.z * glm::vec3{1, 2, 4}; });
    CHECK(color.x == expected);
    CHECK(color.y == 2 * expected);
    CHECK(color.z == 4 * expected);

    const Spectrum bands = run([](const Point& w) { return Spectrum{{w.z, 4 * w.z}}; });
    CHECK(bands.bands == std::array{expected, 4 * expected});

    // By reference as well, and with a state of its own.
    int evaluations = 0;
    const auto counting = [&evaluations](const Point& w) { return ++evaluations, w.z; };
    CountingUniforms<float> uniforms;
    CHECK(combined.estimate(counting, uniforms) == expected);
    CHECK(evaluations == 3);
}

TEST_CASE("an integrand may ask which technique drew its sample", "[multi_sample]") {
    const lumis::PerfectReflection<float> mirror{lumis::Direction<float>{0, 0, 1}};
    const auto combined = multi_sample(lumis::BalanceHeuristic{}, take(2, lumis::CosineHemisphere{}), take(1, mirror),
                                       take(3, lumis::UniformHemisphere{}));
    using Point = lumis::Direction<float>;
    // The share of each technique, and that of the mirror's coefficient.
    const auto check = [&](auto f) {
        CountingUniforms<float> uniforms;
        const glm::vec4 shares = combined.estimate(f, uniforms);
        CHECK((shares[0] > 0 && shares[2] > 0));
        CHECK(shares[1] == 1);
        CHECK(shares[3] == 1);
        const auto z = [](const auto& w, auto...) { return w.z; };
        CountingUniforms<float> again;
        CHECK(std::abs(shares[0] + shares[2] + 1 - combined.estimate(z, again)) <= 1e-5f);
    };
    const auto share = [](float z, std::size_t technique, bool is_delta) {
        glm::vec4 result{0};
        result[static_cast<int>(technique)] = z;
        result[3] = is_delta ? 1 : 0;
        return result;
    };
    check([&](const Point& w, auto technique, auto... is_delta) {
        return share(w.z, technique, sizeof...(is_delta) > 0);
    });
    check([&](const lumis::AnySample auto& s, auto technique, auto... is_delta) {
        return share(s.value.z, technique, sizeof...(is_delta) > 0);
    });
    struct Overloaded {
        decltype(share) of;
        glm::vec4 operator()(const Point& w, lumis::technique<0>) const { return of(w.z, 0, false); }
        glm::vec4 operator()(const Point& w, lumis::technique<2>) const { return of(w.z, 2, false); }
        glm::vec4 operator()(const Point& w, lumis::delta_t) const { return of(w.z, 1, true); }
    };
    check(Overloaded{share});
    // One that takes the point alone is not told more.
    CountingUniforms<float> uniforms;
    CHECK(combined.estimate([](const Point&, auto... tags) { return sizeof...(tags) > 0 ? 1.0f : 0.0f; }, uniforms) ==
          1);
}

TEST_CASE("where nothing is drawn the integrand is not asked", "[multi_sample]") {
    const lumis::PerfectReflection<float> below{lumis::Direction<float>{0, 0, -1}};
    const auto nothing = multi_sample(lumis::BalanceHeuristic{}, take(3, below));
    CountingUniforms<float> uniforms;
    int evaluations = 0;
    CHECK(nothing.estimate([&](const auto&, lumis::delta_t) { return static_cast<float>(++evaluations); }, uniforms) ==
          0);
    CHECK(evaluations == 0);
    CHECK(uniforms.spent == 6);
}

// A white mirror coat of reflectance 0.4 on a diffuse base of albedo 0.5 under a white sky reflects 0.9.
TEMPLATE_TEST_CASE("a delta strategy has weight 1 and no density", "[multi_sample][delta]", float, double) {
    using T = TestType;
    const lumis::Direction<T> wo{T(0.6), 0, T(0.8)}, wi{T(-0.6), 0, T(0.8)};
    const lumis::PerfectReflection<T> mirror{wo};
    struct Coated {
        T operator()(const lumis::Direction<T>& w) const { return T(0.5) * w.z * std::numbers::inv_pi_v<T>; }
        T operator()(const lumis::Direction<T>&, lumis::delta_t) const { return T(0.4); }
    };
    CountingUniforms<T> uniforms;
    CHECK(multi_sample(Unasked{}, take(1, mirror)).estimate(Coated{}, uniforms) == T(0.4));
    CHECK(std::abs(multi_sample(Unasked{}, take(3, mirror)).estimate(Coated{}, uniforms) - T(0.4)) <= T(1e-7));

    const auto with_base = multi_sample(Unasked{}, take(1, mirror), take(1, lumis::CosineHemisphere<T>{}));
    for (int i = 0; i < 100; ++i) {
        REQUIRE(std::abs(with_base.estimate(Coated{}, uniforms) - T(0.9)) <= 4 * std::numeric_limits<T>::epsilon());
    }
    CHECK(with_base.template weight<1>(wi) == 1);
    CHECK(with_base.densities(wi)[0] == 0);

    const auto three = multi_sample(lumis::PowerHeuristic{}, take(1, lumis::UniformHemisphere<T>{}), take(2, mirror),
                                    take(1, lumis::CosineHemisphere<T>{}));
    const auto test = z_test<T>([&](auto& u) { return three.estimate(Coated{}, u); }, 0.9, 7);
    INFO(test.message);
    CHECK(test.passed);
    CHECK(std::abs(three.template weight<0>(wi) + three.template weight<2>(wi) - 1) <= T(1e-6));
    CHECK(three.template weight<1>(wi) == 0);

    // The whole sample serves a delta strategy as well.
    const auto of_sample = [](const lumis::AnySample auto& s, lumis::delta_t) { return s.pdf * s.value.z; };
    CHECK(multi_sample(Unasked{}, take(1, mirror)).estimate(of_sample, uniforms) == T(0.8));
}
