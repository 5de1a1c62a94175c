// What the law of batches, which laws_test.cpp runs over every strategy, does not reach.
#include "catch.hpp"
#include <lumis/batch/batch.hpp>
#include <lumis/lumis.hpp>
#include <lumis/testing/batch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <type_traits>
#include <vector>

namespace {

namespace laws = lumis::testing;

// As a user writes one: for numbers alone.
template <std::floating_point T>
struct ForNumbers {
    using Scalar = T;
    using Point = lumis::Direction<T>;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;

    lumis::CosineHemisphere<T> inner{};

    [[nodiscard]] lumis::Sample<Point, T> sample(glm::vec<2, T> u) const noexcept { return inner.sample(u); }
    [[nodiscard]] T pdf(const Point& w) const noexcept { return inner.pdf(w); }
};

void check_law(const auto& strategy) {
    const auto law = laws::batch_agrees(strategy);
    INFO(law.message);
    CHECK(law.passed);
}

// Densities of all magnitudes, and those that are none.
template <class T>
std::vector<T> densities(std::size_t seed) {
    std::mt19937_64 engine{seed};
    std::uniform_real_distribution<double> decades{-30, 30};
    std::vector<T> result;
    for (int i = 0; i < 999; ++i) result.push_back(static_cast<T>(std::pow(10.0, decades(engine))));
    const T inf = std::numeric_limits<T>::infinity(), least = std::numeric_limits<T>::denorm_min();
    for (const T special : {T(0), T(1), inf, least, std::numeric_limits<T>::max()}) {
        for (std::size_t i = 0; i < 5; ++i) result.push_back(special);
    }
    std::shuffle(result.begin(), result.end(), engine);
    return result;
}

template <class T, class Heuristic>
void check_weights(const Heuristic& heuristic) {
    const std::array numbers{densities<T>(1), densities<T>(2), densities<T>(3)};
    const std::size_t count = numbers[0].size();
    std::vector<T> of_two(count), of_three(count);
    lumis::mis_weight_n(heuristic, numbers[0], numbers[1], std::span{of_two});
    const std::array<std::span<const T>, 3> all{numbers[0], numbers[1], numbers[2]};
    lumis::mis_weight_n(heuristic, 2, all, of_three);
    std::size_t wrong = 0;
    const auto same = [](T a, T b) { return std::abs(a - b) <= 4 * std::numeric_limits<T>::epsilon() * b; };
    for (std::size_t i = 0; i < count; ++i) {
        const T a = numbers[0][i], b = numbers[1][i], c = numbers[2][i];
        wrong += !same(of_two[i], lumis::mis_weight(heuristic, a, b));
        wrong += !same(of_three[i], lumis::mis_weight(heuristic, c, a, b));
    }
    CHECK(wrong == 0);
}

}  // namespace

TEMPLATE_TEST_CASE("a strategy for numbers alone is called for each", "[batch]", float, double) {
    check_law(ForNumbers<TestType>{});
}

TEMPLATE_TEST_CASE("delta strategies in a batch", "[batch]", float, double) {
    using T = TestType;
    using Vector = glm::vec<3, T>;
    const std::vector<T> u(11, T(0.5));
    std::vector<T> x(11), y(11), z(11), pdf(11), density(11, T(1));
    const auto check = [&](const auto& strategy, const Vector& w, T probability) {
        lumis::sample_n(strategy, {u, u}, {x, y, z, pdf});
        lumis::pdf_n(strategy, x, y, z, density);
        for (std::size_t i = 0; i < u.size(); ++i) {
            CHECK(Vector{x[i], y[i], z[i]} == w);
            CHECK(pdf[i] == probability);
            CHECK(density[i] == 0);
        }
    };
    check(lumis::PerfectReflection<T>{Vector{T(0.6), 0, T(0.8)}}, {T(-0.6), 0, T(0.8)}, T(1));
    check(lumis::PerfectReflection<T>{Vector{T(0.6), 0, T(-0.8)}}, Vector{T(0)}, T(0));
    check(lumis::PointLight<T>{Vector{0, 0, 2}, Vector{T(0)}}, {0, 0, 1}, T(1));
    check(lumis::DirectionalLight<T>{Vector{0, 1, 0}}, {0, 1, 0}, T(1));
}

TEMPLATE_TEST_CASE("a batch keeps the distance of a light", "[batch]", float, double) {
    using T = TestType;
    using Vector = glm::vec<3, T>;
    const lumis::Parallelogram<T> far{Vector{-1, -1, 3}, Vector{2, 0, 0}, Vector{0, 2, 0}};
    const lumis::Parallelogram<T> near{Vector{0, 0, 1}, Vector{1, 0, 0}, Vector{0, 1, 0}};
    const lumis::AreaLight light{far, Vector{T(0)}}, other{near, Vector{T(0)}};
    const std::vector<T> u{T(0.1), T(0.9), T(0.4), T(0.5), T(0.7), T(0.2), T(0.8), T(0.6), T(0.3), T(0.15), T(0.95)};
    const std::vector<T> v{u.rbegin(), u.rend()};
    const std::size_t count = u.size();
    std::vector<T> x(count), y(count), z(count), pdf(count), distance(count);
    const auto check = [&](const auto& strategy, const auto& columns) {
        lumis::sample_n(strategy, columns, lumis::LightSpans<T>{x, y, z, pdf, distance});
        for (std::size_t i = 0; i < count; ++i) {
            const Vector w{x[i], y[i], z[i]};
            CHECK(pdf[i] > 0);
            CHECK(std::abs(distance[i] / strategy.distance_along(w) - 1) <= 1e-5);
        }
    };
    check(light, lumis::UniformSpans<T>{u, v});
    check(light, std::array<std::span<const T>, 2>{u, v});
    // Those of a set and of a mixture are to the nearest light, whichever was drawn.
    const lumis::LightSet set{std::vector{light, other}, std::vector<T>{1, 1}};
    const std::vector<T> behind(count, T(0.25));
    check(set, std::array<std::span<const T>, 3>{v, u, v});
    check(set, std::array<std::span<const T>, 3>{behind, u, v});
    check(lumis::Mixture{lumis::choose(0.5, light), lumis::choose(0.5, other)},
          std::array<std::span<const T>, 3>{u, u, v});
    CHECK(std::min_element(distance.begin(), distance.end())[0] < 2);
    CHECK(std::max_element(distance.begin(), distance.end())[0] > 3);
}

TEMPLATE_TEST_CASE("indices and points of a table in a batch", "[batch]", float, double) {
    using T = TestType;
    const std::vector<T> u{T(0), T(0.1), T(0.3), T(0.5), T(0.7), T(0.9), T(0.99), T(0.25), T(0.75), T(0.6), T(0.4)};
    const std::size_t count = u.size();
    std::vector<T> pdf(count), again(count);
    const auto check = [&](const auto& table, const auto& columns, auto uniforms_of) {
        using Point = typename std::remove_cvref_t<decltype(table)>::Point;
        std::vector<Point> value(count);
        lumis::sample_n(table, columns, lumis::PointSpans<Point, T>{value, pdf});
        lumis::pdf_n(table, value, again);
        for (std::size_t i = 0; i < count; ++i) {
            const auto single = table.sample(uniforms_of(i));
            CHECK(value[i] == single.value);
            CHECK(pdf[i] == single.pdf);
            CHECK(again[i] == table.pdf(single.value));
        }
    };
    const std::vector<T> weights{1, 0, 2, 5};
    const std::array<std::span<const T>, 1> one{u};
    check(lumis::AliasTable{weights}, one, [&](std::size_t i) { return glm::vec<1, T>{u[i]}; });
    check(lumis::PiecewiseConstant1D{weights}, one, [&](std::size_t i) { return glm::vec<1, T>{u[i]}; });
    check(lumis::PiecewiseConstant2D{2, 2, weights}, lumis::UniformSpans<T>{u, u}, [&](std::size_t i) {
        return glm::vec<2, T>{u[i], u[i]};
    });
}

TEMPLATE_TEST_CASE("estimates in a batch", "[batch]", float, double) {
    using T = TestType;
    const auto cosine = lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, lumis::CosineHemisphere<T>{}));
    const auto one = lumis::one_sample(lumis::PowerHeuristic{}, lumis::choose(0.5, lumis::CosineHemisphere<T>{}),
                                       lumis::choose(0.5, lumis::UniformHemisphere<T>{}));
    CHECK(cosine.uniforms_per_estimate() == 2);
    CHECK(one.uniforms_per_estimate() == 3);
    const std::vector<T> u(13, T(0.3));
    std::vector<T> numbers(13);
    std::vector<glm::vec<3, T>> colours(13);
    const std::array<std::span<const T>, 3> columns{u, u, u};
    const std::span two{columns.data(), 2};
    // Estimates without variance: the integral of the cosine, and of a colour times it.
    lumis::estimate_n(
        cosine, [](const auto& w) { return w.z; }, two, numbers);
    for (const T estimate : numbers) CHECK(std::abs(estimate - std::numbers::pi_v<T>) <= T(1e-5));
    const glm::vec<3, T> colour(1, 2, 3);
    lumis::estimate_n(
        cosine, [&](const glm::vec<3, T>& w) { return colour * w.z; }, two, colours);
    for (const auto& estimate : colours) {
        CHECK(glm::length(estimate - colour * std::numbers::pi_v<T>) <= T(1e-5));
    }
    // No estimate, and a few.
    lumis::estimate_n(
        one, [](const auto& w) { return w.z; }, std::array<std::span<const T>, 3>{}, std::span{numbers}.first(0));
    const std::array few{std::span{u}.first(3), std::span{u}.first(3), std::span{u}.first(3)};
    std::vector<T> some(4, T(-1));
    lumis::estimate_n(
        one, [](const auto& w) { return w.z; }, few, std::span{some}.first(3));
    CHECK(some[0] > 0);
    CHECK(some[2] == some[0]);
    CHECK(some[3] == -1);
}

TEMPLATE_TEST_CASE("weights in a batch", "[batch]", float, double) {
    check_weights<TestType>(lumis::BalanceHeuristic{});
    check_weights<TestType>(lumis::PowerHeuristic{});
    check_weights<TestType>(lumis::PowerHeuristic{3});
    check_weights<TestType>(lumis::MaximumHeuristic{});
    check_weights<TestType>(lumis::CutoffHeuristic{});
    check_weights<TestType>(lumis::EqualWeights{});
}

TEMPLATE_TEST_CASE("a function of directions in a batch", "[batch]", float, double) {
    using T = TestType;
    std::vector<T> x(21), y(21), z(21), values(21);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<T>(i), y[i] = 2, z[i] = -static_cast<T>(i * i);
    lumis::evaluate_n<T>([](const auto& w) { return w.x + w.y * w.z; }, x, y, z, values);
    for (std::size_t i = 0; i < x.size(); ++i) CHECK(values[i] == x[i] + 2 * z[i]);
    lumis::evaluate_n<T>([](const glm::vec<3, T>& w) { return std::floor(w.x); }, x, y, z, values);
    for (std::size_t i = 0; i < x.size(); ++i) CHECK(values[i] == x[i]);
}
