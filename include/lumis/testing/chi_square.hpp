// The law that samples are distributed as the density says: Pearson's chi-square test over the cells of a chart.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/testing/cells.hpp"
#include "lumis/testing/charts.hpp"
#include "lumis/testing/quadrature.hpp"
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

namespace lumis::LUMIS_ISA::testing {

struct ChiSquareOptions {
    int samples = 100'000;
    std::uint64_t seed = 1;
    Significance significance{};
    double thinnest = 10;  // cells in which fewer samples are expected are pooled
};

// What a chi-square test expects: the probability of every cell, the rest being that of drawing nothing, and by how much
// the quadrature may be off in it.
template <class Point>
struct Expectation {
    Cells<Point> cells;
    std::vector<Integral> masses;
};

namespace detail {

// By how much the probability of a cell may be off. The squares of such errors add up to 1e-3 samples for each cell of the
// statistic, so that 1e5 samples, as many as usual, do not see them.
[[nodiscard]] inline double harmless_error(double mass) {
    return 1e-4 * std::sqrt(std::fmax(mass, 1e-4));
}

}  // namespace detail

// accuracy: of a cell's probability; its error should stay well below 1 / samples. A cell whose error would be seen is
// integrated again with more halvings, up to 24, as long as that helps.
template <class Point>
[[nodiscard]] Expectation<Point> expectation(const Density<Point>& density, const Chart<Point>& chart,
                                             std::size_t s_cells = 20, std::size_t t_cells = 20,
                                             Accuracy accuracy = {1e-6, 6}) {
    Cells<Point> cells{chart, s_cells, t_cells};
    auto masses = cells.masses(density, accuracy);
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        Accuracy finer{accuracy.absolute / 10, accuracy.depth, 2e5};
        bool improves = true;
        while (improves && masses[cell].error > detail::harmless_error(masses[cell].value) && finer.depth < 24) {
            finer.depth = (std::min)(finer.depth + 6, 24);
            const Integral mass = cells.mass(cell, density, finer);
            improves = mass.error < masses[cell].error / 2;
            masses[cell] = mass;
        }
    }
    return {std::move(cells), std::move(masses)};
}

namespace detail {

struct Pearson {
    double statistic{};
    int terms{};
};

// Pearson's statistic over (expected, observed); the thin ones are pooled, the thinnest first. What is pooled must not
// depend on what was observed, among equal expectations either: few with few and many with many would look like a deviation.
[[nodiscard]] inline Pearson pearson(std::vector<std::pair<double, double>> counts, double thinnest) {
    std::stable_sort(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
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

namespace detail {

// What the errors of an expectation may add to chi-square, and the cell that adds most.
struct Unresolved {
    double statistic{};
    std::size_t worst{};
};

[[nodiscard]] inline Unresolved unresolved(const std::vector<Integral>& masses, double samples, double thinnest) {
    Unresolved result;
    double most = 0;
    for (std::size_t cell = 0; cell < masses.size(); ++cell) {
        const double error = samples * masses[cell].error;
        const double added = error * error / std::fmax(samples * masses[cell].value, thinnest);
        result.statistic += added;
        if (added > most) {
            most = added;
            result.worst = cell;
        }
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
    const auto& [cells, masses] = expected;
    const double samples = options.samples;
    const Integral all = std::accumulate(masses.begin(), masses.end(), Integral{});
    const double drawn = all.value;
    if (!(drawn - all.error <= 1 + 1e-4)) {
        return {false, 0, detail::text("the density integrates to ", drawn, " +- ", all.error)};
    }
    const auto unresolved = detail::unresolved(masses, samples, options.thinnest);
    if (!(unresolved.statistic <= 0.1 * std::sqrt(2.0 * static_cast<double>(cells.size())))) {
        const auto& [value, error] = masses[unresolved.worst];
        return {false, 0,
                detail::text("the chart does not resolve the density: it integrates to ", drawn, " +- ", all.error,
                             " in all, worst in the cell about ", cells.centre(unresolved.worst), ": ", value, " +- ",
                             error, "; a denser chart there, or fewer samples, would do"),
                false};
    }

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
        if (!(masses[cell].value > 0)) {
            return {false, 0,
                    detail::text("drew ", point, " in a cell of probability ", masses[cell].value, " at u = ", u)};
        }
        ++observed[cell];
    }

    std::vector<std::pair<double, double>> counts{{samples * (std::max)(1 - drawn, 0.0), nothing}};
    std::size_t worst = 0;
    double worst_excess = 0;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        const double count = samples * masses[cell].value;
        counts.emplace_back(count, observed[cell]);
        const double excess = std::abs(observed[cell] - count) / std::sqrt((std::max)(count, options.thinnest));
        if (excess > worst_excess) {
            worst = cell;
            worst_excess = excess;
        }
    }
    const auto pearson = detail::pearson(std::move(counts), options.thinnest);

    // With a single cell there is nothing to compare; a statistic that is not finite fails.
    const double freedom = (std::max)(pearson.terms - 1, 1);
    const double p = std::isfinite(pearson.statistic)
                         ? cdf(complement(boost::math::chi_squared_distribution<double>{freedom}, pearson.statistic))
                         : 0.0;
    return {p >= options.significance.threshold(), p,
            detail::text("chi-square ", pearson.statistic, " with ", freedom, " degrees of freedom; ",
                         options.significance.meaning(p), "; worst cell about ", cells.centre(worst), ": drew ",
                         observed[worst], ", expected ", samples * masses[worst].value, "; drew nothing ", nothing,
                         ", expected ", samples * (1 - drawn))};
}

// The chart should be dense where the density is.
template <Strategy S, class Point = InDouble<typename S::Point>>
[[nodiscard]] LawResult chi_square(const S& strategy, const Chart<Point>& chart = sphere_chart(),
                                   const ChiSquareOptions& options = {}) {
    return chi_square(strategy, expectation(density_of(strategy), chart), options);
}

}  // namespace lumis::LUMIS_ISA::testing
