// Adaptive quadrature over a rectangle, for densities that are smooth but for the edge of their support, where they may
// jump, and rise like an inverse square root. Gauss-Kronrod in both directions; the edge is found along s by bisection.
#pragma once

#include "lumis/core/platform.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace lumis::LUMIS_ISA::testing {

struct Accuracy {
    double absolute;           // halving a piece stops when its estimated error is below this
    int depth = 10;            // or after so many halvings: a density that is rough from rounding never gets there
    double evaluations = 1e8;  // or of the whole, after so many evaluations of the density
};

// An integral, and by how much it may be off: the sum of what Gauss and Kronrod differ by in each piece. A feature of the
// density that lies between all nodes is not in it.
struct Integral {
    double value{}, error{};

    Integral& operator+=(const Integral& other) noexcept {
        value += other.value;
        error += other.error;
        return *this;
    }
    friend Integral operator+(Integral a, const Integral& b) noexcept { return a += b; }
};

namespace detail {

using Gauss = boost::math::quadrature::gauss<double, 7>;
using Kronrod = boost::math::quadrature::gauss_kronrod<double, 15>;

inline constexpr std::size_t nodes = 15;

// Node i of [a, b], in increasing order.
[[nodiscard]] inline double node(double a, double b, std::size_t i) {
    const double centre = (a + b) / 2, half = (b - a) / 2;
    return i < 7 ? centre - half * Kronrod::abscissa()[7 - i] : centre + half * Kronrod::abscissa()[i - 7];
}

[[nodiscard]] inline Integral from_values(double a, double b, const std::array<double, nodes>& values) {
    double kronrod = 0, gauss = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
        const std::size_t from_centre = i < 7 ? 7 - i : i - 7;
        kronrod += Kronrod::weights()[from_centre] * values[i];
        if (from_centre % 2 == 0) gauss += Gauss::weights()[from_centre / 2] * values[i];
    }
    const double half = (b - a) / 2;
    return {half * kronrod, half * std::abs(kronrod - gauss)};
}

// is_good(error, level): whether a piece of that estimated error, that many halvings deep, is not halved again.
template <class F, class IsGood>
[[nodiscard]] Integral adaptive(const F& f, double a, double b, const IsGood& is_good, int level = 0) {
    std::array<double, nodes> values;
    for (std::size_t i = 0; i < nodes; ++i) values[i] = f(node(a, b, i));
    const auto estimate = from_values(a, b, values);
    if (is_good(estimate.error, level)) return estimate;
    return adaptive(f, a, (a + b) / 2, is_good, level + 1) + adaptive(f, (a + b) / 2, b, is_good, level + 1);
}

// With both ends slowed down, x = a + (b - a)(3 y^2 - 2 y^3), which takes an inverse square root there away.
template <class F, class IsGood>
[[nodiscard]] Integral adaptive_between_edges(const F& f, double a, double b, const IsGood& is_good) {
    const auto slowed = [&](double y) { return 6 * y * (1 - y) * (b - a) * f(a + (b - a) * y * y * (3 - 2 * y)); };
    return adaptive(slowed, 0, 1, is_good);
}

// Where f turns from positive to zero or back, between a and b of which it is one at each.
template <class F>
[[nodiscard]] double support_edge(const F& f, double a, double b) {
    const bool positive = f(a) > 0;
    for (double middle = (a + b) / 2; middle > a && middle < b; middle = (a + b) / 2) {
        ((f(middle) > 0) == positive ? a : b) = middle;
    }
    return (a + b) / 2;
}

template <class F, class IsGood>
[[nodiscard]] Integral integrate_line(const F& f, double a, double b, const IsGood& is_good) {
    std::array<double, nodes> values;
    std::vector<double> edges{a};
    double before = a, before_value = f(a);
    const double first = before_value, last = f(b);
    const auto look = [&](double x, double value) {
        if ((value > 0) != (before_value > 0)) edges.push_back(support_edge(f, before, x));
        before = x;
        before_value = value;
    };
    for (std::size_t i = 0; i < nodes; ++i) {
        const double x = node(a, b, i);
        values[i] = f(x);
        look(x, values[i]);
    }
    look(b, last);
    if (edges.size() == 1) {
        const auto estimate = from_values(a, b, values);
        if (is_good(estimate.error, 0)) return estimate;
        return adaptive(f, a, b, is_good);
    }
    edges.push_back(b);
    Integral sum;
    bool positive = first > 0;
    for (std::size_t i = 0; i + 1 < edges.size(); ++i, positive = !positive) {
        if (positive) sum += adaptive_between_edges(f, edges[i], edges[i + 1], is_good);
    }
    return sum;
}

}  // namespace detail

// The integral of f(s, t) over s from the first to the last of s_lines, across which f may jump, and t from t0 to t1. A
// value that is not finite makes it NaN.
[[nodiscard]] inline Integral integrate(const std::function<double(double, double)>& f, std::span<const double> s_lines,
                                        double t0, double t1, Accuracy accuracy) {
    bool poisoned = false, ragged = false;
    double line_errors = 0, lines = 0, evaluations = 0;
    const auto is_last = [&](int level) { return level == accuracy.depth || evaluations >= accuracy.evaluations; };
    const auto is_good_along = [&, allowed = accuracy.absolute / (t1 - t0) / 4](double error, int level) {
        return error <= allowed || is_last(level);
    };
    const auto across = [&](double t) {
        const auto line = [&](double s) {
            const double value = f(s, t);
            ++evaluations;
            poisoned = poisoned || !std::isfinite(value);
            ragged = ragged || !(value > 0);
            return std::isfinite(value) ? value : 0.0;
        };
        Integral sum;
        for (std::size_t i = 0; i + 1 < s_lines.size(); ++i) {
            sum += detail::integrate_line(line, s_lines[i], s_lines[i + 1], is_good_along);
        }
        line_errors += sum.error;
        ++lines;
        return sum.value;
    };
    const auto is_good_across = [&](double error, int level) {
        // A corner of the support may reach in between two of the lines: look closer before believing in nothing.
        const bool closer = std::exchange(ragged, false) && level < 2;
        return (error <= accuracy.absolute && !closer) || is_last(level);
    };
    Integral result = detail::adaptive(across, t0, t1, is_good_across);
    result.error += (t1 - t0) * line_errors / lines;
    if (poisoned) result.value = std::numeric_limits<double>::quiet_NaN();
    return result;
}

}  // namespace lumis::LUMIS_ISA::testing
