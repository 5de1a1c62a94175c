// What is asked of every light.
#pragma once

#include "measured.hpp"

#include <algorithm>

namespace stability {

template <class T>
using Vector = glm::vec<3, T>;

// The irradiance on a receiver at the origin of normal +z.
template <class T, class Light>
void check_irradiance(Measured& measured, const Light& light, double answer, std::int64_t samples) {
    const auto estimator = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, light));
    const auto f = [](const Vector<T>& w) { return std::max(w.z, T(0)); };
    const auto moments = moments_of<T>(samples, [&](auto& source) { return estimator.estimate(f, source); });
    measured.bias(moments, answer, rounding_of_mean<T>);
}

template <class T, class Light>
void check_draws_nothing(Measured& measured, const Light& light) {
    for_each_uniform<T>(20, [&](const auto& u) {
        const auto sample = light.sample(u);
        const T pdf = light.pdf(sample.value);
        measured.sample<T>(sample, pdf);
        measured.expect(sample.pdf == 0 && pdf == 0);
    });
}

}  // namespace stability
