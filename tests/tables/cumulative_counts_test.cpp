// Tables in fixed point: every entry with a weight is drawn, none without, and each as often as it says.
#include "catch.hpp"
#include <lumis/tables/detail/cumulative_counts.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

template <class T>
std::vector<std::uint32_t> deal(std::vector<double> weights) {
    std::vector<std::uint32_t> starts(weights.size());
    lumis::detail::deal_counts<T>(weights, [&](std::size_t i) -> std::uint32_t& { return starts[i]; });
    starts.push_back(lumis::detail::total_counts<T>);
    return starts;
}

}  // namespace

TEMPLATE_TEST_CASE("counts are whole, complete, and at least one for every weight", "[cumulative_counts]", float,
                   double) {
    using T = TestType;
    std::mt19937_64 engine{1};
    std::uniform_real_distribution<double> exponent{-300, 300};
    std::vector<double> wild(10'000);
    for (std::size_t i = 0; i < wild.size(); ++i) wild[i] = i % 3 == 0 ? 0 : std::pow(10, exponent(engine));
    const double largest = std::numeric_limits<double>::max(), smallest = std::numeric_limits<double>::denorm_min();
    for (const auto& weights :
         {std::vector<double>{1, 1e-8, 1}, std::vector<double>{0, 0, 3, 0}, std::vector<double>{7},
          std::vector<double>{largest, largest}, std::vector<double>{smallest, 0, smallest}, wild}) {
        const auto starts = deal<T>(weights);
        std::uint64_t total = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            const auto counts = starts[i + 1] - starts[i];
            REQUIRE((counts > 0) == (weights[i] > 0));
            total += counts;
        }
        CHECK(total == lumis::detail::total_counts<T>);
    }
}

TEMPLATE_TEST_CASE("shares follow the weights to one count", "[cumulative_counts]", float, double) {
    using T = TestType;
    std::vector<double> weights(1000);
    std::mt19937_64 engine{2};
    std::uniform_real_distribution<double> uniform{0.1, 1};
    double sum = 0;
    for (auto& weight : weights) sum += weight = uniform(engine);
    const auto starts = deal<T>(weights);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double exact = weights[i] / sum * lumis::detail::total_counts<T>;
        CHECK(std::abs(static_cast<double>(starts[i + 1] - starts[i]) - exact) <= 1 + 1e-6);
    }
}

// What is dim (less than one count's worth) gets one count each, and the others are scaled down alike: nothing else is moved.
TEMPLATE_TEST_CASE("only dim weights get more than their share", "[cumulative_counts]", float, double) {
    using T = TestType;
    const double all = lumis::detail::total_counts<T>;
    std::mt19937_64 engine{4};
    std::uniform_real_distribution<double> uniform{0.1, 1};
    for (const std::size_t number_dim : {0u, 1u, 1000u, 30'000u}) {
        std::vector<double> weights(number_dim + 1000, 1e-14);
        double bright = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            if (i % (weights.size() / 1000) == 0 && i / (weights.size() / 1000) < 1000) weights[i] = uniform(engine);
            if (weights[i] > 1e-3) bright += weights[i];
        }
        std::vector<std::uint32_t> starts(weights.size());
        std::vector<double> overwritten = weights;
        const auto dealt =
            lumis::detail::deal_counts<T>(overwritten, [&](std::size_t i) -> std::uint32_t& { return starts[i]; });
        starts.push_back(lumis::detail::total_counts<T>);
        CHECK(dealt.dim == number_dim);
        CHECK(std::abs(dealt.excess - static_cast<double>(number_dim) / all) <= 1e-6 * dealt.excess);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            const double counts = starts[i + 1] - starts[i];
            const double share = weights[i] / bright * (all - static_cast<double>(number_dim));
            wrong += weights[i] > 1e-3 ? !(std::abs(counts - share) <= 1.001) : counts != 1;
        }
        CHECK(wrong == 0);
    }
}

// Counts are max(1, c weight), rounded, for the c at which they sum up: found here by bisection. Half of the entries are dim.
TEST_CASE("counts beside many dim weights are in proportion to the weights", "[cumulative_counts]") {
    std::mt19937_64 engine{5};
    std::uniform_real_distribution<double> exponent{-3, 0};
    std::vector<double> weights(4'000'000);
    for (auto& weight : weights) weight = std::pow(10, exponent(engine));
    const auto counts_of = [](double c, double weight) { return std::max(1.0, c * weight); };
    double low = 0, high = 1e9;
    for (int halving = 0; halving < 60; ++halving) {
        const double c = (low + high) / 2;
        double sum = 0;
        for (const double weight : weights) sum += counts_of(c, weight);
        (sum < lumis::detail::total_counts<float> ? low : high) = c;
    }
    const auto starts = deal<float>(weights);
    double worst = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double counts = starts[i + 1] - starts[i];
        worst = std::max(worst, std::abs(counts - counts_of(low, weights[i])));
    }
    CHECK(worst <= 1.001);
}

TEST_CASE("as many weights as counts, whatever they are, get one each", "[cumulative_counts]") {
    std::vector<double> weights(1u << 24, 1.0);
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = static_cast<double>(1 + i % 1000);
    const auto number_wrong = [](const std::vector<double>& list) {
        const auto starts = deal<float>(list);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < list.size(); ++i) wrong += starts[i + 1] - starts[i] != 1;
        return wrong;
    };
    CHECK(number_wrong(weights) == 0);
    // Rounding decides whether equal ones are less than a count's worth: all of them, or none.
    for (const double weight : {0.1, 0.3, 0.7, 1e-300, 1e300}) {
        weights.assign(weights.size(), weight);
        CHECK(number_wrong(weights) == 0);
    }
}

// Weights of which a few become dim in every round, since dim ones before them keep a whole count.
TEST_CASE("counts are dealt in few rounds, and complete after any number of them", "[cumulative_counts]") {
    for (const double decay : {0.9, 0.99, 0.999, 0.9999, 0.99999, 0.999999}) {
        std::vector<double> weights{1};
        while (weights.size() < (1u << 23)) weights.push_back(std::max(weights.back() * decay, 1e-300));
        const auto starts = deal<float>(weights);
        std::size_t none = 0, risen = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            none += starts[i + 1] <= starts[i];
            // Decreasing weights have decreasing counts, up to rounding.
            risen += i > 0 && starts[i + 1] - starts[i] > starts[i] - starts[i - 1] + 1;
        }
        CHECK(none == 0);
        CHECK(risen == 0);
    }
}

TEMPLATE_TEST_CASE("points and the cells that hold them", "[cumulative_counts]", float, double) {
    using T = TestType;
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    CHECK(lumis::detail::index_of(T(0), 4) == 0);
    CHECK(lumis::detail::index_of(T(0.25), 4) == 1);
    CHECK(lumis::detail::index_of(T(0.999), 4) == 3);
    CHECK(lumis::detail::index_of(T(1), 4) == 3);
    for (const T x : {T(-1), nan, -inf}) CHECK(lumis::detail::index_of(x, 4) == 0);
    for (const T x : {T(2), T(1e30), inf}) CHECK(lumis::detail::index_of(x, 4) == 3);
    for (const std::size_t n : {1u, 3u, 1000u, 1u << 24}) {
        for (const T position : {T(0), T(0.5), T(1)}) {
            const T moved = lumis::detail::clear_of_edges(position, n);
            CHECK((moved > 0 && moved < 1));
        }
    }
}

TEST_CASE("of several bad weights the first is named, whatever row is looked at first", "[cumulative_counts]") {
    std::vector<float> weights(40, 1.0f);
    weights[13] = -3;
    weights[14] = weights[33] = -7;
    const auto backwards = [](std::size_t n, auto f) {
        while (n > 0) f(--n);
    };
    CHECK_THROWS_WITH(lumis::detail::require_weights(std::span<const float>{weights}, 8, backwards),
                      Catch::Matchers::Contains("weight 13 is -3"));
}

TEST_CASE("refused weights are named", "[cumulative_counts]") {
    const auto message = [](std::vector<float> weights) {
        try {
            lumis::detail::require_weights(std::span<const float>{weights});
        } catch (const std::invalid_argument& error) {
            return std::string{error.what()};
        }
        return std::string{};
    };
    CHECK(message({1, 0, 2}).empty());
    CHECK(message({1, -2, 2}).find("weight 1 is -2") != std::string::npos);
    CHECK(message({1, 0, std::numeric_limits<float>::infinity()}).find("weight 2 is inf") != std::string::npos);
    CHECK(message({std::numeric_limits<float>::quiet_NaN()}).find("weight 0 is") != std::string::npos);
}
