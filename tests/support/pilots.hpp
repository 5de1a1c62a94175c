// Strategies on the line for pilots, and plans that have had theirs.
#pragma once

#include "optimal_subjects.hpp"
#include "z_test.hpp"
#include <lumis/core/strategy.hpp>

#include <cmath>
#include <cstdint>
#include <random>

// Density 2 x over [0, 1].
struct Steep {
    using Scalar = double;
    using Point = double;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    [[nodiscard]] lumis::Sample<double, double> sample(glm::dvec1 u) const noexcept {
        const double x = std::sqrt(1 - u.x);
        return {x, pdf(x)};
    }
    [[nodiscard]] double pdf(double x) const noexcept { return x >= 0 && x <= 1 ? 2 * x : 0; }
};

// Two points of probability 1/4 and 3/4.
struct TwoPoints {
    using Scalar = double;
    using Point = double;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;
    static constexpr bool is_delta = true;

    [[nodiscard]] lumis::Sample<double, double> sample(glm::dvec1 u) const noexcept {
        return u.x < 0.25 ? lumis::Sample<double, double>{0, 0.25} : lumis::Sample<double, double>{1, 0.75};
    }
    [[nodiscard]] double pdf(double) const noexcept { return 0; }
};

template <class Plan>
Plan piloted(Plan plan, const auto& f, int rounds, std::uint64_t seed = 1) {
    lumis::Uniforms<std::mt19937_64, double> uniforms{std::mt19937_64{seed}};
    for (int i = 0; i < rounds; ++i) plan.add(f, uniforms);
    return plan;
}
