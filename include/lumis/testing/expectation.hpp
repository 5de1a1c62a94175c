// What samples are expected to do if they are distributed as a density says: how many fall into each cell of a chart.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/testing/cells.hpp"
#include "lumis/testing/charts.hpp"
#include "lumis/testing/quadrature.hpp"
#include "lumis/testing/result.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lumis::LUMIS_ISA::testing {

// The probability of every cell, and by how much the quadrature may be off in it. What is left to 1 is the probability of
// drawing nothing.
template <class Point>
struct Expectation {
    Cells<Point> cells;
    std::vector<Integral> masses;
};

namespace detail {

// The error that the probability of a cell may have. The squares of such errors add up to 1e-3 samples for each cell of the
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

// The pool of every cell: cells in which little is expected go together, the thinnest first, until at least `thinnest` is. A
// last one in which less is expected has the number `size`, and all pools before it are numbered from 0. What is pooled must
// not depend on what is observed, among equal expectations either: few with few and many with many would look like a deviation.
struct Pools {
    std::vector<std::size_t> of_cell;
    std::size_t size{};
};

[[nodiscard]] inline Pools pools(const std::vector<double>& expected, double thinnest) {
    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return expected[a] < expected[b]; });
    Pools result{std::vector<std::size_t>(expected.size()), 0};
    double sum = 0;
    for (const std::size_t cell : order) {
        result.of_cell[cell] = result.size;
        sum += expected[cell];
        if (sum < thinnest) continue;
        ++result.size;
        sum = 0;
    }
    return result;
}

[[nodiscard]] inline Integral total(const std::vector<Integral>& masses) {
    return std::accumulate(masses.begin(), masses.end(), Integral{});
}

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

// Why there is nothing to test: an expectation that is no probability fails, and one is undecided whose own errors would be
// seen, for then the chart does not resolve the density.
template <class Point>
[[nodiscard]] std::optional<LawResult> refused(const Expectation<Point>& expected, double samples, double thinnest) {
    const auto& [cells, masses] = expected;
    const Integral all = total(masses);
    if (!(all.value - all.error <= 1 + 1e-4)) {
        return LawResult{false, 0, text("the density integrates to ", all.value, " +- ", all.error)};
    }
    const auto [statistic, worst] = unresolved(masses, samples, thinnest);
    if (statistic <= 0.1 * std::sqrt(2.0 * static_cast<double>(cells.size()))) return {};
    return LawResult{false, 0,
                     text("the chart does not resolve the density: it integrates to ", all.value, " +- ", all.error,
                          " in all, worst in the cell about ", cells.centre(worst), ": ", masses[worst].value, " +- ",
                          masses[worst].error, "; a denser chart there, or fewer samples, would do"),
                     false};
}

// How many samples fell into each cell, and how many drew nothing.
template <class Point>
class Observed {
  public:
    explicit Observed(const Expectation<Point>& expected) : expected_{expected}, counts_(expected.cells.size()) {}

    // The cell of a sample, cells.size() if nothing was drawn. A sample that cannot be is none, and wrong() tells why.
    template <class Drawn, class U>
    [[nodiscard]] std::optional<std::size_t> add(const Drawn& sample, const U& u) {
        const auto& [cells, masses] = expected_;
        if (sample.pdf == 0) {
            ++nothing_;
            return cells.size();
        }
        const auto point = static_cast<Point>(sample.value);
        const std::size_t cell = cells.find(point);
        if (cell == cells.size() || !(sample.pdf > 0 && std::isfinite(sample.pdf))) {
            wrong_ = text("drew ", point, " with density ", sample.pdf, " at u = ", u);
            return {};
        }
        if (!(masses[cell].value > 0)) {
            wrong_ = text("drew ", point, " in a cell of probability ", masses[cell].value, " at u = ", u);
            return {};
        }
        ++counts_[cell];
        return cell;
    }

    [[nodiscard]] const std::string& wrong() const noexcept { return wrong_; }
    [[nodiscard]] double nothing() const noexcept { return nothing_; }
    [[nodiscard]] const std::vector<double>& counts() const noexcept { return counts_; }

    // The cell where most is wrong, in words.
    [[nodiscard]] std::string worst(double samples, double thinnest) const {
        const auto& [cells, masses] = expected_;
        std::size_t worst = 0;
        double most = 0;
        for (std::size_t cell = 0; cell < cells.size(); ++cell) {
            const double count = samples * masses[cell].value;
            const double excess = std::abs(counts_[cell] - count) / std::sqrt((std::max)(count, thinnest));
            if (excess > most) worst = cell;
            most = (std::max)(most, excess);
        }
        return text("worst cell about ", cells.centre(worst), ": drew ", counts_[worst], ", expected ",
                    samples * masses[worst].value, "; drew nothing ", nothing_, ", expected ",
                    samples * (1 - total(masses).value));
    }

  private:
    const Expectation<Point>& expected_;
    std::vector<double> counts_;
    double nothing_ = 0;
    std::string wrong_;
};

}  // namespace detail

}  // namespace lumis::LUMIS_ISA::testing
