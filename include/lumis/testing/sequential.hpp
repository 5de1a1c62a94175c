// A law that looks after every few samples and stops as soon as a failure is beyond doubt. It still fails a correct strategy no
// more often than it says. A z-test or a chi-square test that is looked at while it runs does not keep its word: the more often
// one looks, the more often it fails. This is the law of a distribution; bounded.hpp has those of means.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/testing/charts.hpp"
#include "lumis/testing/evidence.hpp"
#include "lumis/testing/expectation.hpp"
#include "lumis/testing/points.hpp"
#include "lumis/testing/result.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace lumis::LUMIS_ISA::testing {

// A correct strategy takes `at_most` samples and fails with probability false_alarm at most, however many these are. A wrong one
// fails as soon as the evidence suffices.
struct Sequential {
    double false_alarm = 0.01;  // in a family of n tests: the family's, over n
    std::int64_t at_most = 1'000'000;
    std::uint64_t seed = 1;  // of the samples that the law draws itself
};

// number: a p-value that holds whenever one looks, the least of 1 / evidence.
struct SequentialResult : LawResult {
    std::int64_t samples{};  // those taken
};

namespace detail {

// Takes samples until the evidence is 1 / false_alarm. take(): takes one; false if no further one is to be taken.
template <class Take, class LogEvidence>
[[nodiscard]] SequentialResult watched(const Sequential& options, const Take& take, const LogEvidence& log_evidence) {
    constexpr std::int64_t between_looks = 16;
    const double enough = -std::log(options.false_alarm);
    double largest = 0;
    std::int64_t taken = 0;
    bool goes_on = true;
    while (goes_on && largest < enough && taken < options.at_most) {
        goes_on = take();
        ++taken;
        if (taken % between_looks == 0 || taken == options.at_most) largest = (std::max)(largest, log_evidence());
    }
    SequentialResult result;
    result.samples = taken;
    result.passed = goes_on && largest < enough && taken > 0;
    result.decided = taken > 0;
    result.number = std::exp(-largest);
    result.message = text("evidence ", std::exp(largest), " after ", static_cast<double>(taken), " samples, ",
                          result.passed ? "never " : "", "at least ", 1 / options.false_alarm,
                          ", which a correct strategy ever reaches with probability ", options.false_alarm, " at most");
    return result;
}

// Against the hypothesis that samples fall into cells as expected: into blocks of them, the single cells, and at all. An error
// that extends over the chart is seen in few large blocks long before it is in many small cells; three along each axis see a
// lopsided one wherever it leans.
template <class Point>
class DistributionEvidence {
  public:
    DistributionEvidence(const Expectation<Point>& expected, double at_most, double thinnest)
        : cells_{expected.cells.size()},
          drawn_{total(expected.masses)},
          nothing_{0, 1, (std::max)(1 - drawn_.value, 0.0), drawn_.error + 1 / at_most} {
        const auto& cells = expected.cells;
        for (const std::size_t parts : {std::size_t{3}, std::size_t{8}, cells.size()}) {
            if (drawn_.value > 0) add_resolution(expected, parts, thinnest / at_most);
        }
    }

    // The cell of a sample, the number of cells if nothing was drawn.
    void add(std::size_t cell) noexcept {
        nothing_.add(cell == cells_ ? 1 : 0);
        if (cell == cells_) return;
        for (auto& [pool_of_cell, evidence] : resolutions_) evidence.add(pool_of_cell[cell]);
    }

    [[nodiscard]] double log() {
        std::vector<double> logs{nothing_.log()};
        for (auto& resolution : resolutions_) logs.push_back(resolution.evidence.log());
        return log_mean(logs);
    }

  private:
    struct Resolution {
        std::vector<std::size_t> pool_of_cell;
        CellEvidence evidence;
    };

    // Cells or blocks in which less than the mass `thinnest` is expected are pooled: else what rounding moves over an edge
    // would be seen.
    void add_resolution(const Expectation<Point>& expected, std::size_t parts, double thinnest) {
        const auto& cells = expected.cells;
        const auto& masses = expected.masses;
        const auto block = [&](std::size_t cell) { return parts < cells.size() ? cells.block(cell, parts) : cell; };
        std::vector<double> of_block(parts < cells.size() ? parts * parts : cells.size());
        for (std::size_t cell = 0; cell < cells.size(); ++cell) of_block[block(cell)] += masses[cell].value;

        const auto [pool_of_block, complete] = pools(of_block, thinnest);
        const std::size_t last = complete > 0 ? complete - 1 : 0;
        std::vector<std::size_t> pool_of_cell;
        std::vector<double> probabilities(last + 1);
        for (std::size_t cell = 0; cell < cells.size(); ++cell) {
            pool_of_cell.push_back((std::min)(pool_of_block[block(cell)], last));
            probabilities[pool_of_cell[cell]] += masses[cell].value / drawn_.value;
        }
        resolutions_.push_back({std::move(pool_of_cell), CellEvidence{std::move(probabilities)}});
    }

    std::size_t cells_;
    Integral drawn_;
    MeanEvidence nothing_;
    std::vector<Resolution> resolutions_;
};

}  // namespace detail

// Options is deduced, though it can only be Sequential: numbers in braces, chi_square(s, chart, {1000, 1}), are thus the
// options of the law of a fixed number of samples.

// The law chi_square, looked at after every few samples: see there. Undecided if the errors of the expectation would be seen in
// as many samples as are taken at most.
template <Strategy S, class Point, std::same_as<Sequential> Options>
[[nodiscard]] SequentialResult chi_square(const S& strategy, const Expectation<Point>& expected,
                                          const Options& options) {
    constexpr double thinnest = 10;
    const auto at_most = static_cast<double>(options.at_most);
    if (const auto refused = detail::refused(expected, at_most, thinnest)) return {*refused, 0};

    Uniforms<std::mt19937_64, typename S::Scalar> uniforms{std::mt19937_64{options.seed}};
    detail::Observed<Point> observed{expected};
    detail::DistributionEvidence<Point> evidence{expected, at_most, thinnest};
    const auto take = [&] {
        const auto u = uniforms.template next<S::dimensions>();
        const auto cell = observed.add(strategy.sample(u), u);
        if (cell) evidence.add(*cell);
        return cell.has_value();
    };
    auto result = detail::watched(options, take, [&] { return evidence.log(); });
    if (observed.wrong().empty()) {
        result.message += "; " + observed.worst(static_cast<double>(result.samples), thinnest);
    } else {
        result.number = 0;
        result.message = observed.wrong();
    }
    return result;
}

template <Strategy S, std::same_as<Sequential> Options, class Point = InDouble<typename S::Point>>
[[nodiscard]] SequentialResult chi_square(const S& strategy, const Chart<Point>& chart, const Options& options) {
    return chi_square(strategy, expectation(density_of(strategy), chart), options);
}

}  // namespace lumis::LUMIS_ISA::testing
