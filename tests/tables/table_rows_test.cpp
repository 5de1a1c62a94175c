// Tables in rows, guided and alias: what is drawn, by every uniform there is, is what the counts say.
#include "catch.hpp"
#include "table_weights.hpp"
#include <lumis/tables/detail/alias_rows.hpp>
#include <lumis/tables/detail/guided_rows.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <tuple>
#include <type_traits>
#include <vector>

namespace {

using AllRows = std::tuple<lumis::detail::GuidedRows<float>, lumis::detail::GuidedRows<double>,
                           lumis::detail::AliasRows<float>, lumis::detail::AliasRows<double>>;

template <class Rows>
using Scalar = typename Rows::Scalar;

// Weights that make a search long: thousands of entries in one run of the guide, at either end and in the middle, among
// entries of weight 0; more entries than a guide of 16 bits can tell apart; and sizes that divide the counts unevenly.
std::vector<std::vector<double>> nasty_weights() {
    std::vector<std::vector<double>> result{std::vector<double>(5000, 1e-12), std::vector<double>(5000, 1e-12),
                                            std::vector<double>(5000, 1e-12), std::vector<double>(9001),
                                            std::vector<double>(100'003, 1.0)};
    result[0].front() = result[1].back() = result[2][2500] = 1;
    for (std::size_t i = 0; i < 9001; ++i) result[3][i] = i % 3 == 0 ? 0 : std::pow(10.0, -static_cast<double>(i % 17));
    for (std::size_t i = 40'000; i < 80'000; ++i) result[4][i] = i % 2 == 0 ? 0 : 1e-9;
    for (const auto& weights : weight_classes<double>()) result.push_back(weights);
    for (const std::size_t size : {2u, 3u, 31u, 64u, 65'536u, 65'537u})
        result.push_back(random_weights<double>(size, 6));
    return result;
}

template <class Rows>
Rows table_of(std::vector<double> weights) {
    Rows rows{weights.size(), 1};
    rows.deal(0, weights);
    return rows;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a table's counts are complete, whole, and none of weight 0", "[table_rows]", AllRows) {
    using T = Scalar<TestType>;
    for (const auto& weights : nasty_weights()) {
        const auto table = table_of<TestType>(weights);
        std::uint64_t total = 0;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            wrong += (table.counts(0, i) > 0) != (weights[i] > 0);
            total += table.counts(0, i);
        }
        INFO(weights.size() << " weights");
        CHECK(wrong == 0);
        CHECK(total == lumis::detail::total_counts<T>);
    }
}

TEMPLATE_LIST_TEST_CASE("corner and random uniforms draw what they should", "[table_rows]", AllRows) {
    using T = Scalar<TestType>;
    for (const auto& weights : nasty_weights()) {
        const auto table = table_of<TestType>(weights);
        std::size_t wrong = 0;
        const auto check = [&](T u) {
            const auto drawn = table.draw(0, u);
            wrong += !(drawn.index < weights.size() && weights[drawn.index] > 0 &&
                       drawn.counts == table.counts(0, drawn.index) && drawn.position > 0 && drawn.position <= 1);
        };
        for (const T u : {T(0), T(0.5), 1 - std::numeric_limits<T>::epsilon() / 2, T(1)}) check(u);
        std::mt19937_64 engine{1};
        for (int i = 0; i < 100'000; ++i) check(static_cast<T>(engine() >> 11) * static_cast<T>(0x1p-53));
        INFO(weights.size() << " weights");
        CHECK(wrong == 0);
    }
}

TEST_CASE("float: by all 2^24 uniforms the guide finds what a binary search finds", "[table_rows]") {
    for (const auto& weights : nasty_weights()) {
        const auto table = table_of<lumis::detail::GuidedRows<float>>(weights);
        std::vector<std::uint32_t> ends(weights.size());
        std::uint32_t end = 0;
        for (std::size_t i = 0; i < ends.size(); ++i) ends[i] = end += table.counts(0, i);
        std::size_t wrong = 0;
        for (std::uint32_t k = 0; k < 1u << 24; ++k) {
            const auto drawn = table.draw(0, static_cast<float>(k) * 0x1p-24f);
            // Neighbours draw the same until the entry's end: only then is the search worth its time.
            const bool inside = k < ends[drawn.index] && k >= ends[drawn.index] - drawn.counts;
            wrong += !inside || (k % 64 == 0 && drawn.index != static_cast<std::size_t>(
                                                                   std::ranges::upper_bound(ends, k) - ends.begin()));
        }
        INFO(weights.size() << " weights");
        CHECK(wrong == 0);
    }
}

TEST_CASE("float: by all 2^24 uniforms an alias row draws each entry as often as it has counts", "[table_rows]") {
    for (const auto& weights : nasty_weights()) {
        const auto table = table_of<lumis::detail::AliasRows<float>>(weights);
        std::vector<std::uint32_t> drawn(weights.size());
        std::vector<double> positions(weights.size());
        for (std::uint32_t k = 0; k < 1u << 24; ++k) {
            const auto entry = table.draw(0, static_cast<float>(k) * 0x1p-24f);
            ++drawn.at(entry.index);
            positions[entry.index] += double{entry.position};
        }
        std::size_t wrong = 0;
        double worst = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            wrong += drawn[i] != table.counts(0, i);
            // Positions are in the middle of equal parts of every run, so their mean is too.
            if (drawn[i] > 0) worst = std::fmax(worst, std::abs(positions[i] / drawn[i] - 0.5));
        }
        INFO(weights.size() << " weights");
        CHECK(wrong == 0);
        CHECK(worst <= 1e-5);
    }
}

// 2^53 uniforms are too many: runs are followed from end to end by bisection.
TEST_CASE("double: an alias row draws each entry as often as it has counts", "[table_rows]") {
    for (const auto& weights : nasty_weights()) {
        const std::uint64_t n = weights.size();
        if (n > 10'000) continue;
        const auto table = table_of<lumis::detail::AliasRows<double>>(weights);
        const auto at = [&](std::uint64_t count) { return table.draw(0, static_cast<double>(count) * 0x1p-31).index; };
        std::vector<std::uint64_t> drawn(n);
        for (std::uint64_t bin = 0; bin < n; ++bin) {
            const std::uint64_t begin = ((bin << 31) + n - 1) / n, end = (((bin + 1) << 31) + n - 1) / n;
            std::uint64_t low = begin, high = end;
            const std::size_t first = at(begin);
            while (low < high) {
                const std::uint64_t middle = (low + high) / 2;
                if (at(middle) == first) {
                    low = middle + 1;
                } else {
                    high = middle;
                }
            }
            drawn.at(first) += low - begin;
            if (low < end) drawn.at(at(end - 1)) += end - low;
        }
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < n; ++i) wrong += drawn[i] != table.counts(0, i);
        INFO(n << " weights");
        CHECK(wrong == 0);
    }
}

TEMPLATE_TEST_CASE("an entry and a position lead back to their uniform", "[table_rows]", float, double) {
    using T = TestType;
    const auto table = table_of<lumis::detail::GuidedRows<T>>({0, 2, 0, 0, 1, 1e-12, 5, 0});
    for (const double u : {0.0, 0.01, 0.2499, 0.3, 0.5, 0.77, 0.999999}) {
        const auto entry = table.draw(0, static_cast<T>(u));
        const double back = table.uniform_of(0, entry.index, entry.position);
        CHECK(std::abs(back - u) <= 4 * double{std::numeric_limits<T>::epsilon()});
    }
}

TEMPLATE_LIST_TEST_CASE("rows are tables of their own", "[table_rows]", AllRows) {
    using T = Scalar<TestType>;
    constexpr std::size_t size = 17, number = 5;
    TestType rows{size, number};
    for (std::size_t row = number; row-- > 0;) {
        auto weights = random_weights<double>(size, static_cast<double>(row));
        rows.deal(row, weights);
    }
    for (std::size_t row = 0; row < number; ++row) {
        const auto alone = table_of<TestType>(random_weights<double>(size, static_cast<double>(row)));
        for (std::size_t i = 0; i < size; ++i) CHECK(rows.counts(row, i) == alone.counts(0, i));
        for (int k = 0; k <= 1000; ++k) {
            const T u = static_cast<T>(k) / 1000;
            CHECK(rows.draw(row, u).index == alone.draw(0, u).index);
        }
    }
}
