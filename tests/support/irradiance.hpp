// What the tests of estimators share: an estimate is run until its standard error is a thousandth of the answer.
#pragma once

#include "catch.hpp"
#include <lumis/lumis.hpp>
#include <lumis/testing/unbiased.hpp>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

namespace irradiance {

// All z-tests of estimators in these files are one family: a correct library fails any of them with probability 0.01.
inline constexpr lumis::testing::Significance significance{0.01, 400};

// A bias of 0.5 % is then five standard errors.
inline constexpr double relative_standard_error = 1e-3;

template <class T>
auto uniforms(std::uint64_t seed) {
    return lumis::Uniforms<std::mt19937_64, T>{std::mt19937_64{seed}};
}

// Random numbers stratified in two dimensions: in stratum i every pair lies in the i-th of 64 cells of the unit square.
// The mean of one estimate from each is unbiased, and it varies far less than that of 64 independent ones.
template <class T>
class Stratified {
  public:
    static constexpr int strata = 64;

    explicit Stratified(std::uint64_t seed) : uniforms_{uniforms<T>(seed)} {}

    void enter(int stratum) { corner_ = {static_cast<T>(stratum % 8), static_cast<T>(stratum / 8)}; }

    template <int N>
    glm::vec<N, T> next() {
        const auto u = uniforms_.template next<N>();
        if constexpr (N == 2) {
            return glm::min((corner_ + u) / T(8), T(1) - std::numeric_limits<T>::epsilon() / 2);
        } else {
            return u;
        }
    }

  private:
    decltype(uniforms<T>(0)) uniforms_;
    glm::vec<2, T> corner_{T(0), T(0)};
};

// estimate(uniforms) is one estimate. A pilot run of its own finds how many are needed.
template <class T, class Estimate>
void check_unbiased(const std::string& label, Estimate estimate, double answer) {
    const auto mean_of_strata = [&](Stratified<T>& source) {
        double sum = 0;
        for (int stratum = 0; stratum < Stratified<T>::strata; ++stratum) {
            source.enter(stratum);
            sum += static_cast<double>(estimate(source));
        }
        return sum / Stratified<T>::strata;
    };
    Stratified<T> pilot_source{2};
    lumis::RunningMoments<double> pilot;
    for (int i = 0; i < 1000; ++i) pilot.add(mean_of_strata(pilot_source));
    const double aim = relative_standard_error / 1.1 * answer;

    Stratified<T> source{3};
    lumis::testing::UnbiasedOptions options;
    options.samples = std::max<std::int64_t>(1000, std::llround(pilot.variance() / (aim * aim)));
    options.significance = significance;
    // Single precision itself: the mean of many products of rounded numbers.
    options.answer_error = answer * 4 * double{std::numeric_limits<T>::epsilon()};
    const auto law = lumis::testing::unbiased([&] { return mean_of_strata(source); }, answer, options);
    INFO(label << ": " << law.message);
    CHECK(law.passed);
    CHECK(law.relative_standard_error <= relative_standard_error);
}

}  // namespace irradiance
