#include "assertions.hpp"
#include "catch.hpp"
#include "instrumented.hpp"
#include "one_dimensional.hpp"
#include "optimal_subjects.hpp"
#include <lumis/combine/optimal.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/microfacets/perfect_reflection.hpp>
#include <lumis/statistics/running_moments.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

using lumis::choose;
using lumis::optimal;
using lumis::take;

namespace {

constexpr int many = 1 << 16;

// After many evenly spread rounds: alpha, and the variance of a round.
template <class Best, class F, std::size_t K>
void check(Best best, const F& f, const std::array<double, K>& alpha, double variance, double integral) {
    add_evenly(best, f, many);
    const auto found = best.weights();
    for (std::size_t k = 0; k < K; ++k) {
        INFO("alpha " << k << " is " << found[k] << ", not " << alpha[k]);
        CHECK(std::abs(found[k] - alpha[k]) <= 2e-4 * std::abs(integral));
    }
    const double error = best.standard_error(), balance_error = best.standard_error({});
    INFO("variance " << error * error * many << ", not " << variance << "; of balance " << balance_error);
    CHECK(std::abs(error * error * many - variance) <= 0.01 * variance + 1e-6 * balance_error * balance_error * many);
    CHECK(std::abs(best.estimate() - integral) <= 1e-4 * std::abs(integral));
}

// The solution of A alpha = b for two techniques, by the midpoint rule, for S = c0 p + c1 q: counts or probabilities.
struct TwoTechniques {
    std::array<double, 2> alpha;
    double variance;
};
template <class F, class First, class Second>
TwoTechniques solution(const F& f, double c0, const First& first, double c1, const Second& second) {
    constexpr int steps = 100'000;
    double a00 = 0, a01 = 0, a11 = 0, b0 = 0, b1 = 0, squares = 0;
    for (int i = 0; i < steps; ++i) {
        const double x = (i + 0.5) / steps, p = first.pdf(x), q = second.pdf(x), s = c0 * p + c1 * q;
        a00 += p * p / s / steps, a01 += p * q / s / steps, a11 += q * q / s / steps;
        b0 += f(x) * p / s / steps, b1 += f(x) * q / s / steps, squares += f(x) * f(x) / s / steps;
    }
    const double determinant = a00 * a11 - a01 * a01;
    const std::array alpha{(a11 * b0 - a01 * b1) / determinant, (a00 * b1 - a01 * b0) / determinant};
    return {alpha, squares - alpha[0] * b0 - alpha[1] * b1};
}

const auto square = [](double x) { return x * x; };
const auto exponential = [](double x) { return std::exp(x); };
constexpr double e = std::numbers::e;

}  // namespace

TEST_CASE("weights and variance are those of closed forms", "[optimal]") {
    const Monomial one{1}, rising{2}, quadratic{3};
    check(
        optimal(take(1, rising), take(1, Falling{})), [](double x) { return x * (1 - x); },
        std::array{1 / 12.0, 1 / 12.0}, 1 / 360.0, 1 / 6.0);
    check(optimal(take(1, one), take(1, rising)), square, std::array{-0.130863498989, 0.464196832323}, 0.0029835973064,
          1 / 3.0);
    check(optimal(take(1, one), take(1, rising)), exponential, std::array{0.902496131239, 0.81578569722},
          0.0020220066861, e - 1);
    check(
        optimal(take(1, one), take(1, rising)), [](double x) { return 1 + x; }, std::array{1.0, 0.5}, 0, 1.5);
    check(optimal(take(1, one), take(1, rising), take(1, quadratic)), square, std::array{0.0, 0.0, 1 / 3.0}, 0,
          1 / 3.0);
    // Condition 27,000.
    const double low = 3 / (2 * std::numbers::pi), high = std::numbers::pi;
    const auto third = [](double x) { return x * x - x / std::numbers::pi; };
    const auto f = [=](double x) { return x * third(x) * std::sin(x); };
    auto best = optimal(take(1, Numeric{[](double x) { return x; }, low, high}), take(1, Numeric{third, low, high}),
                        take(1, Numeric{[](double x) { return std::sin(x); }, low, high}));
    add_evenly(best, f, many);
    const double error = best.standard_error(), balance_error = best.standard_error({});
    CHECK(std::abs(best.estimate() - 10.287570131574) <= 1e-3);
    CHECK(std::abs(error * error * many - 8.2299137384) <= 0.08);
    CHECK(std::abs(balance_error * balance_error * many - 9.7211351045) <= 0.1);
}

// Worked by hand: alpha (13, 7) / 8, variance 99 / 64. A technique that yields nothing half of the time.
TEST_CASE("a draw that yields nothing is a point of its technique alone", "[optimal]") {
    const auto f = [](double x) { return x < 0.5 ? 4 + x : x; };
    check(optimal(take(1, everywhere), take(1, HalfTheTime{})), f, std::array{1.625, 0.875}, 1.546875, 2.5);
    // It says nothing of f, so that n_k samples do as much as n_k rounds.
    auto best = optimal(take(2, HalfTheTime{}), take(1, everywhere));
    add_evenly(best, f, many);
    CHECK(std::abs(best.control_mean(0) - 1) <= 1e-4);
    CHECK(std::abs(best.control_mean(1) - 1) <= 1e-4);
}

TEST_CASE("weights solve the equations of their counts and probabilities", "[optimal]") {
    const Monomial one{1}, rising{2};
    for (const auto& [n0, n1] : {std::array{2, 1}, {1, 4}, {3, 3}}) {
        const auto answer = solution(exponential, n0, one, n1, rising);
        check(optimal(take(n0, one), take(n1, rising)), exponential, answer.alpha, answer.variance, e - 1);
    }
    // Probabilities may sum to less than 1.
    for (const auto& [c0, c1] : {std::array{0.5, 0.5}, {0.3, 0.6}, {0.1, 0.2}}) {
        const auto answer = solution(exponential, c0, one, c1, rising);
        check(optimal(choose(c0, one), choose(c1, rising)), exponential, answer.alpha, answer.variance, e - 1);
    }
}

// e^x by the line that fits it best: 4 e - 10 + (18 - 6 e) x.
TEST_CASE("a technique that is not drawn is a control variate", "[optimal]") {
    const std::array alpha{4 * e - 10, 9 - 3 * e};
    const double variance = (e * e - 1) / 2 - alpha[0] * (e - 1) - 2 * alpha[1];
    check(optimal(take(1, Monomial{1}), take(0, Monomial{2})), exponential, alpha, variance, e - 1);
    check(optimal(choose(1, Monomial{1}), choose(0, Monomial{2})), exponential, alpha, variance, e - 1);

    Calls drawn, control;
    auto best = optimal(take(2, Instrumented{everywhere, &drawn}), take(0, Instrumented{above, &control}));
    CountingUniforms<double> uniforms;
    for (int i = 0; i < 1000; ++i) best.add(exponential, uniforms);
    CHECK(uniforms.spent == 2000);
    CHECK((drawn.sample == 2000 && drawn.pdf == 0));  // the own density comes with the sample
    CHECK((control.sample == 0 && control.pdf == 2000));
    CHECK(std::abs(best.control_mean(1) - 1) <= 5 * best.control_standard_error(1));
    // One that the others do not cover must not serve, and is found out.
    auto uncovered = optimal(take(1, above), take(0, everywhere));
    for (int i = 0; i < 1000; ++i) uncovered.add(exponential, uniforms);
    CHECK(std::abs(uncovered.control_mean(1) - 1) > 100 * uncovered.control_standard_error(1));
}

TEST_CASE("a delta strategy's sample is a point that no other technique draws", "[optimal]") {
    const lumis::Direction<double> wo{0.6, 0, 0.8};
    struct Coated {
        double operator()(const lumis::Direction<double>& w) const { return 0.5 * w.z * std::numbers::inv_pi; }
        double operator()(const lumis::Direction<double>&, lumis::delta_t) const { return 0.4; }
    };
    const lumis::PerfectReflection<double> mirror{wo};
    const lumis::CosineHemisphere<double> base;
    auto several = optimal(take(2, mirror), take(1, base));
    auto selected = optimal(choose(0.3, mirror), choose(0.5, base));
    CountingUniforms<double> uniforms;
    for (int i = 0; i < 4000; ++i) {
        several.add(Coated{}, uniforms);
        selected.add(Coated{}, uniforms);
    }
    CHECK(std::abs(several.estimate() - 0.9) <= 1e-12);
    CHECK(std::abs(several.weights()[0] - 0.4) <= 1e-3);
    // Nothing is left of the noise of the selection.
    CHECK(selected.standard_error() <= 1e-3 * selected.standard_error({}));
    CHECK(std::abs(selected.estimate() - 0.9) <= 5 * selected.standard_error());
}

TEST_CASE("techniques that are alike, apart, or blind", "[optimal]") {
    CountingUniforms<double> uniforms;
    const auto run = [&](auto best) {
        for (int i = 0; i < 5000; ++i) best.add(exponential, uniforms);
        const double balance = best.estimate({});
        CHECK(std::abs(best.estimate() - balance) <= 5e-3 * balance);
        CHECK(best.standard_error() <= 1.01 * best.standard_error({}));
        for (const double alpha : best.weights()) CHECK(std::isfinite(alpha));
        return best.weights();
    };
    // Singular: the balance heuristic's estimate, whatever alpha.
    run(optimal(take(1, everywhere), take(2, everywhere), take(1, everywhere)));
    // Disjoint: alpha is the integral over each support, and changes nothing.
    const auto apart = run(optimal(take(1, Interval<double>{0, 0.5}), take(1, Interval<double>{0.5, 1})));
    CHECK(std::abs(apart[0] - (std::exp(0.5) - 1)) <= 0.01);
    CHECK(std::abs(apart[1] - (e - std::exp(0.5))) <= 0.01);
    // A density that is 0 at every sample.
    CHECK(run(optimal(take(1, everywhere), take(0, Interval<double>{2, 3})))[1] == 0);
    // One technique alone is plain Monte Carlo.
    auto alone = optimal(take(2, everywhere));
    lumis::RunningMoments<double> moments;
    CountingUniforms<double> first, again;
    for (int i = 0; i < 1000; ++i) {
        alone.add(exponential, first);
        moments.add(multi_sample(Unasked{}, take(2, everywhere)).estimate(exponential, again));
    }
    CHECK(std::abs(alone.estimate() - moments.mean()) <= 1e-14);
    CHECK(std::abs(alone.standard_error() - moments.standard_error()) <= 1e-14);
}

// The same problem on intervals of any width: densities within their range, their sums and products beyond it.
TEMPLATE_TEST_CASE("the scale of densities does not matter", "[optimal]", float, double) {
    using T = TestType;
    const auto run = [](T width) {
        auto best = optimal(take(1, Interval<T>{0, width}), take(1, Interval<T>{0, width / 2}));
        CountingUniforms<T> uniforms;
        for (int i = 0; i < 200; ++i) best.add([=](T x) { return (1 + x / width) / width; }, uniforms);
        const auto alpha = best.weights();
        return std::array{double{best.estimate()}, double{best.standard_error()}, alpha[0], alpha[1]};
    };
    const auto usual = run(1);
    const T extreme = std::is_same_v<T, float> ? T(1e-36) : std::numeric_limits<T>::min() * 16;
    for (const T width : {T(1e-30), T(1e30), extreme, 1 / extreme}) {
        const auto scaled = run(width);
        for (std::size_t i = 0; i < scaled.size(); ++i) {
            INFO("width " << width << ": " << scaled[i] << " against " << usual[i]);
            CHECK(std::abs(scaled[i] - usual[i]) <= 1e-5 * std::abs(usual[i]));
        }
    }
}

TEST_CASE("shares of densities of any kind", "[optimal]") {
    using Two = std::array<double, 2>;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto q = [](Two densities, Two factors) { return lumis::detail::shares(densities, factors).q; };
    CHECK(q({1, 3}, {1, 1}) == Two{0.25, 0.75});
    CHECK(q({1, 3}, {1, 0}) == Two{1, 3});
    CHECK(q({1e-310, 3e-310}, {1, 1})[1] == Approx(0.75));
    CHECK(q({1.5e308, 1.5e308}, {1, 1}) == Two{0.5, 0.5});
    CHECK(q({0, 0}, {1, 1}) == Two{0, 0});
    // The policy of heuristics.
    CHECK(q({infinity, 1}, {2, 1}) == Two{0.5, 0});
    CHECK(q({infinity, infinity}, {2, 1}) == Two{0.25, 0.5});
    CHECK(lumis::detail::shares(Two{infinity, 1}, Two{1, 1}).inverse == 0);
    CHECK(std::isfinite(lumis::detail::shares(Two{5e-324, 0}, Two{1, 1}).inverse));
    const CaughtAssertions caught;
    CHECK(q({std::numeric_limits<double>::quiet_NaN(), 1}, {1, 1}) == Two{0, 0});
    CHECK(caught.count() == 1);
}

TEST_CASE("a round that is not finite is counted and left out", "[optimal]") {
    CountingUniforms<double> uniforms;
    auto best = optimal(take(1, everywhere), take(1, above));
    for (int i = 0; i < 100; ++i) {
        best.add([=](double) { return i % 10 > 0 ? 1.0 : std::numeric_limits<double>::quiet_NaN(); }, uniforms);
    }
    CHECK(best.rounds() == 90);
    CHECK(best.rejected() == 10);
    CHECK(std::abs(best.estimate() - 1) <= 5 * best.standard_error());
}
