// The law that an estimator's mean is the answer.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/statistics/running_moments.hpp"
#include "lumis/testing/result.hpp"

#include <boost/math/distributions/normal.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace lumis::LUMIS_ISA::testing {

struct UnbiasedOptions {
    std::int64_t samples = 1'000'000;
    Significance significance{};
    // The error of the answer itself, or what rounding may add, absolute. Four units in the last place of the answer, in
    // the type that estimate() returns, are allowed anyway.
    double answer_error = 0;
};

struct UnbiasedResult : LawResult {
    double relative_standard_error{};
    double smallest_bias_seen{};  // relative; a larger one would have failed with probability 1/2 or more
};

namespace detail {

template <class T>
struct Channels {
    static constexpr int number = 1;
    using Scalar = T;
    static double get(T value, int) noexcept { return static_cast<double>(value); }
};
template <int N, class T, glm::qualifier Q>
struct Channels<glm::vec<N, T, Q>> {
    static constexpr int number = N;
    using Scalar = T;
    static double get(const glm::vec<N, T, Q>& value, int channel) noexcept {
        return static_cast<double>(value[channel]);
    }
};

// How far rounding may move a number of that size, in the type Scalar.
template <class Scalar>
[[nodiscard]] double rounding_of(double number) noexcept {
    return 4 * double{std::numeric_limits<Scalar>::epsilon()} * std::abs(number);
}

// Two-sided z-test of a mean. scale: of what the relative figures are a share.
[[nodiscard]] inline UnbiasedResult z_test(const RunningMoments<double>& moments, double answer, double answer_error,
                                           const Significance& significance, double scale) {
    const boost::math::normal_distribution<double> normal;
    const double mean = moments.mean(), error = moments.standard_error(), threshold = significance.threshold();
    const double off = std::abs(mean - answer), excess = std::fmax(off - answer_error, 0);
    const auto number_of = [](std::uint64_t n) { return static_cast<double>(n); };

    UnbiasedResult result;
    result.relative_standard_error = error / scale;
    result.smallest_bias_seen = (quantile(complement(normal, threshold / 2)) * error + answer_error) / scale;
    result.message = text("mean ", mean, " +- ", error, ", answer ", answer);
    if (moments.rejected() > 0) {
        result.message += text("; ", number_of(moments.rejected()), " of ",
                               number_of(moments.rejected() + moments.count()), " estimates are not finite");
    } else if (!std::isfinite(error)) {
        // Too few estimates, or too large ones.
        result.decided = false;
        result.message += text("; ", number_of(moments.count()), " estimates have no finite standard error");
    } else if (!(error > 0)) {
        // All estimates are the same: what they are off by is no accident.
        result.number = excess > 0 ? 0 : 1;
        result.passed = excess <= 0;
        result.message = text("all ", number_of(moments.count()), " estimates are ", mean, ", answer ", answer,
                              "; off by ", off, ", allowed ", answer_error);
    } else {
        const double z = excess / error;
        result.number = std::isfinite(z) ? 2 * cdf(complement(normal, z)) : 0.0;
        result.passed = result.number >= threshold;
        result.message += text("; off by ", off / error, " standard errors; ", significance.meaning(result.number));
    }
    return result;
}

// The worst of a test for each component.
template <int Components, class Test>
[[nodiscard]] UnbiasedResult worst_component(const Test& test) {
    UnbiasedResult worst;
    for (int i = 0; i < Components; ++i) {
        UnbiasedResult law = test(i);
        if (Components > 1) law.message = text("component ", i, ": ") + law.message;
        const double error = std::fmax(law.relative_standard_error, worst.relative_standard_error);
        const double bias = std::fmax(law.smallest_bias_seen, worst.smallest_bias_seen);
        if (i == 0 || (worst.passed && (!law.passed || law.number < worst.number))) worst = law;
        worst.relative_standard_error = error;
        worst.smallest_bias_seen = bias;
    }
    return worst;
}

}  // namespace detail

// estimate() yields independent estimates: numbers, or colours (glm::vec), of which each component is tested and the
// worst reported; answer is of the same kind. Two-sided z-test; one estimate that is not finite fails. number: the
// p-value, 0 or 1 for estimates without variance.
template <class Estimate, class Answer>
[[nodiscard]] UnbiasedResult unbiased(Estimate&& estimate, const Answer& answer, const UnbiasedOptions& options = {}) {
    using Channels = detail::Channels<std::remove_cvref_t<decltype(estimate())>>;
    constexpr int channels = Channels::number;
    static_assert(detail::Channels<Answer>::number == channels, "the answer has as many components as an estimate");
    std::array<RunningMoments<double>, channels> moments;
    for (std::int64_t i = 0; i < options.samples; ++i) {
        const auto value = estimate();
        for (int channel = 0; channel < channels; ++channel) {
            moments[static_cast<std::size_t>(channel)].add(Channels::get(value, channel));
        }
    }

    Significance significance = options.significance;
    significance.family *= channels;
    return detail::worst_component<channels>([&](int channel) {
        const double exact = detail::Channels<Answer>::get(answer, channel);
        const double rounding = detail::rounding_of<typename Channels::Scalar>(exact);
        return detail::z_test(moments[static_cast<std::size_t>(channel)], exact, options.answer_error + rounding,
                              significance, std::abs(exact));
    });
}

}  // namespace lumis::LUMIS_ISA::testing
