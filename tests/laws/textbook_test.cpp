// What the benchmarks compare Lumis with draws the same and tells the same densities, to rough rounding: a rival that is
// wrong would be no rival.
#include "../bench/textbook/dielectric.hpp"
#include "../bench/textbook/directions.hpp"
#include "../bench/textbook/ggx.hpp"
#include "../bench/textbook/lights.hpp"
#include "../bench/textbook/tables.hpp"
#include "../bench/textbook/weights.hpp"
#include "catch.hpp"
#include <lumis/lumis.hpp>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace {

using Vector = glm::vec3;

double relative(double a, double b) {
    return std::abs(a - b) / std::fmax(std::abs(a), std::abs(b));
}

struct Tolerance {
    double direction = 1e-4, pdf = 1e-3;  // of float, and of formulas that cancel
    double undecided = 0.01;              // share of uniforms at an edge
};

// At the same uniforms.
template <class Book, class Strategy>
void check_same(const Book& book, const Strategy& strategy, Tolerance tolerance = {}) {
    std::mt19937_64 engine{5};
    lumis::Uniforms uniforms{engine};
    constexpr int draws = 20000;
    int apart = 0, drawn = 0, elsewhere = 0, missed = 0;
    for (int i = 0; i < draws; ++i) {
        const auto u = uniforms.next<Strategy::dimensions>();
        const auto a = book.sample(u);
        const auto b = strategy.sample(u);
        apart += (a.pdf > 0) != (b.pdf > 0);
        if (a.pdf > 0 && b.pdf > 0) {
            ++drawn;
            elsewhere += !(glm::length(a.value - b.value) <= tolerance.direction);
            REQUIRE(relative(a.pdf, b.pdf) <= tolerance.pdf);
            const double pdf = book.pdf(a.value);
            missed += pdf == 0;  // rounded across an edge
            if (pdf > 0) REQUIRE(relative(pdf, a.pdf) <= tolerance.pdf);
        }
        const auto any = uniforms.next<2>();
        const auto w = lumis::direction_at(2 * any.x, any.y);
        const double here = book.pdf(w), there = strategy.pdf(w);
        apart += (here > 0) != (there > 0);
        if (here > 0 && there > 0) REQUIRE(relative(here, there) <= tolerance.pdf);
    }
    CHECK(drawn >= draws / 2);
    CHECK(apart <= tolerance.undecided * draws);
    CHECK(elsewhere <= tolerance.undecided * draws);
    CHECK(missed <= tolerance.undecided * draws);
}

}  // namespace

TEST_CASE("the textbook's directions are those of Lumis", "[textbook]") {
    check_same(textbook::CosineHemisphere<float>{}, lumis::CosineHemisphere<float>{}, {1e-3, 5e-2});
    check_same(textbook::UniformHemisphere<float>{}, lumis::UniformHemisphere<float>{});
    check_same(textbook::UniformSphere<float>{}, lumis::UniformSphere<float>{});
    check_same(textbook::UniformCone<float>{std::cos(0.3f)}, lumis::UniformCone{0.3f});
}

TEST_CASE("the textbook's concentric map has the cosine's moments", "[textbook]") {
    lumis::Uniforms uniforms{std::mt19937_64{5}};
    double z = 0, z2 = 0, x = 0;
    constexpr int draws = 100000;
    for (int i = 0; i < draws; ++i) {
        const auto drawn = textbook::ConcentricCosineHemisphere<float>{}.sample(uniforms.next<2>());
        z += drawn.value.z, z2 += drawn.value.z * drawn.value.z, x += drawn.value.x;
    }
    CHECK(std::abs(z / draws - 2.0 / 3) <= 0.004);  // five standard errors
    CHECK(std::abs(z2 / draws - 0.5) <= 0.005);
    CHECK(std::abs(x / draws) <= 0.008);
}

TEST_CASE("the textbook's GGX reflection is that of Lumis", "[textbook]") {
    const Vector wo = glm::normalize(Vector{1, 0.5f, 1});
    const glm::vec2 alpha{0.2f, 0.4f};
    const textbook::GgxReflection<float> book{wo, alpha};
    const lumis::GgxReflection<float> reflection{wo, alpha};
    check_same(book, reflection);

    lumis::Uniforms uniforms{std::mt19937_64{5}};
    for (int i = 0; i < 10000; ++i) {
        const auto wi = lumis::CosineHemisphere<float>{}.sample(uniforms.next<2>()).value;
        REQUIRE(relative(book.brdf(wi), reflection.ggx().brdf(wo, wi)) <= 1e-3);
    }
}

TEST_CASE("the textbook's rough glass is that of Lumis", "[textbook]") {
    const Vector wo = glm::normalize(Vector{1, 0.5f, 1});
    const glm::vec2 alpha{0.2f, 0.4f};
    const textbook::GgxDielectric<float> book{wo, alpha, 1.5f};
    const lumis::GgxDielectric<float> glass{wo, alpha, 1.5f};
    check_same(book, glass, {1e-4, 1e-2});  // 1 - F keeps few digits at grazing

    lumis::Uniforms uniforms{std::mt19937_64{5}};
    for (int i = 0; i < 10000; ++i) {
        const auto drawn = glass.sample(uniforms.next<3>());
        if (drawn.pdf > 0) REQUIRE(relative(book.bsdf(drawn.value), glass.bsdf(drawn.value)) <= 1e-3);
    }
}

TEST_CASE("the textbook's lights are those of Lumis", "[textbook]") {
    const Vector origin{0, 0, 0};
    const lumis::Triangle triangle{Vector{-1, -1, 2}, Vector{1, -1, 2}, Vector{0, 1, 3}};
    const lumis::Parallelogram rectangle{Vector{-1, -1, 2}, Vector{2, 0, 0}, Vector{0, 2, 1}};
    const lumis::Disk disk{Vector{1, 0, 2}, Vector{0, 0.6f, -0.8f}, 1.0f};
    const lumis::Sphere sphere{Vector{1, 0, 3}, 1.0f};
    check_same(textbook::TriangleByArea<float>{triangle, origin}, lumis::AreaLight{triangle, origin});
    check_same(textbook::ParallelogramByArea<float>{rectangle, origin}, lumis::AreaLight{rectangle, origin});
    check_same(textbook::DiskByArea<float>{disk, origin}, lumis::AreaLight{disk, origin});
    using lumis::BySolidAngle;
    check_same(textbook::SphereByCone<float>{sphere, origin},
               lumis::AreaLight<lumis::Sphere<float>, BySolidAngle>{sphere, origin});
    check_same(textbook::RectangleBySolidAngle<float>{rectangle, origin},
               lumis::AreaLight<lumis::Parallelogram<float>, BySolidAngle>{rectangle, origin});
    // The book's triangle cuts its area off at another vertex: other directions, one density.
    check_same(textbook::TriangleBySolidAngle<float>{triangle, origin},
               lumis::AreaLight<lumis::Triangle<float>, BySolidAngle>{triangle, origin}, {2.0, 1e-3});
}

// Two that are even over the same directions agree in all means.
TEST_CASE("the textbook's spherical triangle is even", "[textbook]") {
    const lumis::Triangle triangle{Vector{-1, -1, 2}, Vector{1, -1, 2}, Vector{0, 1, 3}};
    const textbook::TriangleBySolidAngle<float> book{triangle, Vector{}};
    const lumis::AreaLight<lumis::Triangle<float>, lumis::BySolidAngle> light{triangle, Vector{}};
    lumis::Uniforms uniforms{std::mt19937_64{5}};
    glm::dvec3 mean{}, square{};
    constexpr int draws = 100000;
    for (int i = 0; i < draws; ++i) {
        const auto u = uniforms.next<2>();
        const glm::dvec3 a = book.sample(u).value, b = light.sample(u).value;
        mean += (a - b) / double{draws}, square += (a * a - b * b) / double{draws};
    }
    CHECK(glm::length(mean) <= 0.005);  // each component spreads by 0.3
    CHECK(glm::length(square) <= 0.005);
}

// The book's density varies within a texel, as 1 / sin(theta) does: both agree as texels get small.
TEST_CASE("the textbook's environment map is that of Lumis", "[textbook]") {
    constexpr std::size_t width = 256, height = 128;
    std::vector<float> luminance(width * height);
    for (std::size_t i = 0; i < luminance.size(); ++i) luminance[i] = 1 + static_cast<float>(i * 7919 % 101) / 50;
    const textbook::EnvironmentMap<float> book{width, height, luminance};
    const lumis::EnvironmentMap map{width, height, luminance};
    lumis::Uniforms uniforms{std::mt19937_64{5}};
    int neighbour = 0;
    constexpr int draws = 20000;
    for (int i = 0; i < draws; ++i) {
        const auto drawn = book.sample(uniforms.next<2>());
        REQUIRE(drawn.pdf > 0);
        if (std::abs(drawn.value.y) > 0.95f) continue;
        // Samples rounded across a texel's edge meet another luminance.
        neighbour += !(relative(book.pdf(drawn.value), drawn.pdf) <= 1e-3) ||
                     !(relative(map.pdf(drawn.value), drawn.pdf) <= 0.05);
    }
    CHECK(neighbour <= draws / 100);
}

TEST_CASE("the textbook's alias table has the probabilities of Lumis' one", "[textbook]") {
    std::vector<float> weights(1000);
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = static_cast<float>(i % 10);
    const textbook::AliasTable<float> book{weights};
    const lumis::AliasTable table{weights};
    std::vector<double> frequency(weights.size());
    constexpr int draws = 1 << 20;
    for (int i = 0; i < draws; ++i) {
        const auto drawn = book.sample(glm::vec1{(static_cast<float>(i) + 0.5f) / draws});
        REQUIRE(drawn.pdf == book.pdf(drawn.value));
        frequency[drawn.value] += 1.0 / draws;
    }
    for (std::size_t i = 0; i < weights.size(); ++i) {
        REQUIRE(std::abs(double{book.pdf(i)} - double{table.pdf(i)}) <= 1e-6);
        REQUIRE(std::abs(frequency[i] - double{table.pdf(i)}) <= 1e-5);
    }
}

TEST_CASE("the textbook's weights are those of Lumis", "[textbook]") {
    for (const float own : {1e-3f, 0.5f, 2.0f, 1e4f}) {
        for (const float other : {0.0f, 1e-2f, 1.0f, 3e3f}) {
            CHECK(relative(textbook::PowerHeuristic{}(own, other),
                           lumis::mis_weight(lumis::PowerHeuristic{}, own, other)) <= 1e-6);
            CHECK(relative(textbook::BalanceHeuristic{}(own, other),
                           lumis::mis_weight(lumis::BalanceHeuristic{}, own, other)) <= 1e-6);
        }
    }
}
