// The law that a strategy can draw whatever its integrand is made of: its density is positive wherever the integrand is
// not 0. An estimate that uses it alone is biased otherwise, and no other law sees that: samples and density agree on
// leaving a part out.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/testing/agreement.hpp"
#include "lumis/testing/charts.hpp"
#include "lumis/testing/points.hpp"
#include "lumis/testing/result.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>

namespace lumis::LUMIS_ISA::testing {

struct CoverageOptions {
    int points = 4096;  // over the whole chart, and 16 in each panel between its edges; one for an index
    // In units in the last place: how far a point that is not covered may lie from one that is. At the edge of the support
    // rounding decides.
    double rounding = 16;
};

// The integrand that is not 0 anywhere.
inline constexpr auto everywhere = [](const auto&) { return true; };

namespace detail {

template <class Value>
[[nodiscard]] double magnitude_of(const Value& value) {
    if constexpr (std::is_arithmetic_v<Value>) {
        return std::abs(static_cast<double>(value));
    } else {
        double sum = 0;
        for (int i = 0; i < value.length(); ++i) sum += std::abs(static_cast<double>(value[i]));
        return sum;
    }
}

// Calls visit(s, t) for `number` points of the panel, evenly spread: the additive recurrence by the plastic number (Roberts
// 2018, "The Unreasonable Effectiveness of Quasirandom Sequences").
template <class Visit>
void for_each_spread_point(double s0, double s1, double t0, double t1, int number, Visit visit) {
    constexpr double plastic = 1.32471795724474602596;
    for (int n = 0; n < number; ++n) {
        const double x = 0.5 + (n + 1) / plastic, y = 0.5 + (n + 1) / (plastic * plastic);
        visit(std::lerp(s0, s1, x - std::floor(x)), std::lerp(t0, t1, y - std::floor(y)));
    }
}

}  // namespace detail

// f(point), the integrand or just where it is not 0: a bool, number or colour, for points in double. It is asked at points
// spread evenly over the chart, which should hold all of f and be dense where f is large; a part of f much smaller than
// 1 / options.points of the chart may be missed. number: the share of |f| that is not covered, by the chart's measure.
template <Strategy S, class F, class Point = InDouble<typename S::Point>>
[[nodiscard]] LawResult covers(const S& strategy, const F& f, const Chart<Point>& chart = sphere_chart(),
                               const CoverageOptions& options = {}) {
    using Scalar = typename S::Scalar;
    constexpr double ulp = std::numeric_limits<Scalar>::epsilon();
    const auto step = static_cast<Scalar>(options.rounding * ulp);
    const std::span<const double> s{chart.s_edges}, t{chart.t_edges};
    const double panels = static_cast<double>(s.size() - 1) * static_cast<double>(t.size() - 1);

    LawResult result{true, 0, {}};
    double whole = 0, missed = 0;
    std::size_t asked = 0, bare = 0;
    const auto ask = [&](double at_s, double at_t, double area) {
        const auto [point, measure] = chart.at(at_s, at_t);
        if (!(measure > 0)) return;
        const double value = detail::magnitude_of(f(point)) * measure * area;
        if (value == 0) return;
        ++asked;
        whole += value;
        const auto own = static_cast<typename S::Point>(point);
        if (detail::density_range(strategy, own, step).second > 0) return;
        ++bare;
        missed += value;
        if (result.passed) {
            result.message = detail::text("density ", double{strategy.pdf(own)}, " at ", own,
                                          ", where the integrand is ", detail::magnitude_of(f(point)));
        }
        result.passed = false;
    };
    const double shared = static_cast<double>(options.points) / panels;
    const int number = chart.dimensions == 0 ? 1 : static_cast<int>(std::ceil(std::fmax(shared, 16)));
    for (std::size_t i = 0; i + 1 < s.size(); ++i) {
        for (std::size_t j = 0; j + 1 < t.size(); ++j) {
            const double area = (s[i + 1] - s[i]) * (t[j + 1] - t[j]) / number;
            detail::for_each_spread_point(s[i], s[i + 1], t[j], t[j + 1], number,
                                          [&](double at_s, double at_t) { ask(at_s, at_t, area); });
        }
    }

    if (asked == 0) return {false, 0, "the integrand is 0 all over the chart", false};
    result.number = missed / whole;
    if (result.passed) {
        result.message = detail::text("density positive at all ", asked, " points where the integrand is not 0");
    } else {
        result.message += detail::text("; at ", bare, " of ", asked, " such points, which hold ", 100 * result.number,
                                       " % of the integrand");
    }
    return result;
}

}  // namespace lumis::LUMIS_ISA::testing
