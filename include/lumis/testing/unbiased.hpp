// The law that an estimator's mean is the answer.
#pragma once

#include "lumis/statistics/running_moments.hpp"
#include "lumis/testing/result.hpp"

#include <boost/math/distributions/normal.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace lumis::testing {

struct UnbiasedOptions {
    std::int64_t samples = 1'000'000;
    Significance significance{};
    double answer_error = 0;  // of the answer itself, or what rounding may add; absolute
};

struct UnbiasedResult : LawResult {
    double relative_standard_error{};
    double smallest_bias_seen{};  // relative; a larger one would have failed with probability 1/2 or more
};

// estimate() yields independent estimates. Two-sided z-test; one estimate that is not finite fails. number: the
// p-value.
template <class Estimate>
[[nodiscard]] UnbiasedResult unbiased(Estimate&& estimate, double answer, const UnbiasedOptions& options = {}) {
    RunningMoments<double> moments;
    for (std::int64_t i = 0; i < options.samples; ++i) moments.add(static_cast<double>(estimate()));

    const boost::math::normal_distribution<double> normal;
    const double error = moments.standard_error(), scale = std::abs(answer);
    const double excess = std::abs(moments.mean() - answer) - options.answer_error;
    const double z = excess <= 0 ? 0.0 : excess / error;  // NaN stays NaN, and fails
    const double p = std::isfinite(z) ? 2 * cdf(complement(normal, z)) : 0.0;
    const double threshold = options.significance.threshold();

    UnbiasedResult result;
    result.passed = p >= threshold && moments.rejected() == 0;
    result.number = p;
    result.relative_standard_error = error / scale;
    result.smallest_bias_seen = (quantile(complement(normal, threshold / 2)) * error + options.answer_error) / scale;
    result.message = detail::text("mean ", moments.mean(), " +- ", error, ", answer ", answer, ", z = ", z, ", p = ", p,
                                  ", not finite: ", static_cast<double>(moments.rejected()));
    return result;
}

}  // namespace lumis::testing
