// Resampling has the integral as its expectation: for any target, number of candidates, and weights among their sources.
#include "assertions.hpp"
#include "catch.hpp"
#include "one_dimensional.hpp"
#include "z_test.hpp"
#include <lumis/combine/mixture.hpp>
#include <lumis/combine/resample.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/directions/uniform_hemisphere.hpp>
#include <lumis/lights/area_light.hpp>
#include <lumis/lights/area_light_by_solid_angle.hpp>
#include <lumis/testing/bounded.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>

namespace {

using lumis::choose;
using lumis::resample;
using lumis::take;

// All tests here are one family.
constexpr std::size_t family = 80;

template <class T>
void check(const auto& resampled, const auto& f, double integral) {
    static std::uint64_t seed = 900;
    const auto law =
        z_test<T>([&](auto& uniforms) { return resampled.estimate(f, uniforms); }, integral, ++seed, family);
    INFO("seed " << seed << ": " << law.message);
    CHECK(law.passed);
    CHECK(law.relative_standard_error <= 0.001);
}

// The integral of x^2 + 1 over [0, 1] is 4/3.
TEMPLATE_TEST_CASE("resampling is unbiased for any number of candidates", "[resample]", float, double) {
    using T = TestType;
    const auto f = [](T x) { return x * x + 1; };
    const auto target = [](T x) { return T(0.25) + x; };
    const Interval<T> even{0, 1};
    for (const int candidates : {2, 32}) {
        check<T>(resample(target, take(candidates, even)), f, 4 / 3.0);
        check<T>(resample(target, take(candidates, even), take(2, Ramp<T>{})), f, 4 / 3.0);
        check<T>(resample(target, candidates, choose(0.3, even), choose(0.7, Ramp<T>{})), f, 4 / 3.0);
    }
}

TEMPLATE_TEST_CASE("resampling is unbiased under every heuristic", "[resample]", float, double) {
    using T = TestType;
    const auto f = [](T x) { return x * x + 1; };
    const auto target = [](T x) { return T(0.25) + x; };
    const auto weighed_by = [&](const auto& heuristic) {
        check<T>(resample(heuristic, target, take(1, Interval<T>{0, 1}), take(3, Ramp<T>{}),
                          take(2, Interval<T>{T(0.5), 1})),
                 f, 4 / 3.0);
    };
    weighed_by(lumis::BalanceHeuristic{});
    weighed_by(lumis::PowerHeuristic{});
    weighed_by(lumis::MaximumHeuristic{});
    weighed_by(lumis::PairwiseWeights{});
    weighed_by(lumis::PartitionWeights{[](T x) { return x > T(0.6) ? 2 : x > T(0.3) ? 1 : 0; }});
    // A canonical technique that does not cover all, beside another such, and one that is left out.
    check<T>(resample(lumis::PairwiseWeights{}, target, take(2, Interval<T>{T(0.5), 1}), take(3, Ramp<T>{}),
                      take(2, Interval<T>{0, T(0.3)})),
             f, 4 / 3.0);
    check<T>(resample(lumis::PairwiseWeights{}, target, 6, choose(0, Interval<T>{T(0.5), 1}), choose(0.3, Ramp<T>{}),
                      choose(0.6, Interval<T>{0, 1})),
             f, 4 / 3.0);
}

// Four of ten candidates are nothing: they count.
TEST_CASE("candidates that yield nothing count", "[resample]") {
    const auto f = [](double x) { return x * x + 1; };
    const auto target = [](double x) { return 0.25 + x; };
    const lumis::Mixture lossy{choose(0.6, everywhere)};
    check<double>(resample(target, take(4, lossy)), f, 4 / 3.0);
    check<double>(resample(target, take(4, lossy), take(2, above)), f, 4 / 3.0);
    check<double>(resample(target, 4, choose(0.3, everywhere), choose(0.3, Ramp<double>{})), f, 4 / 3.0);
}

// A target that is the integrand to a factor leaves nothing but what the candidates' sum varies; one that ends early misses the
// rest.
TEST_CASE("the target decides what is integrated and how well", "[resample]") {
    const auto f = [](double x) { return Step{}(x); };
    check<double>(resample([](double x) { return x < 0.9 ? 1e-9 : 1e-8; }, take(8, everywhere)), f, Step::integral);
    check<double>(
        resample([](double x) { return x < 0.9 ? 0 : 1; }, take(8, everywhere)),
        [](double x) { return x < 0.9 ? 0 : 80; }, Step::integral_above);
    // No variance is left: the target over the density is the same everywhere, and so is f over the target.
    lumis::Uniforms<std::mt19937_64, double> uniforms{std::mt19937_64{1}};
    const auto perfect = resample([](double x) { return 1 + 2 * x; }, take(5, Ramp<double>{}));
    for (int i = 0; i < 100; ++i) {
        REQUIRE(std::abs(perfect.estimate([](double x) { return 3 + 6 * x; }, uniforms) - 6) <= 1e-14);
    }
}

TEMPLATE_TEST_CASE("resampled irradiance", "[resample]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const V origin(T(0));
    const lumis::CosineHemisphere<T> cosine;
    const auto cosine_of = [](const V& w) { return w.z > 0 ? w.z : T(0); };

    // A square light of radiance 1 among candidates of the surface and of the light; the target asks whether it is met.
    const lumis::AreaLight square{lumis::Parallelogram<T>{V(-1, -1, 1), V(2, 0, 0), V(0, 2, 0)}, origin};
    const auto met = [](const lumis::AnySample auto& s) {
        return std::isinf(s.distance) ? T(0) : 1 / (s.distance * s.distance);
    };
    const auto irradiance = [&](const lumis::AnySample auto& s) {
        return std::isinf(s.distance) ? T(0) : cosine_of(s.value);
    };
    check<T>(resample(met, take(3, cosine), take(3, square)), irradiance, 1.740839502734);
    check<T>(resample(lumis::PairwiseWeights{}, met, take(2, square), take(1, cosine),
                      take(2, lumis::UniformHemisphere<T>{})),
             irradiance, 1.740839502734);

    // Two spheres that matter alike, though one has a thousand times the radiance.
    const lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle> strong{{V(6, 0, 8), T(0.1)}, origin},
        weak{{V(T(-0.18), 0, T(0.24)), T(0.1)}, origin};
    const auto radiance = [=](const V& w) { return strong.pdf(w) > 0 ? T(1000) : weak.pdf(w) > 0 ? T(1) : T(0); };
    const auto lit = [&](const V& w) { return radiance(w) * cosine_of(w); };
    const double answer = std::numbers::pi * 0.8 * (1000 * 0.01 * 0.01 + 1.0 / 9);
    check<T>(resample(radiance, 16, choose(0.5, strong), choose(0.5, weak)), lit, answer);
    check<T>(resample(radiance, take(1, strong), take(1, weak)), lit, answer);
}

// The weight alone integrates 1, over where the target is positive.
TEST_CASE("contribution weights are estimates of 1 over a density", "[resample]") {
    const auto upper = resample([](const glm::dvec3& w) { return w.x > 0 ? 0.5 + w.z : 0.0; },
                                take(6, lumis::UniformHemisphere<double>{}));
    const auto law = z_test<double>([&](auto& u) { return upper.sample(u).contribution_weight; }, std::numbers::pi, 3);
    INFO(law.message);
    CHECK(law.passed);
}

TEST_CASE("a law that stops early knows an estimate's bound", "[resample]") {
    // f / target <= 1.6, and the mean of the weights <= 1.25.
    const auto resampled = resample([](double x) { return 0.25 + x; }, take(4, everywhere));
    lumis::Uniforms<std::mt19937_64, double> uniforms{std::mt19937_64{4}};
    const auto f = [](double x) { return 0.4 + x; };
    const auto estimate = [&] { return resampled.estimate(f, uniforms); };
    using lumis::testing::Bounded;
    CHECK(lumis::testing::unbiased(Bounded{0, 2, estimate}, 0.9, lumis::testing::Sequential{.at_most = 100'000}));
    CHECK_FALSE(
        lumis::testing::unbiased(Bounded{0, 2, estimate}, 0.93, lumis::testing::Sequential{.at_most = 100'000}));
}

// Two pixels with targets of their own. The first takes the second's sample over, as it is.
template <bool naive>
double reused(auto& uniforms) {
    constexpr int here_count = 2, there_count = 6;
    const auto f = [](double x) { return x * x + 1; };
    const auto target_here = [](double x) { return 0.25 + x; };
    const auto target_there = [](double x) { return x > 0.3 ? 1.0 : 0.0; };
    const auto here = resample(target_here, take(here_count, everywhere)).sample(uniforms);
    const auto there = resample(target_there, take(there_count, Ramp<double>{})).sample(uniforms);
    lumis::Reservoir<lumis::Sample<double, double>> kept;
    const auto add = [&](const auto& s, double weight) {
        kept.add(s.sample, weight * target_here(s.sample.value) * s.contribution_weight, uniforms.template next<1>().x);
    };
    // Balance, with the targets for the densities that nobody can state; naive: by the numbers of candidates alone.
    const auto share_here = [&](double x) {
        const double mine = here_count * target_here(x), theirs = there_count * target_there(x);
        return naive ? double{here_count} / (here_count + there_count) : mine / (mine + theirs);
    };
    add(here, share_here(here.sample.value));
    add(there, 1 - share_here(there.sample.value));
    const double x = kept.item().value;
    return f(x) * kept.contribution_weight(target_here(x));
}

TEST_CASE("a neighbour's sample is reused without bias under balance weights", "[resample]") {
    const auto law = z_test<double>([](auto& u) { return reused<false>(u); }, 4 / 3.0, 5);
    INFO(law.message);
    CHECK(law.passed);
    CHECK_FALSE(z_test<double>([](auto& u) { return reused<true>(u); }, 4 / 3.0, 5).passed);
}

}  // namespace
