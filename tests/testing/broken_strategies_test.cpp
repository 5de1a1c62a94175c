// A law is worth what it refuses: strategies broken on purpose, each of which the laws must fail.
#include "broken.hpp"
#include "catch.hpp"
#include "strategies.hpp"
#include <lumis/testing/laws.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

TEST_CASE("agreement refuses", "[laws]") {
    const auto refused = [](const auto& strategy, const char* part) {
        const auto law = laws::agreement(strategy);
        INFO(law.message);
        CHECK_FALSE(law.passed);
        CHECK(law.message.find(part) != std::string::npos);
    };
    REQUIRE(laws::agreement(Broken{Cosine{}, same_sample, same_pdf}).passed);
    refused(Broken{Cosine{}, same_sample, [](const V&, double pdf) { return 2 * pdf; }}, "drawn with density");
    refused(Broken{Cosine{}, same_sample, [](const V&, double pdf) { return pdf / 2; }}, "by the same factor 2 at all");
    refused(Broken{Cosine{}, same_sample, [](const V& w, double pdf) { return pdf / (1 + w.z); }},
            "by factors from 1.");
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
    CHECK(laws::jacobian(reflection).passed);
    CHECK_FALSE(laws::jacobian(no_jacobian).passed);
}

// The visible normals' density without its masking term: D(wm) wo.wm / wo.z.
TEST_CASE("the laws refuse visible normals without G1", "[laws]") {
    const V wo = subjects::direction(0.2, 1);
    const lumis::GgxVndf<double> normals{wo, glm::dvec2{0.6, 0.6}};
    const auto no_masking =
        consistently_broken(normals, [&](const V&, double pdf) { return pdf / normals.ggx().G1(wo); });
    const auto chart = subjects::normals_chart({0.6, 0.6});
    CHECK(laws::integrates(normals, chart).passed);
    CHECK_FALSE(laws::integrates(no_masking, chart).passed);
    CHECK_FALSE(laws::chi_square(no_masking, chart).passed);
    CHECK(laws::jacobian(normals).passed);
    CHECK_FALSE(laws::jacobian(no_masking).passed);
}

TEST_CASE("the Jacobian law refuses", "[laws]") {
    const auto doubled = [](const V&, double pdf) { return 2 * pdf; };
    CHECK(laws::jacobian(Cosine{}).passed);
    CHECK(laws::jacobian(lumis::CosineHemisphere<float>{}).passed);
    CHECK_FALSE(laws::jacobian(consistently_broken(Cosine{}, doubled)).passed);
    CHECK_FALSE(laws::jacobian(consistently_broken(Cosine{}, [](const V&, double pdf) { return 1.001 * pdf; })).passed);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(laws::jacobian(consistently_broken(Cosine{}, [nan](const V&, double) { return nan; })).passed);
    const auto poisoned = [nan](auto sample) {
        sample.value.x = nan;
        return sample;
    };
    CHECK_FALSE(laws::jacobian(Broken{Uniform{}, poisoned, same_pdf}).passed);
    // A map of steps has no Jacobian.
    const auto stepped = [](auto sample) {
        sample.value = glm::normalize(glm::round(sample.value * 1000.0));
        return sample;
    };
    CHECK_FALSE(laws::jacobian(Broken{Uniform{}, stepped, same_pdf}).passed);

    // A table whose density forgot the size of its cells, in one dimension and in two.
    const lumis::PiecewiseConstant1D line{std::vector{1.0, 3.0}};
    CHECK(laws::jacobian(line).passed);
    CHECK_FALSE(laws::jacobian(consistently_broken(line, [](double, double pdf) { return pdf / 2; })).passed);
    const lumis::PiecewiseConstant2D square{2, 2, std::vector{1.0, 3.0, 0.5, 2.0}};
    CHECK(laws::jacobian(square).passed);
    CHECK_FALSE(laws::jacobian(consistently_broken(square, [](const auto&, double pdf) { return pdf / 4; })).passed);
    STATIC_REQUIRE_FALSE(laws::MapsUniforms<lumis::AliasTable<double>>);
}

namespace {

// An environment map whose samples lie half a texel beside what pdf looks up.
struct Shifted {
    using Scalar = double;
    using Point = V;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;

    const lumis::EnvironmentMap<double>& map;
    double turn;

    static V turned(const V& w, double turn) noexcept {
        const auto circle = lumis::unit_circle(turn);
        return {circle.x * w.x - circle.y * w.z, w.y, circle.y * w.x + circle.x * w.z};
    }
    auto sample(glm::dvec2 u) const noexcept {
        auto sample = map.sample(u);
        sample.value = turned(sample.value, turn);
        return sample;
    }
    double pdf(const V& w) const noexcept { return map.pdf(w); }
    glm::dvec2 invert(const V& w) const noexcept { return map.invert(w); }
};

}  // namespace

TEST_CASE("the laws refuse a shift by half a texel", "[laws]") {
    std::vector<double> texels;
    for (int i = 0; i < 16 * 8; ++i) texels.push_back(1 + i % 7);
    const lumis::EnvironmentMap map{16, 8, texels};
    const auto chart = laws::latlong_chart(16, 8);
    CHECK(laws::agreement(Shifted{map, 0}).passed);
    CHECK_FALSE(laws::agreement(Shifted{map, 0.5 / 16}).passed);
    CHECK(laws::chi_square(Shifted{map, 0}, chart).passed);
    CHECK_FALSE(laws::chi_square(Shifted{map, 0.5 / 16}, chart).passed);
    CHECK(laws::round_trip(Shifted{map, 0}).passed);
    CHECK_FALSE(laws::round_trip(Shifted{map, 0.5 / 16}).passed);
}

namespace {

template <class S, class SpoilInverse>
struct BrokenInverse : S {
    SpoilInverse spoil;

    glm::dvec2 invert(const V& w) const noexcept { return spoil(S::invert(w)); }
};

}  // namespace

TEST_CASE("the round trip refuses", "[laws]") {
    const auto passes = [](auto spoil) {
        return laws::round_trip(BrokenInverse<Cosine, decltype(spoil)>{{}, spoil}).passed;
    };
    using U = glm::dvec2;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(passes([](U u) { return u; }));
    CHECK_FALSE(passes([](U u) { return U{u.y, u.x}; }));
    CHECK_FALSE(passes([](U u) { return U{1 - u.x, u.y}; }));
    CHECK_FALSE(passes([](U u) { return U{u.x, u.y + 1}; }));
    CHECK_FALSE(passes([](U u) { return U{u.x, u.y < 0.5 ? u.y + 0.5 : u.y - 0.5}; }));
    CHECK_FALSE(passes([](U u) { return U{u.x * (1 + 1e-10), u.y}; }));
    CHECK_FALSE(passes([nan](U u) { return U{u.x, u.y > 0.99 ? nan : u.y}; }));
}

TEST_CASE("the delta law refuses", "[laws]") {
    using Mirror = lumis::PerfectReflection<double>;
    struct WithDensity : Mirror {
        double pdf(const V& w) const noexcept { return w.z > 0 ? 1 : 0; }
    };
    struct TooLong : Mirror {
        auto sample(glm::dvec2 u) const noexcept {
            auto sample = Mirror::sample(u);
            sample.value.z = 0.9;
            return sample;
        }
    };
    struct WithoutLimit : Mirror {
        auto sample(glm::dvec2 u) const noexcept {
            auto sample = Mirror::sample(u);
            sample.pdf = std::numeric_limits<double>::infinity();
            return sample;
        }
    };
    CHECK(laws::draws_deltas(Mirror{V{0.6, 0, 0.8}}).passed);
    CHECK_FALSE(laws::draws_deltas(TooLong{Mirror{V{0.6, 0, 0.8}}}).passed);
    CHECK_FALSE(laws::draws_deltas(WithDensity{Mirror{V{0.6, 0, 0.8}}}).passed);
    CHECK_FALSE(laws::draws_deltas(WithoutLimit{Mirror{V{0.6, 0, 0.8}}}).passed);
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

namespace {

// The textbook's cone: 1 - cos(theta) as a difference, which in float has no digits left for a small light.
template <class T>
struct TextbookCone {
    using Scalar = T;
    using Point = lumis::Direction<T>;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;

    T half_angle;

    lumis::Sample<Point, T> sample(glm::vec<2, T> u) const noexcept {
        const T versine = 1 - std::cos(half_angle);
        return {lumis::direction_at(u.x * versine, u.y), pdf({T(0), T(0), T(1)})};
    }
    T pdf(const Point& w) const noexcept {
        const T pdf = std::numbers::inv_pi_v<T> / (2 * (1 - std::cos(half_angle)));
        return w.z >= std::cos(half_angle) ? lumis::density_or_zero(pdf) : T(0);
    }
};

}  // namespace

TEST_CASE("the law of stability refuses", "[laws]") {
    const auto cone = []<class T>(double half_angle) { return TextbookCone<T>{static_cast<T>(half_angle)}; };
    CHECK(laws::stability(std::vector{1.0, 0.5}, cone).passed);
    const auto law = laws::stability(std::vector{1.0, 0.5, 0x1p-12}, cone);
    CHECK_FALSE(law.passed);
    CHECK(law.message.find("parameter 2") != std::string::npos);

    // Finite in double only.
    const auto overflowing = []<class T>(double radius) {
        const auto squared = [radius](const auto&, T) { return T(1) / static_cast<T>(radius * radius); };
        const auto spoil = [squared](auto sample) {
            sample.pdf = squared(sample.value, sample.pdf);
            return sample;
        };
        return Broken{lumis::UniformHemisphere<T>{}, spoil, squared};
    };
    CHECK(laws::stability(std::vector{1.0}, overflowing, {.undecided = 1}).passed);
    CHECK_FALSE(laws::stability(std::vector{1e-30}, overflowing, {.undecided = 1}).passed);
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
