// Samples that a host goes on with: what they add up to is an estimate, and their weights are those of the definition.
#include "assertions.hpp"
#include "catch.hpp"
#include "instrumented.hpp"
#include "one_dimensional.hpp"
#include <lumis/combine/multi_sample.hpp>
#include <lumis/combine/one_sample.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/lights/area_light.hpp>
#include <lumis/lights/light_set.hpp>
#include <lumis/microfacets/perfect_reflection.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

using lumis::choose;
using lumis::multi_sample;
using lumis::one_sample;
using lumis::take;

namespace {

const lumis::PowerHeuristic power;
const Ramp<double> ramp;
const Interval<double> left{0, 0.5};

constexpr auto f = [](double x) { return 1 + x * x; };

bool agree(double a, double b) {
    return std::abs(a - b) <= 8 * std::numeric_limits<double>::epsilon() * std::abs(b);
}

template <class E>
concept DrawsFromTemporary = requires(E estimator, CountingUniforms<double> uniforms) {
    static_cast<E&&>(estimator).template weighted_sample<0>(uniforms);
};

}  // namespace

TEST_CASE("samples times their factors add up to the estimate", "[weighted_sample]") {
    const auto check = [](const auto& heuristic) {
        const auto combined = multi_sample(heuristic, take(2, everywhere), take(1, ramp), take(3, left));
        CountingUniforms<double> uniforms, again;
        for (int i = 0; i < 100; ++i) {
            double sum = 0;
            for (int k = 0; k < 2; ++k) {
                const auto s = combined.template weighted_sample<0>(again);
                sum += f(s.sample.value) * s.factor();
                REQUIRE(s.density == 2 * s.sample.pdf);
            }
            const auto s = combined.template weighted_sample<1>(again);
            sum += f(s.sample.value) * s.weight() / s.density;
            for (int k = 0; k < 3; ++k) {
                const auto t = combined.template weighted_sample<2>(again);
                sum += f(t.sample.value) * t.factor();
            }
            REQUIRE(agree(sum, combined.estimate(f, uniforms)));
            REQUIRE(uniforms.spent == again.spent);
        }
    };
    check(lumis::BalanceHeuristic{});
    check(power);
    check(lumis::MaximumHeuristic{});
    check(lumis::PartitionWeights{[](double x) { return x > 0.3 ? 0 : 2; }});
}

TEST_CASE("a density that the host knows is not asked for, and counts as often as its technique draws",
          "[weighted_sample]") {
    Calls first, second, third;
    const auto combined = multi_sample(power, take(2, Instrumented{everywhere, &first}),
                                       take(3, Instrumented{ramp, &second}), take(1, Instrumented{left, &third}));
    CountingUniforms<double> uniforms;
    const auto s = combined.weighted_sample<0>(uniforms);
    CHECK(first.pdf + second.pdf + third.pdf == 0);
    const double x = s.sample.value, p1 = ramp.pdf(x), p2 = left.pdf(x);

    CHECK(s.weight() == lumis::mis_weight(power, 2.0, 3 * p1, p2));
    CHECK(second.pdf == 1);
    CHECK(third.pdf == 1);
    CHECK(s.weight() == combined.weight<0>(x));
    second = third = {};

    CHECK(s.weight_given<1>(5) == lumis::mis_weight(power, 2.0, 15.0, p2));
    CHECK(s.weight_given<1>(0.0f) == lumis::mis_weight(power, 2.0, 0.0, p2));
    CHECK(second.pdf == 0);
    CHECK(third.pdf == 2);
    CHECK(s.weight_given<2, 1>(7, 5) == lumis::mis_weight(power, 2.0, 15.0, 7.0));
    CHECK(third.pdf == 2);

    // By probability, and a technique that is left out, whatever the host says.
    const auto selected = one_sample(power, choose(0.25, everywhere), choose(0.75, ramp), choose(0, left));
    const auto t = selected.weighted_sample<1>(uniforms);
    CHECK(t.density == 0.75 * t.sample.pdf);
    CHECK(t.weight_given<0>(4) == lumis::mis_weight(power, t.density, 1.0));
    CHECK(t.weight_given<2>(std::numeric_limits<double>::infinity()) == t.weight());
}

TEST_CASE("a delta strategy's sample has weight 1, as its type tells", "[weighted_sample]") {
    const lumis::CosineHemisphere<float> cosine;
    const lumis::PerfectReflection<float> mirror{glm::vec3{0.6f, 0, 0.8f}}, below{glm::vec3{0, 0, -1}};
    const auto combined = multi_sample(power, take(1, cosine), take(4, mirror), take(1, below));
    CountingUniforms<float> uniforms;
    const auto s = combined.weighted_sample<1>(uniforms);
    STATIC_REQUIRE(s.is_delta);
    STATIC_REQUIRE(s.technique == 1);
    CHECK(s.density == 4);
    CHECK(s.weight() == 1);
    CHECK(s.weight_given<0>(3) == 1);
    CHECK(s.factor() == 0.25f);
    const auto nothing = combined.weighted_sample<2>(uniforms);
    CHECK(nothing.density == 0);
    CHECK(nothing.weight() == 0);
    CHECK(nothing.factor() == 0);
    const auto smooth = combined.weighted_sample<0>(uniforms);
    STATIC_REQUIRE_FALSE(smooth.is_delta);
    CHECK(smooth.weight() == 1);  // no other technique has a density
}

TEST_CASE("one sample is drawn by the technique that a uniform selects", "[weighted_sample]") {
    const auto combined =
        one_sample(power, choose(0.25, everywhere), choose(0.5, ramp), choose(0, left), choose(0.125, left));
    CountingUniforms<double> uniforms, again;
    std::array<int, 4> selected{};
    int nothing = 0;
    for (int i = 0; i < 8000; ++i) {
        double value = 0;
        const bool drawn = combined.weighted_sample(again, [&](const auto& s) {
            ++selected[s.technique];
            value = f(s.sample.value) * s.factor();
        });
        nothing += !drawn;
        REQUIRE(std::abs(value - combined.estimate(f, uniforms)) <= 1e-14);
        REQUIRE(uniforms.spent == again.spent);
    }
    CHECK(std::abs(selected[0] - 2000) <= 200);  // five standard deviations
    CHECK(std::abs(selected[1] - 4000) <= 230);
    CHECK(selected[2] == 0);
    CHECK(std::abs(selected[3] - 1000) <= 150);
    CHECK(std::abs(nothing - 1000) <= 150);
}

TEST_CASE("a sample that the host has drawn is weighed as one drawn here", "[weighted_sample]") {
    using Light = lumis::AreaLight<lumis::Sphere<float>>;
    const std::vector<Light> lights{{{{0, 0, 3}, 1}, glm::vec3{0}}, {{{2, 0, 3}, 1}, glm::vec3{0}}};
    const lumis::LightSet set{lights, std::vector<float>{1, 3}};
    const auto combined = multi_sample(power, take(1, lumis::CosineHemisphere<float>{}), take(2, set));
    const auto [index, sample] = set.sample_one({0.9f, 0.1f, 0.2f});
    CHECK(index == 1);
    const auto s = combined.weighted<1>(sample);
    CHECK(s.density == 2 * sample.pdf);
    CHECK(s.sample.distance == sample.distance);
    CHECK(s.weight() == lumis::mis_weight(power, 2 * sample.pdf, lumis::CosineHemisphere<float>{}.pdf(sample.value)));
}

TEST_CASE("a sample does not outlive its estimator unseen", "[weighted_sample]") {
    const auto combined = multi_sample(power, take(1, everywhere));
    using Estimator = std::remove_const_t<decltype(combined)>;
    STATIC_REQUIRE(DrawsFromTemporary<const Estimator&>);
    STATIC_REQUIRE_FALSE(DrawsFromTemporary<Estimator>);
}
