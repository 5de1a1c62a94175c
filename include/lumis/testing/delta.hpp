// The law of delta strategies: no density anywhere, and a probability where others report one.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/testing/points.hpp"
#include "lumis/testing/result.hpp"
#include "lumis/testing/stability.hpp"

#include <cmath>
#include <concepts>
#include <limits>

namespace lumis::LUMIS_ISA::testing {

// pdf is 0 at what is drawn, around it, and everywhere else; what is drawn is finite, of unit length, and has a
// probability in [0, 1]. number: how often it was not so.
template <DeltaStrategy S>
[[nodiscard]] LawResult draws_deltas(const S& strategy, int samples = 1000) {
    using Scalar = typename S::Scalar;
    constexpr double ulp = std::numeric_limits<Scalar>::epsilon();
    LawResult result{true, 0, "a delta"};
    const auto check = [&](bool good, const auto&... what) {
        if (good) return;
        if (result.passed) result.message = detail::text(what...);
        result.passed = false;
        ++result.number;
    };
    const auto check_density = [&](const typename S::Point& x) {
        check(strategy.pdf(x) == 0, "pdf is ", double{strategy.pdf(x)}, " at ", x);
    };
    detail::for_each_draw(strategy, samples, [&](const auto& u, const auto& sample) {
        check(detail::is_finite(sample.value) && sample.pdf >= 0 && sample.pdf <= 1, "drew ", sample.value,
              " with probability ", double{sample.pdf}, " at u = ", u);
        check_density(sample.value);
        if (!(sample.pdf > 0)) return;
        if constexpr (std::same_as<typename S::Measure, measure::SolidAngle>) {
            const double length = glm::length(InDouble<typename S::Point>{sample.value});
            check(std::abs(length - 1) <= 4 * ulp, "length ", length, " at u = ", u);
        }
    });
    detail::for_each_odd_point<typename S::Point>(check_density);
    return result;
}

}  // namespace lumis::LUMIS_ISA::testing
