// Estimators of known integrals are unbiased under every heuristic, in both models, with techniques left out too.
#include "catch.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/laws.hpp>

#include <glm/geometric.hpp>

#include <numbers>
#include <vector>

namespace {

namespace laws = lumis::testing;

// All tests here are one family: a correct library fails any with probability 0.01.
constexpr laws::HeuristicsOptions options{100'000, {0.01, 10}};

void check(const laws::UnbiasedResult& law, double bias) {
    INFO(law.message);
    CHECK(law.passed);
    // So large a bias of the least precise of the estimators would have been seen.
    CHECK(law.smallest_bias_seen < bias);
}

template <class T>
void check_lights() {
    using V = glm::vec<3, T>;
    const V origin(T(0));
    const auto cosine = [](const V& w) { return w.z > 0 ? w.z : T(0); };

    // Lambertian emitters of radiance 1 above a receiver; closed forms (Lambert).
    const lumis::CosineHemisphere<T> hemisphere;
    const lumis::Parallelogram<T> square{V(-1, -1, 1), V(2, 0, 0), V(0, 2, 0)};
    const lumis::AreaLight<lumis::Parallelogram<T>, lumis::BySolidAngle> square_light{square, origin};
    const auto square_seen = [&](const V& w) { return square_light.pdf(w) > 0 ? cosine(w) : T(0); };
    check(laws::unbiased_under_every_heuristic(square_seen, 1.740839502734, laws::factors_of_two, options, hemisphere,
                                               square_light),
          0.05);

    const lumis::AreaLight sphere_light{lumis::Sphere<T>{V(0, 0, 2), T(1)}, origin};
    const auto sphere_seen = [&](const V& w) { return sphere_light.pdf(w) > 0 ? cosine(w) : T(0); };
    check(laws::unbiased_under_every_heuristic(sphere_seen, std::numbers::pi / 4, laws::factors_of_two, options,
                                               hemisphere, sphere_light),
          0.05);

    // Two such lights, apart: their set against the hemisphere.
    using Light = lumis::AreaLight<lumis::Parallelogram<T>, lumis::BySolidAngle>;
    const lumis::LightSet set{
        std::vector<Light>{square_light, Light{{V(-1, -1, -1), V(2, 0, 0), V(0, 2, 0)}, origin}, square_light},
        std::vector<T>{T(1), T(1), T(0)}};
    check(laws::unbiased_under_every_heuristic(square_seen, 1.740839502734, laws::factors_of_two, options, hemisphere,
                                               set),
          0.05);
}

}  // namespace

TEST_CASE("light sampling is unbiased under every heuristic", "[laws]") {
    SECTION("float") {
        check_lights<float>();
    }
    SECTION("double") {
        check_lights<double>();
    }
}

// The step of 8 and 80 over [0, 1]: the second technique covers but its upper tenth, and cannot stand alone.
TEST_CASE("a technique that covers a part is unbiased beside one that covers all", "[laws]") {
    const lumis::PiecewiseConstant1D all{std::vector<double>(10, 1.0)};
    const lumis::PiecewiseConstant1D upper{std::vector<double>{0, 0, 0, 0, 0, 0, 0, 0, 0, 1}};
    const auto f = [](double x) { return x < 0.9 ? 8.0 : 80.0; };
    const laws::Factors<2> factors{{{1, 1}, {1, 3}, {3, 1}, {1, 0}}, {{0.5, 0.5}, {0.2, 0.8}, {1, 0}}};
    check(laws::unbiased_under_every_heuristic(f, 15.2, factors, options, all, upper), 0.05);
    const laws::Factors<2> alone{{{0, 1}}, {{0, 1}}};
    CHECK_FALSE(laws::unbiased_under_every_heuristic(f, 15.2, alone, options, all, upper).passed);
}

TEST_CASE("three techniques are unbiased under every heuristic", "[laws]") {
    using V = glm::dvec3;
    const lumis::CosineHemisphere<double> cosine;
    const lumis::UniformHemisphere<double> uniform;
    const lumis::UniformSphere<double> sphere;
    const laws::Factors<3> factors{{{1, 1, 1}, {3, 1, 0}, {0, 2, 3}}, {{0.2, 0.3, 0.5}, {0, 0.6, 0.4}, {1, 0, 0}}};
    const auto f = [](const V& w) { return w.z > 0 ? w.z : 0.0; };
    check(laws::unbiased_under_every_heuristic(f, std::numbers::pi, factors, options, cosine, uniform, sphere), 0.05);
}
