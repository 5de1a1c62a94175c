// A law is worth what it refuses: strategies broken on purpose, each of which the laws must fail.
#include "catch.hpp"
#include "strategies.hpp"
#include <lumis/testing/laws.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

namespace {

namespace laws = lumis::testing;

// A strategy whose samples and densities pass through a spoiler: spoil_sample(sample), spoil_pdf(w, pdf).
template <class S, class SpoilSample, class SpoilPdf>
struct Broken {
    using Scalar = typename S::Scalar;
    using Point = typename S::Point;
    using Measure = typename S::Measure;
    static constexpr int dimensions = S::dimensions;

    S strategy;
    SpoilSample spoil_sample;
    SpoilPdf spoil_pdf;

    auto sample(lumis::UniformsOf<S> u) const noexcept { return spoil_sample(strategy.sample(u)); }
    Scalar pdf(const Point& w) const noexcept { return spoil_pdf(w, strategy.pdf(w)); }
};
template <class S, class SpoilSample, class SpoilPdf>
Broken(S, SpoilSample, SpoilPdf) -> Broken<S, SpoilSample, SpoilPdf>;

using V = glm::dvec3;
using Cosine = lumis::CosineHemisphere<double>;
using Uniform = lumis::UniformHemisphere<double>;

constexpr auto same_sample = [](auto sample) { return sample; };
constexpr auto same_pdf = [](const V&, double pdf) { return pdf; };

// Sample and density spoilt alike, by a function of direction and density.
template <class S, class Spoil>
auto consistently_broken(const S& strategy, Spoil spoil) {
    return Broken{strategy,
                  [spoil](auto sample) {
                      sample.pdf = spoil(sample.value, sample.pdf);
                      return sample;
                  },
                  spoil};
}

}  // namespace

TEST_CASE("agreement refuses", "[laws]") {
    const auto refused = [](const auto& strategy, const char* part) {
        const auto law = laws::agreement(strategy);
        INFO(law.message);
        CHECK_FALSE(law.passed);
        CHECK(law.message.find(part) != std::string::npos);
    };
    REQUIRE(laws::agreement(Broken{Cosine{}, same_sample, same_pdf}).passed);
    refused(Broken{Cosine{}, same_sample, [](const V&, double pdf) { return 2 * pdf; }}, "drawn with density");
    refused(Broken{Cosine{}, same_sample, [](const V&, double pdf) { return (1 + 1e-10) * pdf; }},
            "drawn with density");
    refused(Broken{Cosine{}, same_sample, [](const V& w, double pdf) { return w.z < 0.01 ? 0 : pdf; }}, "but pdf is 0");
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, inf, -1.0}) {
        refused(consistently_broken(Cosine{}, [bad](const V& w, double pdf) { return w.z < 0.05 ? bad : pdf; }), "pdf");
    }
    refused(Broken{Cosine{}, same_sample, [nan](const V& w, double pdf) { return w.z < 0.05 ? nan : pdf; }}, "but pdf");
    const auto stretched = [](auto sample) {
        sample.value *= 1 + 1e-14;
        return sample;
    };
    refused(Broken{Uniform{}, stretched, same_pdf}, "length");
    const auto poisoned = [nan](auto sample) {
        if (sample.value.x > 0.9) sample.value.x = nan;
        return sample;
    };
    refused(Broken{Uniform{}, poisoned, same_pdf}, "value");
}

TEST_CASE("integration refuses", "[laws]") {
    const auto integrates = [](const auto& strategy) {
        return laws::integrates(strategy, laws::sphere_chart()).passed;
    };
    REQUIRE(integrates(Cosine{}));
    CHECK_FALSE(integrates(consistently_broken(Cosine{}, [](const V&, double pdf) { return 2 * pdf; })));
    CHECK_FALSE(integrates(consistently_broken(Cosine{}, [](const V&, double pdf) { return 1.00001 * pdf; })));
    // To draw nothing at times is no fault, but it is not what was stated.
    const auto at_times = consistently_broken(Cosine{}, [](const V& w, double pdf) { return w.x > 0.5 ? 0 : pdf; });
    CHECK(integrates(at_times));
    CHECK_FALSE(laws::integrates(at_times, laws::sphere_chart(), {.probability = 1.0}).passed);
    // Density where nothing is ever drawn: a cosine that forgot its horizon.
    CHECK_FALSE(integrates(
        consistently_broken(Cosine{}, [](const V& w, double) { return std::abs(w.z) * std::numbers::inv_pi; })));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(
        integrates(consistently_broken(Cosine{}, [nan](const V& w, double pdf) { return w.x > 0.9 ? nan : pdf; })));
    CHECK_FALSE(laws::integrates(Cosine{}, laws::sphere_chart(), {.probability = 0.9}).passed);
}

TEST_CASE("chi-square refuses", "[laws]") {
    const auto passes = [](const auto& strategy, const laws::DirectionChart& chart = laws::sphere_chart()) {
        return laws::chi_square(strategy, chart).passed;
    };
    REQUIRE(passes(Cosine{}));
    // The right density of the wrong samples.
    CHECK_FALSE(passes(Broken{Uniform{}, same_sample, [](const V& w, double) { return Cosine{}.pdf(w); }}));
    CHECK_FALSE(passes(consistently_broken(Cosine{}, [](const V&, double pdf) { return 2 * pdf; })));
    CHECK_FALSE(passes(consistently_broken(Cosine{}, [](const V&, double pdf) { return 0.5 * pdf; })));
    const auto tilted = [](auto sample) {
        sample.value = glm::normalize(sample.value + V{0.02, 0, 0});
        return sample;
    };
    CHECK_FALSE(passes(Broken{Uniform{}, tilted, same_pdf}));
    // One sample in many falls where the density is 0.
    const auto leaking = [](auto sample) {
        if (sample.value.x > 0.999) sample.value = {0, 0, -1};
        return sample;
    };
    CHECK_FALSE(passes(Broken{Uniform{}, leaking, same_pdf}));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto poisoned = [nan](auto sample) {
        if (sample.value.x > 0.999) sample.value = {nan, nan, nan};
        return sample;
    };
    CHECK_FALSE(passes(Broken{Uniform{}, poisoned, same_pdf}));
}

// The half vector's density taken for the direction's: the reflection's Jacobian is missing.
TEST_CASE("the laws refuse a reflection without its Jacobian", "[laws]") {
    const V wo = subjects::direction(0.5, 1);
    const lumis::GgxReflection<double> reflection{wo, glm::dvec2{0.2, 0.2}};
    const auto no_jacobian = consistently_broken(
        reflection, [wo](const V& w, double pdf) { return pdf * 4 * glm::dot(wo, glm::normalize(wo + w)); });
    const auto chart = laws::reflected_chart(wo, subjects::normals_chart({0.2, 0.2}));
    CHECK(laws::integrates(reflection, chart).passed);
    CHECK_FALSE(laws::integrates(no_jacobian, chart).passed);
    CHECK(laws::chi_square(reflection, chart).passed);
    CHECK_FALSE(laws::chi_square(no_jacobian, chart).passed);
}

TEST_CASE("stability refuses", "[laws]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(laws::stays_finite(Cosine{}).passed);
    CHECK_FALSE(laws::stays_finite(Broken{Cosine{}, same_sample, [](const V& w, double) { return w.z; }}).passed);
    CHECK_FALSE(laws::stays_finite(consistently_broken(Cosine{}, [nan](const V& w, double pdf) {
                    return w.z == 0 ? nan : pdf;
                })).passed);
    CHECK_FALSE(laws::draws_nothing(Cosine{}).passed);
}

TEST_CASE("unbiasedness refuses", "[laws]") {
    auto uniforms = lumis::Uniforms<std::mt19937_64, double>{std::mt19937_64{1}};
    const auto estimate = [&] { return 2 * uniforms.next<1>().x; };
    const auto fair = laws::unbiased(estimate, 1);
    CHECK(fair.passed);
    CHECK(fair.smallest_bias_seen < 0.002);
    CHECK_FALSE(laws::unbiased([&] { return 1.003 * estimate(); }, 1).passed);
    CHECK_FALSE(laws::unbiased([&] { return 0.997 * estimate(); }, 1).passed);
    bool once = true;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(laws::unbiased([&] { return std::exchange(once, false) ? nan : estimate(); }, 1).passed);
    CHECK(laws::unbiased([] { return 1.0; }, 1).passed);
    CHECK_FALSE(laws::unbiased([] { return 1.0; }, 1.0001).passed);
}

// The p-values of a correct strategy are uniform: the test is neither too strict nor too lax.
TEST_CASE("chi-square's p-values are what they say", "[laws]") {
    const auto expected = laws::expectation(laws::density_of(Cosine{}), laws::sphere_chart(), 10, 10);
    constexpr int tests = 400;
    int below_tenth = 0, below_half = 0;
    for (int i = 0; i < tests; ++i) {
        laws::ChiSquareOptions options;
        options.samples = 5000;
        options.seed = static_cast<std::uint64_t>(i);
        const double p = laws::chi_square(Cosine{}, expected, options).number;
        below_tenth += p < 0.1;
        below_half += p < 0.5;
    }
    // Four standard deviations: a false alarm in 8,000.
    CHECK(std::abs(below_tenth - 40) <= 24);
    CHECK(std::abs(below_half - 200) <= 40);
}
