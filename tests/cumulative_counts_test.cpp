// Tables in fixed point: every entry with a weight is drawn, none without, and each as often as it says.
#include "catch.hpp"
#include <lumis/strategies/cumulative_counts.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace {

template <class T>
std::vector<std::uint32_t> deal(const std::vector<double>& weights) {
    std::vector<std::uint32_t> starts(weights.size());
    lumis::deal_counts<T>(weights, starts);
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
            const auto counts = lumis::counts_of<T>(starts, i);
            REQUIRE((counts > 0) == (weights[i] > 0));
            total += counts;
        }
        CHECK(total == lumis::total_counts<T>);
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
        const double exact = weights[i] / sum * lumis::total_counts<T>;
        // The count that each entry gets beforehand is taken from all.
        CHECK(std::abs(lumis::counts_of<T>(starts, i) - exact) <= 1 + 1 + 1000 * weights[i] / sum);
    }
}

TEMPLATE_TEST_CASE("what is drawn lies in its entry's run", "[cumulative_counts]", float, double) {
    using T = TestType;
    const auto starts = deal<T>({0, 2, 0, 0, 1, 1e-12, 5, 0});
    const std::span<const std::uint32_t> table{starts};
    const T corners[] = {T(0),     std::numeric_limits<T>::epsilon() / 2,     T(0.25),
                         T(0.375), 1 - std::numeric_limits<T>::epsilon() / 2, T(1)};
    for (const T u : corners) {
        const auto entry = lumis::draw_entry<T>(table, u);
        CHECK((entry.index == 1 || entry.index == 4 || entry.index == 5 || entry.index == 6));
        CHECK(entry.counts == lumis::counts_of<T>(table, entry.index));
        CHECK((entry.position > 0 && entry.position <= 1));
    }
    // The lightest entry owns a count or, by rounding, two; it is drawn by them.
    const T only = static_cast<T>(starts[5]) / static_cast<T>(lumis::total_counts<T>);
    CHECK(lumis::draw_entry<T>(table, only).index == 5);
    CHECK(lumis::counts_of<T>(table, 5) <= 2);
}

TEST_CASE("float: an entry owns as many of all 2^24 uniforms as it has counts", "[cumulative_counts]") {
    const std::vector<double> weights{0, 1, 1e-8, 0, 1, 3, 0.3, 0, 1e-3, 0};
    const auto starts = deal<float>(weights);
    std::vector<std::uint32_t> drawn(weights.size());
    float last = 0;
    std::size_t before = 0;
    bool ordered = true, within = true;
    for (std::uint32_t k = 0; k < 1u << 24; ++k) {
        const auto entry = lumis::draw_entry<float>(starts, static_cast<float>(k) * 0x1p-24f);
        ++drawn.at(entry.index);
        ordered = ordered && entry.index >= before && (entry.index > before || entry.position >= last);
        within = within && entry.position > 0 && entry.position <= 1;
        before = entry.index;
        last = entry.position;
    }
    CHECK(ordered);
    CHECK(within);
    for (std::size_t i = 0; i < weights.size(); ++i) CHECK(drawn[i] == lumis::counts_of<float>(starts, i));
}

TEMPLATE_TEST_CASE("an entry and a position lead back to their uniform", "[cumulative_counts]", float, double) {
    using T = TestType;
    const auto starts = deal<T>({0, 2, 0, 0, 1, 1e-12, 5, 0});
    for (const double u : {0.0, 0.01, 0.2499, 0.3, 0.5, 0.77, 0.999999}) {
        const auto entry = lumis::draw_entry<T>(starts, static_cast<T>(u));
        const double back = lumis::uniform_of<T>(starts, entry.index, entry.position);
        CHECK(std::abs(back - u) <= 4 * double{std::numeric_limits<T>::epsilon()});
    }
}

TEMPLATE_TEST_CASE("points and the cells that hold them", "[cumulative_counts]", float, double) {
    using T = TestType;
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    CHECK(lumis::index_of(T(0), 4) == 0);
    CHECK(lumis::index_of(T(0.25), 4) == 1);
    CHECK(lumis::index_of(T(0.999), 4) == 3);
    CHECK(lumis::index_of(T(1), 4) == 3);
    for (const T x : {T(-1), nan, -inf}) CHECK(lumis::index_of(x, 4) == 0);
    for (const T x : {T(2), T(1e30), inf}) CHECK(lumis::index_of(x, 4) == 3);
    for (const std::size_t n : {1u, 3u, 1000u, 1u << 24}) {
        for (const T position : {T(0), T(0.5), T(1)}) {
            const T moved = lumis::clear_of_edges(position, n);
            CHECK((moved > 0 && moved < 1));
        }
    }
}

TEST_CASE("refused weights are named", "[cumulative_counts]") {
    const auto message = [](std::vector<float> weights) {
        try {
            lumis::require_weights(std::span<const float>{weights});
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
