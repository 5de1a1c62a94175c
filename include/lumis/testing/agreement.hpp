// The law that sample and pdf agree: what is drawn is well formed, and pdf gives it the density it was drawn with.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/testing/points.hpp"
#include "lumis/testing/result.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>

namespace lumis::LUMIS_ISA::testing {

struct AgreementOptions {
    // All in units in the last place. By how much a point may be off from the one that the density belongs to: the
    // densities at the point and at its neighbours that far away must bracket the one reported.
    double rounding = 4;
    double tolerance = 64;  // of the density, relative
    double length = 4;      // of a direction
    // The density grows without bounds towards the edge of its support, where the point's rounding leaves it no digits:
    // there only the value's form is checked.
    bool unbounded_at_edge = false;
    int samples = 10'000;  // at random uniforms, after all combinations of corner values
    std::uint64_t seed = 1;
};

namespace detail {

// 0, the smallest lattice point, one half, the largest, and 1, which no source yields but hosts may.
template <std::floating_point T>
inline constexpr std::array<T, 7> corner_uniforms{T(0),
                                                  T(1) / T(std::uint64_t{1} << uniform_bits<T>),
                                                  T(1) / T(1 << 24),
                                                  T(0.5),
                                                  T(1) - T(1) / T(1 << 24),
                                                  T(1) - std::numeric_limits<T>::epsilon() / 2,
                                                  T(1)};

// Calls visit(u) for every vector of corner values.
template <int N, std::floating_point T, class Visit>
void for_each_corner(Visit visit) {
    constexpr auto& corners = corner_uniforms<T>;
    std::size_t number = 1;
    for (int i = 0; i < N; ++i) number *= corners.size();
    for (std::size_t n = 0; n < number; ++n) {
        glm::vec<N, T> u;
        std::size_t rest = n;
        for (int i = 0; i < N; ++i, rest /= corners.size()) u[i] = corners[rest % corners.size()];
        visit(u);
    }
}

// Calls visit with the neighbours of a point, `step` away along every axis and diagonal; an index has none.
template <class Point, std::floating_point T, class Visit>
void for_each_neighbour(const Point& x, T step, Visit visit) {
    if constexpr (std::floating_point<Point>) {
        visit(x + step);
        visit(x - step);
    } else if constexpr (requires { x.length(); }) {
        std::size_t number = 1;
        for (int i = 0; i < x.length(); ++i) number *= 3;
        for (std::size_t n = 0; n < number; ++n) {
            auto neighbour = x;
            std::size_t rest = n;
            for (int i = 0; i < x.length(); ++i, rest /= 3) neighbour[i] += step * (T(rest % 3) - 1);
            visit(neighbour);
        }
    }
}

// The lowest and highest density at a point and at its neighbours; NaN if one of them is NaN or negative.
template <Strategy S>
[[nodiscard]] auto density_range(const S& strategy, const typename S::Point& x, typename S::Scalar step) {
    using Scalar = typename S::Scalar;
    const Scalar here = strategy.pdf(x);
    std::pair<Scalar, Scalar> range{here, here};
    for_each_neighbour(x, step, [&](const typename S::Point& neighbour) {
        const Scalar density = strategy.pdf(neighbour);
        if (!(density >= 0)) range.first = range.second = std::numeric_limits<Scalar>::quiet_NaN();
        range = {(std::min)(range.first, density), (std::max)(range.second, density)};
    });
    return range;
}

}  // namespace detail

// For all corner uniforms and many random ones: value and pdf are finite, pdf is not negative, a direction has unit
// length, and pdf(value) is positive and equals the density reported, up to the rounding of
// the value. number: the worst relative disagreement beyond that rounding.
template <Strategy S>
[[nodiscard]] LawResult agreement(const S& strategy, const AgreementOptions& options = {}) {
    using Scalar = typename S::Scalar;
    constexpr double ulp = std::numeric_limits<Scalar>::epsilon();
    constexpr bool is_direction =
        std::same_as<typename S::Point, Direction<Scalar>> && std::same_as<typename S::Measure, measure::SolidAngle>;
    LawResult result{true, 0, {}};
    detail::Ratios ratios;
    bool disagrees = false;
    const auto fail = [&](const auto&... what) {
        if (result.passed) result.message = detail::text(what...);
        result.passed = false;
    };
    const auto check = [&](const UniformsOf<S>& u) {
        const auto sample = strategy.sample(u);
        if (!detail::is_finite(sample.value)) return fail("value ", sample.value, " at u = ", u);
        if (!(sample.pdf >= 0 && sample.pdf <= (std::numeric_limits<Scalar>::max)())) {
            return fail("pdf ", sample.pdf, " at u = ", u);
        }
        if (sample.pdf == 0) return;
        if constexpr (is_direction) {
            const double length = glm::length(glm::dvec3{sample.value});
            if (!(std::abs(length - 1) <= options.length * ulp)) return fail("length ", length, " at u = ", u);
        }
        const double own = sample.pdf;
        const auto [low, high] =
            detail::density_range(strategy, sample.value, static_cast<Scalar>(options.rounding * ulp));
        if (options.unbounded_at_edge && low == 0) return;
        // The neighbours may miss the very peak between them.
        const double peak = double{high} + (double{high} - double{low}) / 32;
        const double excess = std::fmax(double{low} - own, own - peak) / own;
        if (strategy.pdf(sample.value) > 0) ratios.add(own / double{strategy.pdf(sample.value)});
        disagrees = disagrees || excess > options.tolerance * ulp;
        if (excess > result.number) result.number = excess;
        if (!(strategy.pdf(sample.value) > 0 && excess <= options.tolerance * ulp)) {
            fail("drawn with density ", own, ", but pdf is ", double{strategy.pdf(sample.value)}, " at ", sample.value,
                 " and from ", double{low}, " to ", double{high}, " around it; u = ", u);
        }
    };
    detail::for_each_corner<S::dimensions, Scalar>(check);
    Uniforms<std::mt19937_64, Scalar> uniforms{std::mt19937_64{options.seed}};
    for (int i = 0; i < options.samples; ++i) check(uniforms.template next<S::dimensions>());
    if (result.passed) result.message = detail::text("sample and pdf agree to ", result.number);
    if (disagrees) result.message += "; the density drawn with exceeds pdf " + ratios.spread(1e-3);
    return result;
}

}  // namespace lumis::LUMIS_ISA::testing
