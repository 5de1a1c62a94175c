// The law that the density is the reciprocal of how much sample stretches the uniforms, 1 / |det d(point)/d(u)|: by
// finite differences on a grid. Nothing is drawn at random and nothing is integrated, so it is cheap, and it tells
// where a Jacobian is wrong.
#pragma once

#include "lumis/core/strategy.hpp"
#include "lumis/testing/points.hpp"
#include "lumis/testing/result.hpp"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>
#include <type_traits>

namespace lumis::testing {

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

// In float the steps must be wide, and a lobe narrower than a thousandth is not resolved: prefer the strategy in double.
template <std::floating_point T>
inline constexpr double jacobian_step = std::same_as<T, float> ? 1.0 / 128 : 1.0 / 1024;
template <std::floating_point T>
inline constexpr double jacobian_tolerance = std::same_as<T, float> ? 1e-2 : 1e-4;

struct JacobianOptions {
    int grid = 16;                      // points along each uniform
    std::optional<double> step{};       // the scalar's jacobian_step if not given
    std::optional<double> tolerance{};  // of density times stretch, which is 1; the scalar's jacobian_tolerance
    // Where differences over a step and over half of it do not agree, the step is halved, so many times; if they never
    // do, there is a kink, such as the edge of a table's cell, and the point is passed over. So many of the points at
    // which something is drawn must remain.
    int halvings = 10;
    double least_share = 0.8;
};

// Central differences over a step and half of it, extrapolated. number: the worst |density x stretch - 1|.
template <MapsUniforms S>
[[nodiscard]] LawResult jacobian(const S& strategy, const JacobianOptions& options = {}) {
    using Scalar = typename S::Scalar;
    using Point = InDouble<typename S::Point>;
    constexpr std::size_t dimensions = static_cast<std::size_t>(S::dimensions);
    const double step = options.step.value_or(jacobian_step<Scalar>);
    const double tolerance = options.tolerance.value_or(jacobian_tolerance<Scalar>);

    // False if nothing is drawn within the step.
    const auto differences = [&](const UniformsOf<S>& u, double h, detail::Differences<S>& d) {
        for (std::size_t i = 0; i < dimensions; ++i) {
            UniformsOf<S> before = u, after = u;
            const int axis = static_cast<int>(i);
            before[axis] -= static_cast<Scalar>(h);
            after[axis] += static_cast<Scalar>(h);
            if (!(before[axis] >= 0 && after[axis] < 1)) return false;
            const auto first = strategy.sample(before), last = strategy.sample(after);
            if (!(first.pdf > 0 && last.pdf > 0)) return false;
            d[i] = (Point(last.value) - Point(first.value)) / (double{after[axis]} - double{before[axis]});
        }
        return true;
    };

    LawResult result{true, 0, {}};
    int drawn = 0, compared = 0;
    std::size_t points = 1;
    for (std::size_t i = 0; i < dimensions; ++i) points *= static_cast<std::size_t>(options.grid);
    for (std::size_t n = 0; n < points; ++n) {
        UniformsOf<S> u;
        std::size_t rest = n;
        for (std::size_t i = 0; i < dimensions; ++i, rest /= static_cast<std::size_t>(options.grid)) {
            // Off the cells' centres by the golden section: on a symmetric kink all differences would agree.
            const double cell = static_cast<double>(rest % static_cast<std::size_t>(options.grid));
            u[static_cast<int>(i)] = static_cast<Scalar>((cell + 0.381966) / options.grid);
        }
        const auto sample = strategy.sample(u);
        if (sample.pdf == 0) continue;
        ++drawn;
        double rough = 0, fine = 0;
        bool smooth = false;
        detail::Differences<S> d;
        for (int halving = 0; halving <= options.halvings && !smooth; ++halving) {
            const double h = std::ldexp(step, -halving);
            if (!differences(u, h, d)) continue;
            rough = detail::extent(d);
            if (!differences(u, h / 2, d)) continue;
            fine = detail::extent(d);
            // Differences that are not finite are no kink: they are compared, and fail.
            smooth = !(std::abs(rough - fine) > 1e-4 * fine);
        }
        if (!smooth) continue;
        ++compared;
        const double stretch = (4 * fine - rough) / 3;
        const double error = std::abs(double{sample.pdf} * stretch - 1);
        if (!(error <= tolerance) && result.passed) {
            result.passed = false;
            result.message = detail::text("density ", double{sample.pdf}, " at ", sample.value, ", but 1 / |det J| is ",
                                          1 / stretch, " at u = ", u);
        }
        if (!(error <= result.number)) result.number = error;
    }
    if (result.passed && !(compared >= options.least_share * drawn)) {
        result.passed = false;
        result.message = detail::text("a smooth map at only ", compared, " of ", drawn, " points");
    }
    if (result.passed) {
        result.message = detail::text("density and 1 / |det J| agree to ", result.number, " at ", compared, " points");
    }
    return result;
}

}  // namespace lumis::testing
