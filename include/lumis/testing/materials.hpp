// Laws of a material. A BSDF is any callable f(wo, wi), without a cosine: a number or a colour, for unit vectors of the local frame
// with the normal +z, both of which point away from the surface. A strategy is one that draws wi for a given wo.
//     weighs(strategy, f_cos)        the weight that a sample reports is f cos / pdf
//     is_reciprocal(f)               f(wo, wi) = f(wi, wo)
//     conserves_energy(f, wo, chart) no more is reflected and transmitted than comes in: the white furnace
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/spherical.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/testing/agreement.hpp"
#include "lumis/testing/cells.hpp"
#include "lumis/testing/charts.hpp"
#include "lumis/testing/points.hpp"
#include "lumis/testing/quadrature.hpp"
#include "lumis/testing/result.hpp"
#include "lumis/testing/unbiased.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA::testing {

namespace detail {

template <class S>
concept DrawsWeights = requires(const S strategy, UniformsOf<S> u) {
    strategy.sample(u).weight;
};
template <class S>
concept WeighsPoints = requires(const S strategy, typename S::Point x) {
    strategy.weight(x);
};

template <class S>
[[nodiscard]] auto weight_of(const S& strategy, const auto& sample) {
    if constexpr (DrawsWeights<S>) {
        return sample.weight;
    } else {
        using Weight = std::remove_cvref_t<decltype(strategy.weight(sample.value))>;
        return sample.pdf > 0 ? strategy.weight(sample.value) : Weight(0);
    }
}

}  // namespace detail

// A strategy that tells the weight which a path goes on with, f cos / pdf, a number or a colour: a member of its samples, or
// weight(point), which is asked of what was drawn.
template <class S>
concept WeighingStrategy = Strategy<S> &&(detail::DrawsWeights<S> || detail::WeighsPoints<S>);

template <class F>
concept Bsdf = std::invocable<const F&, const glm::dvec3&, const glm::dvec3&> ||
    std::invocable<const F&, const glm::vec3&, const glm::vec3&>;

namespace detail {

// f in double, or in float if it takes nothing else.
template <Bsdf F>
[[nodiscard]] auto ask(const F& f, const glm::dvec3& wo, const glm::dvec3& wi) {
    if constexpr (std::invocable<const F&, const glm::dvec3&, const glm::dvec3&>) {
        return f(wo, wi);
    } else {
        return f(glm::vec3{wo}, glm::vec3{wi});
    }
}

template <Bsdf F>
using BsdfChannels = Channels<decltype(ask(std::declval<const F&>(), glm::dvec3{}, glm::dvec3{}))>;

}  // namespace detail

struct WeightOptions {
    // The distance of a point from the one that the weight belongs to, at most, in units in the last place: f cos / pdf at the
    // point and at its neighbours that far away must bracket the weight.
    double rounding = 4;
    double tolerance = 256;  // of the weight, relative, in units in the last place
    int samples = 10'000;    // at random uniforms, after all combinations of corner values
    std::uint64_t seed = 1;
};

// f_cos(point): the integrand that is divided by the density, a number or a colour of as many components as the weight. Where
// nothing is drawn, the weight is 0. number: the largest relative error beyond rounding.
template <WeighingStrategy S, class F>
[[nodiscard]] LawResult weighs(const S& strategy, const F& f_cos, const WeightOptions& options = {}) {
    using Scalar = typename S::Scalar;
    using Point = typename S::Point;
    using Weight = decltype(detail::weight_of(strategy, strategy.sample(UniformsOf<S>{})));
    using Weights = detail::Channels<Weight>;
    using Values = detail::Channels<std::remove_cvref_t<decltype(f_cos(Point{}))>>;
    static_assert(Weights::number == Values::number, "the weight has as many components as f");
    constexpr double ulp = std::numeric_limits<Scalar>::epsilon();
    const double tolerance = options.tolerance * ulp;

    LawResult result{true, 0, {}};
    detail::Ratios ratios;
    const auto fail = [&](const auto&... what) {
        if (result.passed) result.message = detail::text(what...);
        result.passed = false;
    };
    const auto check = [&](const UniformsOf<S>& u) {
        const auto sample = strategy.sample(u);
        const Weight reported = detail::weight_of(strategy, sample);
        for (int i = 0; i < Weights::number; ++i) {
            const double weight = Weights::get(reported, i);
            if (!std::isfinite(weight)) return fail("weight ", weight, " at u = ", u);
            if (!(sample.pdf > 0)) {
                if (weight != 0) fail("weight ", weight, " of nothing drawn at u = ", u);
                continue;
            }
            const auto quotient = [&](const Point& x) {
                return Values::get(f_cos(x), i) / static_cast<double>(strategy.pdf(x));
            };
            const double here = quotient(sample.value);
            double low = here, high = here;
            detail::for_each_neighbour(sample.value, static_cast<Scalar>(options.rounding * ulp), [&](const Point& x) {
                const double there = quotient(x);
                if (std::isfinite(there)) low = (std::min)(low, there), high = (std::max)(high, there);
            });
            const double size = (std::max)(std::abs(here), std::abs(weight));
            const double error = size > 0 ? (std::max)({low - weight, weight - high, 0.0}) / size : 0.0;
            if (here != 0) ratios.add(weight / here);
            if (error > result.number) result.number = error;
            if (!(error <= tolerance)) {
                fail("weight ", weight, ", but f cos / pdf is ", here, ", and from ", low, " to ", high,
                     " around it, at ", sample.value, "; u = ", u);
            }
        }
    };
    detail::for_each_corner<S::dimensions, Scalar>(check);
    Uniforms<std::mt19937_64, Scalar> uniforms{std::mt19937_64{options.seed}};
    for (int i = 0; i < options.samples; ++i) check(uniforms.template next<S::dimensions>());
    if (result.passed) {
        result.message = detail::text("weights are f cos / pdf to ", result.number);
    } else if (result.number > tolerance) {
        result.message += "; weights exceed f cos / pdf " + ratios.spread(1e-3);
    }
    return result;
}

// What rounding may do to a BSDF in the precision of its values, relative.
template <std::floating_point T>
inline constexpr double bsdf_tolerance = std::same_as<T, float> ? 1e-3 : 1e-8;

struct ReciprocityOptions {
    double tolerance = 0;     // relative; bsdf_tolerance of what f returns if 0
    bool both_sides = false;  // also wo and wi of which one is below the surface
    int pairs = 10'000;       // of directions
    std::uint64_t seed = 1;
};

// f(wo, wi) = f(wi, wo), and finite and not negative. Half of the pairs are anywhere, grazing ones as well; half lie near mirror
// directions, as near as 1e-4, so that a narrow lobe is met. number: the largest difference, relative.
template <Bsdf F>
[[nodiscard]] LawResult is_reciprocal(const F& f, const ReciprocityOptions& options = {}) {
    using Values = detail::BsdfChannels<F>;
    const double tolerance = options.tolerance > 0 ? options.tolerance : bsdf_tolerance<typename Values::Scalar>;
    constexpr double least = (std::numeric_limits<typename Values::Scalar>::min)();
    Uniforms<std::mt19937_64, double> uniforms{std::mt19937_64{options.seed}};
    // Above the horizon: half evenly, half about as often at each order of magnitude of the cosine.
    const auto direction = [&] {
        const auto u = uniforms.next<3>();
        const double cosine = u.z < 0.5 ? 1 - u.x : std::pow(1e-4, u.x);
        return direction_at(1 - cosine, u.y);
    };
    LawResult result{true, 0, {}};
    const auto check = [&](const glm::dvec3& wo, const glm::dvec3& wi) {
        const auto forth = detail::ask(f, wo, wi), back = detail::ask(f, wi, wo);
        for (int i = 0; i < Values::number; ++i) {
            // Below the least normal number there are no digits to compare.
            const double a = Values::get(forth, i), b = Values::get(back, i);
            const double difference = std::abs(a - b) / (std::max)({a, b, least});
            const bool valid = std::isfinite(a) && std::isfinite(b) && a >= 0 && b >= 0;
            if (difference > result.number) result.number = difference;
            if (valid && difference <= tolerance) continue;
            if (result.passed)
                result.message = detail::text("f is ", a, ", the other way ", b, ", of ", wo, " and ", wi);
            result.passed = false;
        }
    };
    for (int i = 0; i < options.pairs; ++i) {
        const glm::dvec3 wo = direction();
        glm::dvec3 wi = direction();
        if (i % 2 == 0) {
            wi = glm::normalize(glm::dvec3{-wo.x, -wo.y, wo.z} + std::pow(1e-4, uniforms.next<1>().x) * wi);
        }
        if (options.both_sides && i % 4 < 2) wi.z = -wi.z;
        check(wo, wi);
    }
    result.message += result.passed ? detail::text("the same both ways to ", result.number)
                                    : detail::text("; differs by ", result.number, " at most, relative");
    return result;
}

struct EnergyOptions {
    double most = 1;       // of what comes in
    double tolerance = 0;  // absolute; bsdf_tolerance of what f returns if 0
};

// The integral of f(wo, wi) |wi.z| over wi, the share of light from wo that leaves again, is at most 1, or options.most. The
// chart should be dense where the lobe is, and hold the whole sphere if f transmits. number: the integral, of a colour's
// brightest component. Undecided if the quadrature may be off by the excess.
template <Bsdf F>
[[nodiscard]] LawResult conserves_energy(const F& f, const glm::dvec3& wo, const DirectionChart& chart = sphere_chart(),
                                         const EnergyOptions& options = {}) {
    using Values = detail::BsdfChannels<F>;
    const double tolerance = options.tolerance > 0 ? options.tolerance : bsdf_tolerance<typename Values::Scalar>;
    constexpr std::size_t lines = 8;
    const Cells<glm::dvec3> cells{chart, lines, lines};
    Integral albedo;
    for (int i = 0; i < Values::number; ++i) {
        const Density<glm::dvec3> f_cos = [&](const glm::dvec3& wi) {
            return Values::get(detail::ask(f, wo, wi), i) * std::abs(wi.z);
        };
        const Integral of_component = cells.mass(f_cos, {(std::max)(tolerance, 1e-7) / (4 * lines), 10, 2e5});
        if (!(of_component.value <= albedo.value)) albedo = of_component;
    }
    const double excess = albedo.value - options.most;
    LawResult result;
    result.number = albedo.value;
    result.passed = excess <= tolerance;
    result.decided = result.passed || !(excess - tolerance <= albedo.error);
    result.message =
        detail::text("reflects and transmits ", albedo.value, " of the light from ", wo, ", allowed ", options.most,
                     "; quadrature off by ", albedo.error, " at most, if the chart is dense where the lobe is");
    return result;
}

}  // namespace lumis::LUMIS_ISA::testing
