// The law that two estimators have the same mean, for where nobody knows the answer: a reference that is slow and sure beside
// the estimator to be tried, or the same integral by two strategies.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/statistics/running_moments.hpp"
#include "lumis/testing/result.hpp"
#include "lumis/testing/unbiased.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace lumis::LUMIS_ISA::testing {

// first() and second() yield independent estimates, numbers or colours of as many components; those of a pair may share their
// random numbers, which makes the test sharper. Two-sided z-test of the mean difference of options.samples pairs. What is
// relative in the result is relative to the first's mean. number: the p-value.
template <std::invocable First, std::invocable Second>
[[nodiscard]] UnbiasedResult agreement(First&& first, Second&& second, const UnbiasedOptions& options = {}) {
    using Channels = detail::Channels<std::remove_cvref_t<decltype(first())>>;
    using Others = detail::Channels<std::remove_cvref_t<decltype(second())>>;
    constexpr std::size_t channels = Channels::number;
    static_assert(Others::number == channels, "both estimates have as many components");
    struct Component {
        RunningMoments<double> first, second, difference;
    };
    std::array<Component, channels> components;
    for (std::int64_t n = 0; n < options.samples; ++n) {
        const auto a = first();
        const auto b = second();
        for (std::size_t i = 0; i < channels; ++i) {
            const double x = Channels::get(a, static_cast<int>(i)), y = Others::get(b, static_cast<int>(i));
            components[i].first.add(x);
            components[i].second.add(y);
            components[i].difference.add(x - y);
        }
    }

    Significance significance = options.significance;
    significance.family *= channels;
    return detail::worst_component<Channels::number>([&](int channel) {
        const auto& [x, y, difference] = components[static_cast<std::size_t>(channel)];
        const double mean = x.mean();
        const double rounding = detail::rounding_of<typename Channels::Scalar>(mean);
        auto law = detail::z_test(difference, 0, options.answer_error + rounding, significance, std::abs(mean));
        law.message = detail::text("means ", mean, " and ", y.mean(), ", their difference: ", law.message);
        return law;
    });
}

}  // namespace lumis::LUMIS_ISA::testing
