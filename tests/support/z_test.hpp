// Estimators against known integrals, by as many samples as it takes to see a bias of half a percent. Seeds are fixed, so
// a test that passes, passes always; a new seed would fail an estimator that is right once in 10,000 families of tests.
#pragma once

#include <lumis/core/uniforms.hpp>
#include <lumis/statistics/running_moments.hpp>
#include <lumis/testing/unbiased.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>

// Moments of `samples` independent calls of estimate(uniforms).
template <class T, class Estimate>
lumis::RunningMoments<T> moments_of(Estimate&& estimate, std::int64_t samples, std::uint64_t seed) {
    lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{seed}};
    lumis::RunningMoments<T> moments;
    for (std::int64_t i = 0; i < samples; ++i) moments.add(estimate(uniforms));
    return moments;
}

// A pilot run of other random numbers tells how many samples bring the standard error to 0.08 % of the integral: a bias
// of 0.5 % is six of them. family: how many such tests share the false-alarm rate.
template <class T, class Estimate>
lumis::testing::UnbiasedResult z_test(Estimate&& estimate, double integral, std::uint64_t seed,
                                      std::size_t family = 1) {
    constexpr double precision = 0.0008;
    const double wanted =
        moments_of<T>(estimate, 20'000, ~seed).variance() / (integral * precision * integral * precision);
    const auto samples = static_cast<std::int64_t>(wanted > 2e4 ? std::min(wanted, 3e7) : 2e4);
    const double rounding = 4 * double{std::numeric_limits<T>::epsilon()} * integral;
    lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{seed}};
    return lumis::testing::unbiased([&] { return estimate(uniforms); }, integral, {samples, {1e-4, family}, rounding});
}
