// The laws of materials: what they accept, and what they refuse, with how small an error.
#include "broken.hpp"
#include "catch.hpp"
#include "scattering_subjects.hpp"
#include <lumis/microfacets/ggx.hpp>
#include <lumis/microfacets/ggx_reflection.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace {

using subjects::direction, subjects::label, subjects::normals_chart;

// GGX by visible normals, with the weight that a path goes on with: G2 / G1, times what it is wrong by.
template <class T>
struct WeighingGgx {
    using Scalar = T;
    using Point = lumis::Direction<T>;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;

    struct Drawn {
        Point value;
        T pdf, weight;
    };

    Point wo;
    glm::vec<2, T> alpha;
    double wrong = 1;

    Drawn sample(glm::vec<2, T> u) const noexcept {
        const auto [wi, density] = lumis::GgxReflection<T>{wo, alpha}.sample(u);
        const lumis::Ggx<T> ggx{alpha};
        const auto weight = static_cast<T>(wrong) * ggx.G2(wo, wi) / ggx.G1(wo);
        return {wi, density, density > 0 ? weight : T(0)};
    }
    T pdf(const Point& wi) const noexcept { return lumis::GgxReflection<T>{wo, alpha}.pdf(wi); }
};

template <class T>
laws::LawResult weighs(const glm::dvec3& wo, const glm::dvec2& alpha, double wrong) {
    using V3 = glm::vec<3, T>;
    const WeighingGgx<T> strategy{V3{wo}, glm::vec<2, T>{alpha}, wrong};
    const auto f_cos = [&](const V3& wi) {
        return lumis::Ggx<T>{strategy.alpha}.brdf(strategy.wo, wi) * std::fmax(wi.z, T(0));
    };
    laws::WeightOptions options;
    options.samples = 2000;
    return laws::weighs(strategy, f_cos, options);
}

// Minnaert's moon (1941): reciprocal, and reflects albedo cos(theta_o)^(k - 1) of what comes in.
auto minnaert(double albedo, double k) {
    return [=](const glm::dvec3& wo, const glm::dvec3& wi) {
        if (!(wo.z > 0 && wi.z > 0)) return 0.0;
        return albedo * (k + 1) / (2 * std::numbers::pi) * std::pow(wo.z * wi.z, k - 1);
    };
}

}  // namespace

TEMPLATE_TEST_CASE("the weight of a sample is f cos / pdf", "[laws]", float, double) {
    for (const auto& wo : subjects::views) {
        for (const glm::dvec2 alpha : {glm::dvec2{0.01}, glm::dvec2{0.5}, glm::dvec2{0.4, 0.05}}) {
            const auto right = weighs<TestType>(wo, alpha, 1);
            INFO(label("wo ", wo, ", alpha ", alpha) << ": " << right);
            CHECK(right.passed);
            CHECK_FALSE(weighs<TestType>(wo, alpha, 0.999).passed);
            const auto wrong = weighs<TestType>(wo, alpha, 1.001);
            CHECK_FALSE(wrong.passed);
            CHECK(wrong.message.find("; weights exceed f cos / pdf by the same factor 1.001 at all ") !=
                  std::string::npos);
        }
    }
}

TEST_CASE("weights of nothing, and weights in colour", "[laws]") {
    struct Weighed {
        V value;
        double pdf;
        glm::dvec3 weight;
    };
    const auto material = [](double of_nothing, double blue) {
        return Broken{Cosine{},
                      [=](const auto& sample) {
                          const bool drawn = sample.value.x > 0 && sample.pdf > 0;
                          return Weighed{sample.value, drawn ? sample.pdf : 0,
                                         drawn ? glm::dvec3{0.2, 0, blue} : glm::dvec3{of_nothing}};
                      },
                      [](const V& w, double pdf) { return w.x > 0 ? pdf : 0; }};
    };
    const auto f_cos = [](const V& w) { return w.x > 0 ? std::fmax(w.z, 0) / std::numbers::pi * V{0.2, 0, 0.7} : V{}; };
    CHECK(laws::weighs(material(0, 0.7), f_cos));
    CHECK_FALSE(laws::weighs(material(0, 0.71), f_cos).passed);
    CHECK_FALSE(laws::weighs(material(0, std::nan("")), f_cos).passed);
    CHECK_FALSE(laws::weighs(material(1, 0.7), f_cos).passed);
    CHECK(laws::weighs(material(1, 0.7), f_cos).message.find("of nothing drawn") != std::string::npos);
}

namespace {

// A strategy that weighs what it drew only if it is asked.
struct Asked : Cosine {
    double albedo;

    double weight(const V&) const noexcept { return albedo; }
};

}  // namespace

TEST_CASE("weights of points", "[laws]") {
    const auto f_cos = [](const V& w) { return 0.5 * std::fmax(w.z, 0) / std::numbers::pi; };
    CHECK(laws::weighs(Asked{{}, 0.5}, f_cos));
    CHECK_FALSE(laws::weighs(Asked{{}, 0.501}, f_cos).passed);
}

TEST_CASE("reciprocity", "[laws]") {
    for (const double alpha : {1e-3, 0.1, 1.0}) {
        const lumis::Ggx<double> ggx{alpha};
        const lumis::Ggx<float> in_float{static_cast<float>(alpha)};
        const auto f = [&](const glm::dvec3& wo, const glm::dvec3& wi) { return ggx.brdf(wo, wi); };
        INFO(alpha);
        CHECK(laws::is_reciprocal(f));
        CHECK(laws::is_reciprocal([&](const glm::vec3& wo, const glm::vec3& wi) { return in_float.brdf(wo, wi); }));
        // A lobe that knows which way is out.
        CHECK_FALSE(laws::is_reciprocal([&](const V& wo, const V& wi) { return f(wo, wi) * (1 + 1e-6 * wo.z); }));
        // Wrong only in the lobe's peak: no other pair would meet it.
        const auto near_mirror = [](const V& wo, const V& wi) {
            return glm::length(wo + wi - V{0, 0, wo.z + wi.z}) < 1e-3;
        };
        CHECK_FALSE(laws::is_reciprocal(
            [&](const V& wo, const V& wi) { return f(wo, wi) * (near_mirror(wo, wi) ? 2 + wo.z - wi.z : 1); }));
    }
    CHECK(laws::is_reciprocal(minnaert(1, 1.7)));
    CHECK_FALSE(laws::is_reciprocal([](const V& wo, const V& wi) { return wo.z + 1.001 * wi.z; }));
    CHECK_FALSE(laws::is_reciprocal([](const V&, const V&) { return glm::dvec3{1, 1, -1}; }));
    CHECK_FALSE(laws::is_reciprocal([](const V&, const V&) { return std::nan(""); }));
    const auto through = [](const V& wo, const V& wi) { return wo.z > 0 && wi.z < 0 ? 1.0 : 0.0; };
    CHECK(laws::is_reciprocal(through));
    CHECK_FALSE(laws::is_reciprocal(through, {.both_sides = true}));
}

TEST_CASE("no more light leaves than comes in", "[laws]") {
    for (const auto& wo : {subjects::views[0], subjects::views[2]}) {
        for (const double alpha : {0.01, 0.5}) {
            const lumis::Ggx<double> ggx{alpha};
            const auto f = [&](const V& a, const V& b) { return ggx.brdf(a, b); };
            const auto chart = laws::reflected_chart(wo, normals_chart(glm::dvec2{alpha}));
            const auto law = laws::conserves_energy(f, wo, chart);
            INFO(label("wo ", wo, ", alpha ", alpha) << ": " << law);
            CHECK(law.passed);
            CHECK(law.number > 0.6);
        }
    }
    const V up{0, 0, 1}, slanted = direction(0.25, 1);
    const auto reflected = laws::conserves_energy(minnaert(0.9, 1.5), slanted);
    CHECK(reflected.passed);
    CHECK(std::abs(reflected.number - 0.9 * 0.5) <= 1e-6);  // 0.9 cos^0.5
    CHECK(laws::conserves_energy(minnaert(1, 1), slanted));
    const auto brighter = laws::conserves_energy(minnaert(1.001, 1), up);
    CHECK_FALSE(brighter.passed);
    CHECK(brighter.decided);
    CHECK(laws::conserves_energy(minnaert(1.02, 1), up, laws::sphere_chart(), {.most = 1.02}));
    // A colour is as bright as its brightest component; what passes through counts too.
    const auto tinted = [](const V&, const V& wi) { return wi.z < 0 ? V{0.1, 0.5, 0.2} / std::numbers::pi : V{0.2}; };
    CHECK(std::abs(laws::conserves_energy(tinted, up).number - (0.5 + 0.2 * std::numbers::pi)) <= 1e-6);
    CHECK_FALSE(laws::conserves_energy(tinted, up).passed);
    // Too rough for any quadrature.
    const auto comb = [](const V&, const V& wi) { return std::sin(1e7 * wi.x) + std::sin(1e7 * wi.y) > 0 ? 0.7 : 0.0; };
    const auto undecided = laws::conserves_energy(comb, up);
    INFO(undecided);
    CHECK_FALSE(undecided.passed);
    CHECK_FALSE(undecided.decided);
}
