// The law that invert undoes sample.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/testing/agreement.hpp"
#include "lumis/testing/points.hpp"
#include "lumis/testing/result.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace lumis::LUMIS_ISA::testing {

struct RoundTripOptions {
    // All in units in the last place. By how much a point may be off from the one that u draws: what invert answers for
    // it and for its neighbours that far away must bracket u. At a pole, where no angle exists, all angles do; and so do
    // all u of a light too small for a direction to resolve.
    double rounding = 4;
    // The largest difference between uniforms, over their distance from the ends of [0, 1]: there maps have their poles and
    // tails, where sample itself loses digits.
    double tolerance = 64;
    int samples = 2000;  // at random uniforms, after all combinations of corner values
    std::uint64_t seed = 1;
};

// For corner uniforms and random ones that draw something: invert(value) lies in [0, 1] up to rounding, and is u; 0 and
// 1, the ends of a turn, are the same. number: the worst distance beyond what the point's rounding explains.
template <InvertibleStrategy S>
[[nodiscard]] LawResult round_trip(const S& strategy, const RoundTripOptions& options = {}) {
    using Scalar = typename S::Scalar;
    constexpr double ulp = std::numeric_limits<Scalar>::epsilon();
    const double tolerance = options.tolerance * ulp;
    const auto step = static_cast<Scalar>(options.rounding * ulp);
    LawResult result{true, 0, {}};
    const auto check = [&](const UniformsOf<S>& u) {
        const auto sample = strategy.sample(u);
        if (sample.pdf == 0) return;
        const UniformsOf<S> inverse = strategy.invert(sample.value);
        glm::vec<S::dimensions, double> slack(0.0);
        detail::for_each_neighbour(sample.value, step, [&](const typename S::Point& neighbour) {
            const UniformsOf<S> other = strategy.invert(neighbour);
            for (int i = 0; i < S::dimensions; ++i) {
                const double change = std::abs(double{other[i]} - double{inverse[i]});
                if (change > slack[i]) slack[i] = change;
            }
        });
        double from_ends = 0.5;
        for (int i = 0; i < S::dimensions; ++i) from_ends = std::fmin(from_ends, std::fmin(u[i], 1 - u[i]));
        for (int i = 0; i < S::dimensions; ++i) {
            const double apart = std::abs(std::remainder(double{inverse[i]} - double{u[i]}, 1.0));
            const double outside = std::fmax(-double{inverse[i]}, double{inverse[i]} - 1);
            const double error = std::fmax(apart * from_ends, outside) - slack[i];
            if (std::isfinite(inverse[i]) && error <= tolerance) {
                result.number = std::fmax(result.number, error);
                continue;
            }
            if (result.passed) {
                result.message = detail::text("u = ", u, " drew ", sample.value, ", which inverts to ", inverse,
                                              ", give or take ", slack);
            }
            result.passed = false;
            if (!(error <= result.number)) result.number = error;
        }
    };
    detail::for_each_corner<S::dimensions, Scalar>(check);
    Uniforms<std::mt19937_64, Scalar> uniforms{std::mt19937_64{options.seed}};
    for (int i = 0; i < options.samples; ++i) check(uniforms.template next<S::dimensions>());
    if (result.passed) result.message = detail::text("uniforms come back to ", result.number);
    return result;
}

}  // namespace lumis::LUMIS_ISA::testing
