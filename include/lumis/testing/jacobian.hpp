// The law that the density is the reciprocal of how much sample stretches the uniforms, 1 / |det d(point)/d(u)|: by
// finite differences on a grid. Nothing is drawn at random and nothing is integrated, so it is cheap, and it tells
// where a Jacobian is wrong.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/testing/points.hpp"
#include "lumis/testing/result.hpp"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>

namespace lumis::LUMIS_ISA::testing {

namespace detail {

// The length, area or volume that vectors span.
[[nodiscard]] inline double extent(const std::array<double, 1>& d) {
    return std::abs(d[0]);
}
[[nodiscard]] inline double extent(const std::array<glm::dvec2, 2>& d) {
    return std::abs(d[0].x * d[1].y - d[0].y * d[1].x);
}
[[nodiscard]] inline double extent(const std::array<glm::dvec3, 2>& d) {
    return glm::length(glm::cross(d[0], d[1]));
}
[[nodiscard]] inline double extent(const std::array<glm::dvec3, 3>& d) {
    return std::abs(glm::dot(d[0], glm::cross(d[1], d[2])));
}

template <class S>
using Differences = std::array<InDouble<typename S::Point>, static_cast<std::size_t>(S::dimensions)>;

// A direction takes two numbers, though it has three components.
template <class S>
inline constexpr bool too_many_uniforms = std::same_as<typename S::Measure, measure::SolidAngle>&& S::dimensions != 2;

}  // namespace detail

// As many uniforms as its points have dimensions. Whether each point is drawn by one u only, no concept can tell: a
// mixture of two strategies over lines has its points more than once, and not this law.
template <class S>
concept MapsUniforms = Strategy<S> && !detail::too_many_uniforms<S> && requires(detail::Differences<S> d) {
    detail::extent(d);
};

template <std::floating_point T>
inline constexpr double jacobian_tolerance = std::same_as<T, float> ? 1e-2 : 1e-4;

struct JacobianOptions {
    int grid = 16;           // points along each uniform
    double step = 1.0 / 64;  // the widest; each of the halvings is tried as well
    int halvings = 12;
    std::optional<double> tolerance{};  // of density times stretch, which is 1; the scalar's jacobian_tolerance
    // Where no step is known to be off by less than half of the tolerance, the point is passed over: there is a kink, such
    // as the edge of a table's cell, or rounding leaves no digits. So many of the points at which something is drawn
    // must remain.
    double least_share = 0.8;
};

namespace detail {

// An extent of central differences, what rounding may add to it, and whether both sides agree on it.
struct Stretch {
    double value{}, rounding{};
    bool valid{}, smooth{};
};

// Differences of sample about one point of the uniforms.
template <MapsUniforms S>
class LocalMap {
  public:
    LocalMap(const S& strategy, const UniformsOf<S>& u)
        : strategy_{strategy}, u_{u}, centre_{strategy.sample(u).value} {
        for (std::size_t axis = 0; axis < dimensions; ++axis) noise_[axis] = noise(axis);
    }

    // Central differences over [u - h, u + h] along every axis; not valid if nothing is drawn within it. smooth: the
    // slopes to both sides approach each other as h shrinks from its double, as they do not beside a kink.
    [[nodiscard]] Stretch over(double h, double tolerance) {
        Differences<S> slopes;
        std::array<double, dimensions> lengths, roundings, kinks;
        bool smooth = true;
        for (std::size_t axis = 0; axis < dimensions; ++axis) {
            const auto before = drawn(axis, -h), after = drawn(axis, h);
            if (!before || !after) return {};
            const double left = u_[int_of(axis)] - before->u, right = after->u - u_[int_of(axis)];
            slopes[axis] = (after->point - before->point) / (left + right);
            lengths[axis] = length(slopes[axis]);
            roundings[axis] = 3 * noise_[axis] / h;  // three standard deviations
            kinks[axis] = length((after->point - centre_) / right - (centre_ - before->point) / left);
            const double negligible = tolerance / 4 * lengths[axis] + 2 * roundings[axis];
            if (kinks[axis] > 0.75 * kinks_[axis] && kinks[axis] > negligible) smooth = false;
        }
        kinks_ = kinks;
        double box = 1, rounded_box = 1;  // spanned by slopes at right angles, and by those a little longer
        for (std::size_t axis = 0; axis < dimensions; ++axis) {
            box *= lengths[axis];
            rounded_box *= lengths[axis] + roundings[axis];
        }
        return {extent(slopes), rounded_box - box, true, smooth};
    }

  private:
    using Scalar = typename S::Scalar;
    using Point = InDouble<typename S::Point>;
    static constexpr auto dimensions = static_cast<std::size_t>(S::dimensions);

    struct Drawn {
        double u;
        Point point;
    };

    static constexpr int int_of(std::size_t axis) noexcept { return static_cast<int>(axis); }

    [[nodiscard]] static double length(const Point& d) { return detail::distance(d, Point(0)); }

    // What is drawn a step away along an axis, if anything is.
    [[nodiscard]] std::optional<Drawn> drawn(std::size_t axis, double step) const {
        UniformsOf<S> u = u_;
        u[int_of(axis)] += static_cast<Scalar>(step);
        if (!(u[int_of(axis)] >= 0 && u[int_of(axis)] < 1)) return {};
        const auto sample = strategy_.sample(u);
        if (!(sample.pdf > 0)) return {};
        return Drawn{double{u[int_of(axis)]}, Point(sample.value)};
    }

    // The standard deviation of the rounding of sample, along one axis: fourth differences over steps so small that
    // nothing else is left in them (More and Wild 2011, "Estimating Computational Noise"). Not less than that of the
    // point's own representation.
    [[nodiscard]] double noise(std::size_t axis) const {
        constexpr double epsilon = std::numeric_limits<Scalar>::epsilon();
        const double represented = epsilon * length(centre_) / std::sqrt(12.0);
        std::array<Point, 9> points;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto sample = drawn(axis, (static_cast<double>(i) - 4) * 16 * epsilon);
            if (!sample) return represented;
            points[i] = sample->point;
        }
        constexpr std::size_t order = 4;
        constexpr double variance = 70;  // of a fourth difference of numbers of variance 1: binomial(8, 4)
        for (std::size_t n = 0; n < order; ++n) {
            for (std::size_t i = 0; i + 1 < points.size() - n; ++i) points[i] = points[i + 1] - points[i];
        }
        double squares = 0;
        for (std::size_t i = 0; i < points.size() - order; ++i) squares += length(points[i]) * length(points[i]);
        return std::hypot(represented, std::sqrt(squares / variance / static_cast<double>(points.size() - order)));
    }

    const S& strategy_;
    UniformsOf<S> u_;
    Point centre_;
    std::array<double, dimensions> noise_{};
    std::array<double, dimensions> kinks_ = [] {
        std::array<double, dimensions> unknown;
        unknown.fill(std::numeric_limits<double>::infinity());
        return unknown;
    }();
};

// |det d(point)/d(u)|, and by how much that may be off.
struct Estimated {
    double value{}, error = std::numeric_limits<double>::infinity();
};

// Richardson's extrapolation of steps h and h / 2, for the h of least estimated error: what the extrapolation changes from
// the step before, which overstates the truncation, and what rounding adds, which grows as the step shrinks. Where
// two extrapolations agree by chance, the rounding still tells.
template <MapsUniforms S>
[[nodiscard]] Estimated stretch_at(const S& strategy, const UniformsOf<S>& u, const JacobianOptions& options,
                                   double tolerance) {
    LocalMap<S> map{strategy, u};
    Estimated best;
    Stretch wide{};
    std::optional<double> before;
    for (int halving = 0; halving <= options.halvings; ++halving) {
        const Stretch fine = map.over(std::ldexp(options.step, -halving), tolerance);
        const bool usable = wide.valid && fine.valid;
        if (usable) {
            const double extrapolated = (4 * fine.value - wide.value) / 3;
            const double rounding = (4 * fine.rounding + wide.rounding) / 3;
            if (before && fine.smooth) {
                const double error = std::abs(extrapolated - *before) + rounding;
                if (error < best.error) best = {extrapolated, error};
            }
            before = extrapolated;
        }
        wide = fine;
    }
    return best;
}

}  // namespace detail

// Central differences about every point of a grid, extrapolated, over the step whose error is estimated least. number: the
// worst |density x stretch - 1|.
template <MapsUniforms S>
[[nodiscard]] LawResult jacobian(const S& strategy, const JacobianOptions& options = {}) {
    using Scalar = typename S::Scalar;
    constexpr auto dimensions = static_cast<std::size_t>(S::dimensions);
    const double tolerance = options.tolerance.value_or(jacobian_tolerance<Scalar>);
    const auto grid = static_cast<std::size_t>(options.grid);

    LawResult result{true, 0, {}};
    detail::Ratios ratios;
    int drawn = 0, compared = 0, wrong = 0;
    std::size_t points = 1;
    for (std::size_t i = 0; i < dimensions; ++i) points *= grid;
    for (std::size_t n = 0; n < points; ++n) {
        UniformsOf<S> u;
        std::size_t rest = n;
        for (std::size_t i = 0; i < dimensions; ++i, rest /= grid) {
            // Off the cells' centres by the golden section: on a symmetric kink all differences would agree.
            u[static_cast<int>(i)] = static_cast<Scalar>((static_cast<double>(rest % grid) + 0.381966) / options.grid);
        }
        const auto sample = strategy.sample(u);
        if (sample.pdf == 0) continue;
        if (!(detail::is_finite(sample.value) && sample.pdf > 0 && std::isfinite(sample.pdf))) {
            return {false, std::numeric_limits<double>::infinity(),
                    detail::text("drew ", sample.value, " with density ", double{sample.pdf}, " at u = ", u)};
        }
        ++drawn;
        const auto stretch = detail::stretch_at(strategy, u, options, tolerance);
        if (!(stretch.error <= tolerance / 2 * stretch.value)) continue;
        ++compared;
        const double ratio = double{sample.pdf} * stretch.value, error = std::abs(ratio - 1);
        ratios.add(ratio);
        if (!(error <= tolerance)) ++wrong;
        if (error <= result.number) continue;
        result.number = error;
        if (error <= tolerance) continue;
        result.passed = false;
        result.message = detail::text("density ", double{sample.pdf}, " at ", sample.value, ", but 1 / |det J| is ",
                                      1 / stretch.value, " at u = ", u);
    }
    if (!result.passed) {
        result.message += detail::text("; density x |det J| is off at ", wrong, " of ", compared, " points, ",
                                       ratios.spread(tolerance));
    } else if (!(compared >= options.least_share * drawn)) {
        result.passed = result.decided = false;
        result.message = detail::text("differences tell the Jacobian at only ", compared, " of ", drawn,
                                      " points: elsewhere the map has kinks, or rounding leaves no step to take");
        if constexpr (std::same_as<Scalar, float>) result.message += "; ask the strategy in double";
    } else {
        result.message = detail::text("density and 1 / |det J| agree to ", result.number, " at ", compared, " points");
    }
    return result;
}

}  // namespace lumis::LUMIS_ISA::testing
