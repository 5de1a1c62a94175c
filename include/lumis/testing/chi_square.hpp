// The law that samples are distributed as the density says: Pearson's chi-square test over the cells of a chart.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/testing/charts.hpp"
#include "lumis/testing/expectation.hpp"
#include "lumis/testing/points.hpp"
#include "lumis/testing/result.hpp"

#include <boost/math/distributions/chi_squared.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace lumis::LUMIS_ISA::testing {

struct ChiSquareOptions {
    int samples = 100'000;
    std::uint64_t seed = 1;
    Significance significance{};
    double thinnest = 10;  // cells in which fewer samples are expected are pooled
};

namespace detail {

struct Pearson {
    double statistic{};
    int terms{};
};

// Pearson's statistic over (expected, observed), the thin ones pooled.
[[nodiscard]] inline Pearson pearson(const std::vector<std::pair<double, double>>& counts, double thinnest) {
    std::vector<double> expected;
    expected.reserve(counts.size());
    for (const auto& count : counts) expected.push_back(count.first);
    const auto [pool_of, size] = pools(expected, thinnest);
    std::vector<std::pair<double, double>> pooled(size + 1);
    for (std::size_t cell = 0; cell < counts.size(); ++cell) {
        pooled[pool_of[cell]].first += counts[cell].first;
        pooled[pool_of[cell]].second += counts[cell].second;
    }
    Pearson result{0, static_cast<int>(size)};
    for (std::size_t pool = 0; pool < size; ++pool) {
        const auto [mean, count] = pooled[pool];
        result.statistic += (count - mean) * (count - mean) / mean;
    }
    return result;
}

}  // namespace detail

// A sample in a cell whose probability is 0 fails at once, and so does a value or a density that is not finite, and an
// expectation whose probabilities are not, or sum to more than 1. Undecided if what the expectation's own errors may add to
// the statistic would be seen: then the chart does not resolve the density. The expectation may come from another strategy,
// such as the same one in double. number: the p-value.
template <Strategy S, class Point>
[[nodiscard]] LawResult chi_square(const S& strategy, const Expectation<Point>& expected,
                                   const ChiSquareOptions& options = {}) {
    const auto& masses = expected.masses;
    const double samples = options.samples;
    if (const auto refused = detail::refused(expected, samples, options.thinnest)) return *refused;

    Uniforms<std::mt19937_64, typename S::Scalar> uniforms{std::mt19937_64{options.seed}};
    detail::Observed<Point> observed{expected};
    for (int i = 0; i < options.samples; ++i) {
        const auto u = uniforms.template next<S::dimensions>();
        if (!observed.add(strategy.sample(u), u)) return {false, 0, observed.wrong()};
    }

    const double drawn = detail::total(masses).value;
    std::vector<std::pair<double, double>> counts{{samples * (std::max)(1 - drawn, 0.0), observed.nothing()}};
    for (std::size_t cell = 0; cell < masses.size(); ++cell) {
        counts.emplace_back(samples * masses[cell].value, observed.counts()[cell]);
    }
    const auto pearson = detail::pearson(counts, options.thinnest);

    // With a single cell there is nothing to compare; a statistic that is not finite fails.
    const double freedom = (std::max)(pearson.terms - 1, 1);
    const double p = std::isfinite(pearson.statistic)
                         ? cdf(complement(boost::math::chi_squared_distribution<double>{freedom}, pearson.statistic))
                         : 0.0;
    return {p >= options.significance.threshold(), p,
            detail::text("chi-square ", pearson.statistic, " with ", freedom, " degrees of freedom; ",
                         options.significance.meaning(p), "; ", observed.worst(samples, options.thinnest))};
}

// The chart should be dense where the density is.
template <Strategy S, class Point = InDouble<typename S::Point>>
[[nodiscard]] LawResult chi_square(const S& strategy, const Chart<Point>& chart = sphere_chart(),
                                   const ChiSquareOptions& options = {}) {
    return chi_square(strategy, expectation(density_of(strategy), chart), options);
}

}  // namespace lumis::LUMIS_ISA::testing
