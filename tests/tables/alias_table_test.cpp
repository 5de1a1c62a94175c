// Alias tables: each index is drawn exactly as often as its probability says, by every uniform that there is.
#include "catch.hpp"
#include "table_weights.hpp"
#include <lumis/tables/alias_table.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

template <class T>
std::string refusal(const std::vector<T>& weights) {
    try {
        const lumis::AliasTable table{weights};
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_CASE("float: an alias table draws as often as it says by all 2^24 uniforms", "[alias_table]") {
    for (const auto& weights : weight_classes<float>()) {
        const lumis::AliasTable table{weights};
        REQUIRE(table.size() == weights.size());
        std::vector<std::uint32_t> drawn(weights.size());
        bool same = true;
        for (std::uint32_t k = 0; k < 1u << 24; ++k) {
            const auto sample = table.sample(glm::vec<1, float>{static_cast<float>(k) * 0x1p-24f});
            ++drawn.at(sample.value);
            same = same && sample.pdf == table.pdf(sample.value);
        }
        CHECK(same);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            wrong += !(static_cast<double>(drawn[i]) * 0x1p-24 == double{table.pdf(i)});
            wrong += (drawn[i] > 0) != (weights[i] > 0);
        }
        INFO(weights.size() << " weights");
        CHECK(wrong == 0);
    }
}

TEMPLATE_TEST_CASE("the probabilities of an alias table sum to 1 and follow the weights", "[alias_table]", float,
                   double) {
    using T = TestType;
    for (const auto& weights : weight_classes<T>()) {
        const lumis::AliasTable table{weights};
        long double sum = 0, total = 0;
        for (const T weight : weights) total += weight;
        double worst = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            sum += table.pdf(i);
            const auto share = static_cast<double>(weights[i] / total);
            worst = std::fmax(worst, std::abs(double{table.pdf(i)} - share));
        }
        INFO(weights.size() << " weights");
        CHECK(sum == 1);  // whole counts, exactly
        // A count's rounding, and what dim ones take, which keep one count each.
        CHECK(worst <= static_cast<double>(2 + weights.size()) / double{lumis::detail::total_counts<T>});
        CHECK(table.pdf(weights.size()) == 0);
        CHECK(table.pdf(std::numeric_limits<std::size_t>::max()) == 0);
    }
}

// All of a bin's runs are met by a uniform of theirs: in double, by stepping through the counts of a small table.
TEST_CASE("double: an alias table draws as often as it says", "[alias_table]") {
    for (const auto& weights : weight_classes<double>()) {
        if (weights.size() > 10) continue;
        const lumis::AliasTable table{weights};
        const std::size_t n = weights.size();
        std::vector<std::uint64_t> drawn(n);
        const auto at = [&](std::uint64_t count) {
            return table.sample(glm::vec<1, double>{static_cast<double>(count) * 0x1p-31}).value;
        };
        // A bin holds two runs: the first count that draws something else is found by bisection.
        for (std::uint64_t bin = 0; bin < n; ++bin) {
            const std::uint64_t total = std::uint64_t{1} << 31;
            const std::uint64_t begin = (bin * total + n - 1) / n, end = ((bin + 1) * total + n - 1) / n;
            std::uint64_t low = begin, high = end;
            while (low < high) {
                const std::uint64_t middle = (low + high) / 2;
                (at(middle) == at(begin) ? low : high) = at(middle) == at(begin) ? middle + 1 : middle;
            }
            drawn.at(at(begin)) += low - begin;
            if (low < end) drawn.at(at(end - 1)) += end - low;
        }
        for (std::size_t i = 0; i < n; ++i) {
            CHECK(static_cast<double>(drawn[i]) * 0x1p-31 == table.pdf(i));
            CHECK((drawn[i] > 0) == (weights[i] > 0));
        }
    }
}

TEMPLATE_TEST_CASE("an alias table at the ends of the uniforms", "[alias_table]", float, double) {
    using T = TestType;
    for (const auto& weights : weight_classes<T>()) {
        const lumis::AliasTable table{weights};
        for (const T u : {T(0), 1 - std::numeric_limits<T>::epsilon() / 2, T(1)}) {
            const auto sample = table.sample(glm::vec<1, T>{u});
            REQUIRE(sample.value < weights.size());
            CHECK(weights[sample.value] > 0);
            CHECK(sample.pdf > 0);
        }
    }
}

TEMPLATE_TEST_CASE("an alias table without a positive weight draws nothing", "[alias_table]", float, double) {
    using T = TestType;
    for (const std::size_t size : {1u, 5u}) {
        const lumis::AliasTable table{std::vector<T>(size)};
        CHECK(table.empty());
        for (const T u : {T(0), T(0.5), T(1)}) CHECK(table.sample(glm::vec<1, T>{u}).pdf == 0);
        for (std::size_t i = 0; i < size; ++i) CHECK(table.pdf(i) == 0);
    }
}

TEMPLATE_TEST_CASE("weights that an alias table refuses", "[alias_table]", float, double) {
    using T = TestType;
    using Catch::Matchers::Contains;
    const T inf = std::numeric_limits<T>::infinity(), nan = std::numeric_limits<T>::quiet_NaN();
    CHECK_THAT(refusal<T>({}), Contains("0 weights"));
    CHECK_THAT(refusal<T>({T(1), T(2), T(-0.5)}), Contains("weight 2") && Contains("-0.5"));
    CHECK_THAT(refusal<T>({nan, T(2)}), Contains("weight 0") && Contains("nan"));
    CHECK_THAT(refusal<T>({T(1), inf, T(2)}), Contains("weight 1") && Contains("inf"));
    CHECK(refusal<T>({T(1), -T(0)}) == "accepted");
}

TEST_CASE("an alias table of more weights than there are counts is refused", "[alias_table]") {
    CHECK_THAT(refusal(std::vector<float>((1u << 24) + 1, 1.0f)), Catch::Matchers::Contains("16777217"));
    CHECK(refusal(std::vector<float>(1u << 24, 1.0f)) == "accepted");
}

// Each dim light keeps a probability of 2^-24, all of them 60 %: what is left draws the bright one too seldom.
TEST_CASE("more dim weights than a float table can tell apart are refused", "[alias_table]") {
    std::vector<float> weights(10'000'000, 1e-12f);
    weights.push_back(1);
    const auto message = refusal(weights);
    CAPTURE(message);
    CHECK_THAT(message, Catch::Matchers::Contains("10000000 weights are less than 1/16777216 of the sum"));
    CHECK_THAT(message, Catch::Matchers::Contains("would take 59.6") && Catch::Matchers::Contains("FineAliasTable"));

    // In double they are told apart.
    const lumis::AliasTable<double> table{std::vector<double>(weights.begin(), weights.end())};
    CHECK(table.pdf(weights.size() - 1) >= 0.995);
    CHECK(table.pdf(5) == 0x1p-31);

    // A quarter of the counts is never refused, and costs the bright one a quarter of its draws.
    weights.assign(1u << 22, 1e-12f);
    weights.back() = 1;
    const lumis::AliasTable most{weights};
    CHECK(std::abs(most.pdf(weights.size() - 1) - 0.75f) <= 1e-6f);
    CHECK(most.pdf(5) == 0x1p-24f);
}

TEST_CASE("a fine alias table tells in float what a table in double tells", "[alias_table]") {
    std::vector<float> weights(10'000'000, 1e-12f);
    weights[77] = 1;
    weights[78] = 0;
    const lumis::FineAliasTable fine{weights};
    const lumis::AliasTable<double> exact{std::vector<double>(weights.begin(), weights.end())};
    CHECK(fine.size() == weights.size());
    CHECK(fine.pdf(77) >= 0.995f);
    CHECK(fine.pdf(5) == 0x1p-31f);
    CHECK(fine.pdf(78) == 0);
    CHECK(fine.pdf(weights.size()) == 0);
    // The second uniform tells neighbours apart that the first does not: 128 counts to each of the first's points.
    std::set<std::size_t> drawn;
    const auto dark = static_cast<float>(0x1p-24 * 5);
    for (int i = 0; i < 128; ++i) {
        const float finer = static_cast<float>(i) / 128;
        const auto sample = fine.sample({dark, finer});
        const auto same = exact.sample(glm::dvec1{double{dark} + double{finer} * 0x1p-24});
        CHECK(sample.value == same.value);
        CHECK(sample.pdf == static_cast<float>(same.pdf));
        CHECK(sample.pdf == fine.pdf(sample.value));
        drawn.insert(sample.value);
    }
    CHECK(drawn.size() > 1);
    for (const glm::vec2 u : {glm::vec2{0, 0}, glm::vec2{1, 1}, glm::vec2{1 - 0x1p-24f, 1 - 0x1p-24f}}) {
        CHECK(fine.sample(u).pdf > 0);
        CHECK(fine.sample(u).value < weights.size());
    }
    const lumis::FineAliasTable none{std::vector<float>(3)};
    CHECK(none.empty());
    CHECK(none.sample({0.5f, 0.5f}).pdf == 0);
}

TEMPLATE_TEST_CASE("an alias table of 1e7 weights", "[alias_table]", float, double) {
    using T = TestType;
    constexpr std::size_t size = 10'000'000;
    auto weights = random_weights<T>(size, 3);
    for (std::size_t i = 0; i < size; i += 2) weights[i] = T(0);
    const lumis::AliasTable table{weights};  // a second or less; time that grew with the square would not end
    double sum = 0;
    std::size_t never = 0, wrongly = 0;
    for (std::size_t i = 0; i < size; ++i) {
        sum += double{table.pdf(i)};
        never += weights[i] > 0 && !(table.pdf(i) > 0);
        wrongly += !(weights[i] > 0) && table.pdf(i) > 0;
    }
    CHECK(sum == 1);
    CHECK(never == 0);
    CHECK(wrongly == 0);
    std::mt19937_64 engine{1};
    std::size_t dark = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        const T u = static_cast<T>(engine() >> 40) * T(0x1p-24);
        const auto sample = table.sample(glm::vec<1, T>{u});
        dark += !(sample.pdf > 0 && weights[sample.value] > 0);
    }
    CHECK(dark == 0);
}
