// The law that a density integrates to the probability that something is drawn: 1, unless some uniforms draw nothing.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/testing/cells.hpp"
#include "lumis/testing/charts.hpp"
#include "lumis/testing/quadrature.hpp"
#include "lumis/testing/result.hpp"

#include <boost/math/distributions/normal.hpp>

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <utility>

namespace lumis::LUMIS_ISA::testing {

// A narrow lobe magnifies the rounding of directions in float.
template <std::floating_point T>
inline constexpr double integration_tolerance = std::same_as<T, float> ? 1e-3 : 1e-6;

struct IntegrationOptions {
    // The probability that something is drawn, in closed form; without it the law counts how often it is.
    std::optional<double> probability{};
    std::optional<double> tolerance{};  // the scalar's integration_tolerance if not given
    int samples = 100'000;              // for the count
    std::uint64_t seed = 1;
    Significance significance{};
};

// The chart should be dense where the density is. number: the difference between integral and probability; where the
// probability is counted, what the law allows is the tolerance and the count's own confidence interval. Undecided if the
// quadrature may be off by the difference.
template <Strategy S, class Point = InDouble<typename S::Point>>
[[nodiscard]] LawResult integrates(const S& strategy, const Chart<Point>& chart = sphere_chart(),
                                   const IntegrationOptions& options = {}) {
    using Scalar = typename S::Scalar;
    const double tolerance = options.tolerance.value_or(integration_tolerance<Scalar>);
    constexpr std::size_t lines = 8;
    const Cells<Point> cells{chart, lines, lines};
    const auto density = density_of(strategy);
    Accuracy accuracy{tolerance / (4 * lines)};
    Integral integral = cells.mass(density, accuracy);
    // A second look, with more halvings, where the first one saw that it was not enough.
    if (!(integral.error <= tolerance)) {
        accuracy = {accuracy.absolute, 24, 1e6};
        integral = cells.mass(density, accuracy);
    }

    double probability = options.probability.value_or(0), allowed = tolerance;
    if (!options.probability) {
        Uniforms<std::mt19937_64, Scalar> uniforms{std::mt19937_64{options.seed}};
        int drawn = 0;
        for (int i = 0; i < options.samples; ++i) {
            drawn += strategy.sample(uniforms.template next<S::dimensions>()).pdf > 0;
        }
        probability = drawn / static_cast<double>(options.samples);
        const boost::math::normal_distribution<double> normal;
        const double z = boost::math::quantile(complement(normal, options.significance.threshold() / 2));
        const double variance = std::fmax(integral.value * (1 - integral.value), 0) / options.samples;
        allowed += z * std::sqrt(variance);
    }
    const double error = std::abs(integral.value - probability);
    const bool passed = error <= allowed, decided = passed || !(error - allowed <= integral.error);
    std::string message = detail::text("density integrates to ", integral.value, ", drawn with probability ",
                                       probability, ", allowed ", allowed);
    if (!passed) {
        message += detail::text("; off by the factor ", integral.value / probability, ", quadrature by ",
                                integral.error, " at most, if the chart is dense where the density is");
    }
    return {passed, error, std::move(message), decided};
}

}  // namespace lumis::LUMIS_ISA::testing
