// What the laws run over: a strategy with a chart that is dense where its density is.
#pragma once

#include <lumis/testing/agreement.hpp>
#include <lumis/testing/charts.hpp>
#include <lumis/testing/coverage.hpp>
#include <lumis/testing/points.hpp>
#include <lumis/testing/result.hpp>
#include <lumis/testing/round_trip.hpp>

#include <functional>
#include <optional>
#include <string>

namespace subjects {

// Where a machine can, compilers fuse products into sums: clang++ in numbers but not in lanes, so that each rounds in its own
// way. Without that a batch and the single call round alike.
#ifdef __FMA__
inline constexpr bool fused = true;
#else
inline constexpr bool fused = false;
#endif

template <class S>
struct Subject {
    std::string label;
    S strategy;
    lumis::testing::Chart<lumis::testing::InDouble<typename S::Point>> chart;
    std::optional<double> probability = 1.0;  // of something being drawn; none: to be counted
    // By how much a slack for rounding at the support's edge may raise the integral, and corners of the support mislead
    // the quadrature, relative.
    double blur = 0;
    lumis::testing::AgreementOptions agreement{};
    lumis::testing::RoundTripOptions round_trip{};
    // Between what a batch and the single call draw, in units in the last place.
    double batch_distance = agreement.rounding * (fused ? 2 : 1);
    // Where an integrand that the strategy is made for is not 0; every subject states it.
    std::function<bool(const lumis::testing::InDouble<typename S::Point>&)> integrand{};
};

template <class... Parts>
std::string label(const Parts&... parts) {
    return lumis::testing::detail::text(parts...);
}

}  // namespace subjects
