// Discrete tables: in order of the uniforms, as often as the probabilities say; what is left of a uniform is a uniform.
#include "catch.hpp"
#include "copies.hpp"
#include "table_weights.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/laws.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace {

namespace laws = lumis::testing;

template <class T>
T uniform_of_count(std::uint64_t count) {
    return static_cast<T>(static_cast<double>(count) / double{lumis::detail::total_counts<T>});
}

}  // namespace

// Every index owns one run of uniforms, the end of which begins the next: between the two nothing else can be drawn, for
// indices rise with uniforms.
TEMPLATE_TEST_CASE("a discrete table draws an index by the uniforms between its cumulative probabilities",
                   "[discrete_table]", float, double) {
    using T = TestType;
    for (const auto& weights : weight_classes<T>()) {
        const lumis::DiscreteTable table{weights};
        const lumis::AliasTable alias{weights};
        REQUIRE(table.size() == weights.size());
        std::uint64_t before = 0;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            const auto counts = static_cast<std::uint64_t>(double{table.pdf(i)} * lumis::detail::total_counts<T>);
            wrong += (counts > 0) != (weights[i] > 0);
            wrong += table.pdf(i) != alias.pdf(i);
            if (counts == 0) continue;
            for (const auto count : {before, before + counts / 2, before + counts - 1}) {
                const auto drawn = table.sample(glm::vec<1, T>{uniform_of_count<T>(count)});
                wrong += drawn.value != i || drawn.pdf != table.pdf(i);
            }
            before += counts;
        }
        INFO(weights.size() << " weights");
        CHECK(wrong == 0);
        CHECK(before == lumis::detail::total_counts<T>);
        CHECK(table.pdf(weights.size()) == 0);
        CHECK(weights[table.sample(glm::vec<1, T>{T(1)}).value] > 0);
    }
}

TEMPLATE_TEST_CASE("a larger uniform never draws a smaller index, nor leaves a smaller rest of the same one",
                   "[discrete_table]", float, double) {
    using T = TestType;
    for (const auto& weights : weight_classes<T>()) {
        const lumis::DiscreteTable table{weights};
        auto before = table.sample_remapped(glm::vec<1, T>{T(0)});
        std::size_t wrong = 0;
        for (int k = 0; k <= 4099; ++k) {
            const T u = static_cast<T>(k) / 4099;
            const auto drawn = table.sample_remapped(glm::vec<1, T>{u});
            const auto alone = table.sample(glm::vec<1, T>{u});
            wrong += drawn.value != alone.value || drawn.pdf != alone.pdf;
            wrong += drawn.value < before.value || (drawn.value == before.value && drawn.rest < before.rest);
            wrong += !(drawn.rest > 0 && drawn.rest < 1);
            // Half of a lattice cell, and what rounding u itself takes.
            const double back = double{table.invert(drawn.value, drawn.rest).x};
            wrong += !(std::abs(back - double{u}) <= 2 * double{std::numeric_limits<T>::epsilon()});
            before = drawn;
        }
        INFO(weights.size() << " weights");
        CHECK(wrong == 0);
    }
}

// n strata of the uniforms give every index n p samples, one more or one less; and the rests of an index are as evenly spread.
TEST_CASE("strata of uniforms stay strata of indices and of rests", "[discrete_table]") {
    const std::vector<float> weights{3, 0, 1, 2.5f, 0.01f, 8};
    const lumis::DiscreteTable table{weights};
    constexpr int strata = 4096;
    std::vector<int> drawn(weights.size()), in_lower_half(weights.size());
    for (int i = 0; i < strata; ++i) {
        const auto sample = table.sample_remapped(glm::vec1{(static_cast<float>(i) + 0.37f) / strata});
        ++drawn.at(sample.value);
        in_lower_half.at(sample.value) += sample.rest < 0.5f;
    }
    for (std::size_t i = 0; i < weights.size(); ++i) {
        CHECK(std::abs(static_cast<float>(drawn[i]) - strata * table.pdf(i)) <= 1);
        CHECK(std::abs(2 * in_lower_half[i] - drawn[i]) <= 2);
    }
}

TEMPLATE_TEST_CASE("the laws over a discrete table", "[discrete_table]", float, double) {
    using T = TestType;
    const std::vector<T> weights{T(1), T(0), T(3), T(1e-5), T(0.5)};
    const lumis::DiscreteTable table{weights};
    const auto chart = laws::index_chart(weights.size());
    STATIC_REQUIRE(lumis::Strategy<lumis::DiscreteTable<T>>);
    STATIC_REQUIRE_FALSE(lumis::InvertibleStrategy<lumis::DiscreteTable<T>>);  // one index, many uniforms
    CHECK(laws::agreement(table));
    CHECK(laws::integrates(table, chart, {.probability = 1.0}));
    CHECK(laws::covers(
        table, [&](std::size_t i) { return weights[i] > 0; }, chart));
    CHECK(laws::chi_square(table, chart));
    CHECK(laws::stays_finite(table));
    CHECK(laws::draws_nothing(lumis::DiscreteTable{std::vector<T>(3)}));
}

TEST_CASE("weights that a discrete table refuses, and copies that its view draws from", "[discrete_table]") {
    CHECK_THROWS_AS(lumis::DiscreteTable{std::vector<float>{}}, std::invalid_argument);
    CHECK_THROWS_AS((lumis::DiscreteTable{std::vector<float>{1, -1}}), std::invalid_argument);
    std::optional<lumis::DiscreteTable<float>> table{std::vector<double>{1, 2, 5}};
    Copies copies;
    const auto view = table->view(copies);
    const auto expected = table->sample_remapped(glm::vec1{0.7f});
    table.reset();
    STATIC_REQUIRE(std::is_trivially_copyable_v<decltype(view)>);
    CHECK(view.sample_remapped(glm::vec1{0.7f}).value == expected.value);
    CHECK(view.sample_remapped(glm::vec1{0.7f}).rest == expected.rest);
    CHECK(view.invert(2, expected.rest).x == Approx(0.7f));
    CHECK(view.size() == 3);
}

TEST_CASE("a set of lights selected by a discrete table", "[light_set]") {
    using Light = lumis::AreaLight<lumis::Sphere<float>, lumis::BySolidAngle>;
    const std::vector<Light> lights{{{{-2, 1, 2}, 0.25f}, {0, 0, 0}}, {{{0, 1, 2}, 0.5f}, {0, 0, 0}}};
    const lumis::DiscreteTable table{std::vector<float>{1, 3}};
    const lumis::LightSet set{lights, table};
    const lumis::LightSet of_view{lights, table.view()};
    const lumis::LightSet alias{lights, lumis::AliasTable<float>{std::vector<float>{1, 3}}};
    CHECK(laws::agreement(set));
    for (const float u : {0.1f, 0.24f, 0.26f, 0.9f}) {
        CHECK(set.sample_one({u, 0.3f, 0.6f}).index == (u < 0.25f ? 0u : 1u));
        const auto sample = set.sample({u, 0.3f, 0.6f});
        CHECK(sample.pdf == alias.pdf(sample.value));
        CHECK(sample.pdf == of_view.pdf(sample.value));
    }
}
