// The law that samples are distributed as the density says: Pearson's chi-square test over the cells of a chart.
#pragma once

#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/testing/cells.hpp"
#include "lumis/testing/charts.hpp"
#include "lumis/testing/result.hpp"

#include <boost/math/distributions/chi_squared.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace lumis::testing {

struct ChiSquareOptions {
    int samples = 100'000;
    std::uint64_t seed = 1;
    Significance significance{};
    double thinnest = 10;  // cells in which fewer samples are expected are pooled
};

// What a chi-square test expects: the probability of every cell, and of drawing nothing.
template <class Point>
struct Expectation {
    Cells<Point> cells;
    std::vector<double> masses;
};

// accuracy: of a cell's probability; its error should stay well below 1 / samples.
template <class Point>
[[nodiscard]] Expectation<Point> expectation(const Density<Point>& density, const Chart<Point>& chart,
                                             std::size_t s_cells = 20, std::size_t t_cells = 20,
                                             Accuracy accuracy = {1e-6, 6}) {
    Cells<Point> cells{chart, s_cells, t_cells};
    auto masses = cells.masses(density, accuracy);
    return {std::move(cells), std::move(masses)};
}

namespace detail {

struct Pearson {
    double statistic{};
    int terms{};
};

// Pearson's statistic over (expected, observed); the thin ones are pooled, the thinnest first.
[[nodiscard]] inline Pearson pearson(std::vector<std::pair<double, double>> counts, double thinnest) {
    std::sort(counts.begin(), counts.end());
    Pearson result;
    double expected = 0, observed = 0;
    for (const auto& count : counts) {
        expected += count.first;
        observed += count.second;
        if (expected < thinnest) continue;
        result.statistic += (observed - expected) * (observed - expected) / expected;
        ++result.terms;
        expected = observed = 0;
    }
    return result;
}

}  // namespace detail

// A sample in a cell whose probability is 0 fails at once, and so does a value or a density that is not finite, and an
// expectation whose probabilities are not, or sum to more than 1. The expectation may come from another strategy, such
// as the same one in double. number: the p-value.
template <Strategy S, class Point>
[[nodiscard]] LawResult chi_square(const S& strategy, const Expectation<Point>& expected,
                                   const ChiSquareOptions& options = {}) {
    const auto& [cells, masses] = expected;
    const double drawn = std::accumulate(masses.begin(), masses.end(), 0.0);
    if (!(drawn <= 1 + 1e-4)) return {false, 0, detail::text("the density integrates to ", drawn)};

    Uniforms<std::mt19937_64, typename S::Scalar> uniforms{std::mt19937_64{options.seed}};
    std::vector<double> observed(cells.size());
    double nothing = 0;
    for (int i = 0; i < options.samples; ++i) {
        const auto u = uniforms.template next<S::dimensions>();
        const auto sample = strategy.sample(u);
        if (sample.pdf == 0) {
            ++nothing;
            continue;
        }
        const auto point = static_cast<Point>(sample.value);
        const std::size_t cell = cells.find(point);
        if (cell == cells.size() || !(sample.pdf > 0 && std::isfinite(sample.pdf))) {
            return {false, 0, detail::text("drew ", point, " with density ", sample.pdf, " at u = ", u)};
        }
        if (!(masses[cell] > 0)) {
            return {false, 0, detail::text("drew ", point, " in a cell of probability ", masses[cell], " at u = ", u)};
        }
        ++observed[cell];
    }

    const double samples = options.samples;
    std::vector<std::pair<double, double>> counts{{samples * std::max(1 - drawn, 0.0), nothing}};
    std::size_t worst = 0;
    double worst_excess = 0;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        const double count = samples * masses[cell];
        counts.emplace_back(count, observed[cell]);
        const double excess = std::abs(observed[cell] - count) / std::sqrt(std::max(count, options.thinnest));
        if (excess > worst_excess) {
            worst = cell;
            worst_excess = excess;
        }
    }
    const auto pearson = detail::pearson(std::move(counts), options.thinnest);

    // With a single cell there is nothing to compare; a statistic that is not finite fails.
    const double freedom = std::max(pearson.terms - 1, 1);
    const double p = std::isfinite(pearson.statistic)
                         ? cdf(complement(boost::math::chi_squared_distribution<double>{freedom}, pearson.statistic))
                         : 0.0;
    return {p >= options.significance.threshold(), p,
            detail::text("chi-square ", pearson.statistic, " with ", freedom, " degrees of freedom, p = ", p,
                         "; worst cell about ", cells.centre(worst), ": drew ", observed[worst], ", expected ",
                         samples * masses[worst], "; drew nothing ", nothing, ", expected ", samples * (1 - drawn))};
}

// The chart should be dense where the density is.
template <Strategy S, class Point = InDouble<typename S::Point>>
[[nodiscard]] LawResult chi_square(const S& strategy, const Chart<Point>& chart = sphere_chart(),
                                   const ChiSquareOptions& options = {}) {
    return chi_square(strategy, expectation(density_of(strategy), chart), options);
}

}  // namespace lumis::testing
