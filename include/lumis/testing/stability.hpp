// The laws of numbers that misbehave: whatever a strategy was made of, what it answers is finite and not negative, and
// in float it is not far from what it is in double.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/testing/agreement.hpp"
#include "lumis/testing/points.hpp"
#include "lumis/testing/result.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <random>

namespace lumis::LUMIS_ISA::testing {

namespace detail {

// Values for one component of a point that no sane caller passes, and some that one does.
template <class T>
inline constexpr std::array<T, 10> odd_components{T(0),
                                                  -T(0),
                                                  T(1),
                                                  T(-1),
                                                  T(0.6),
                                                  std::numeric_limits<T>::denorm_min(),
                                                  (std::numeric_limits<T>::max)(),
                                                  std::numeric_limits<T>::infinity(),
                                                  -std::numeric_limits<T>::infinity(),
                                                  std::numeric_limits<T>::quiet_NaN()};

// Calls visit(x) for all points made of them; indices: some small ones and the largest.
template <class Point, class Visit>
void for_each_odd_point(Visit visit) {
    if constexpr (std::integral<Point>) {
        for (Point i = 0; i < 100; ++i) visit(i);
        visit((std::numeric_limits<Point>::max)());
    } else if constexpr (std::floating_point<Point>) {
        for (const Point x : odd_components<Point>) visit(x);
    } else {
        using Scalar = typename Point::value_type;
        constexpr auto& odd = odd_components<Scalar>;
        std::size_t number = 1;
        for (int i = 0; i < Point::length(); ++i) number *= odd.size();
        for (std::size_t n = 0; n < number; ++n) {
            Point x;
            std::size_t rest = n;
            for (int i = 0; i < Point::length(); ++i, rest /= odd.size()) x[i] = odd[rest % odd.size()];
            visit(x);
        }
    }
}

template <Strategy S, class Check>
void for_each_draw(const S& strategy, int samples, Check check) {
    using Scalar = typename S::Scalar;
    for_each_corner<S::dimensions, Scalar>([&](const auto& u) { check(u, strategy.sample(u)); });
    Uniforms<std::mt19937_64, Scalar> uniforms{std::mt19937_64{1}};
    for (int i = 0; i < samples; ++i) {
        const auto u = uniforms.template next<S::dimensions>();
        check(u, strategy.sample(u));
    }
}

}  // namespace detail

// sample at corner and random uniforms yields finite values, and sample and pdf yield densities that are finite and not
// negative, pdf also for directions that are none: NaN, infinite, zero, of any length. number: how many did not.
template <Strategy S>
[[nodiscard]] LawResult stays_finite(const S& strategy, int samples = 1000) {
    using Scalar = typename S::Scalar;
    LawResult result{true, 0, "all finite"};
    const auto check = [&](bool good, const auto&... what) {
        if (good) return;
        if (result.passed) result.message = detail::text(what...);
        result.passed = false;
        ++result.number;
    };
    const auto is_density = [](Scalar pdf) { return pdf >= 0 && pdf <= (std::numeric_limits<Scalar>::max)(); };
    detail::for_each_draw(strategy, samples, [&](const auto& u, const auto& sample) {
        check(detail::is_finite(sample.value) && is_density(sample.pdf), "drew ", sample.value, " with density ",
              double{sample.pdf}, " at u = ", u);
        check(is_density(strategy.pdf(sample.value)), "pdf is ", double{strategy.pdf(sample.value)}, " at ",
              sample.value);
    });
    detail::for_each_odd_point<typename S::Point>([&](const typename S::Point& x) {
        check(is_density(strategy.pdf(x)), "pdf is ", double{strategy.pdf(x)}, " at ", x);
    });
    return result;
}

// For a strategy that has nothing to draw: it stays finite, draws nothing, and its density is 0 at what it might have
// drawn. number: how often it was not.
template <Strategy S>
[[nodiscard]] LawResult draws_nothing(const S& strategy, int samples = 1000) {
    LawResult result = stays_finite(strategy, samples);
    if (result.passed) result.message = "nothing drawn";
    const auto check = [&](double pdf, const auto& where) {
        if (pdf == 0) return;
        if (result.passed) result.message = detail::text("density ", pdf, " at ", where);
        result.passed = false;
        ++result.number;
    };
    detail::for_each_draw(strategy, samples, [&](const auto& u, const auto& sample) {
        check(double{sample.pdf}, u);
        check(double{strategy.pdf(sample.value)}, sample.value);
    });
    return result;
}

struct NearnessOptions {
    double value = 1e-5;   // how far points may lie apart
    double pdf = 1e-3;     // how far densities may, relative to the larger
    double undecided = 0;  // the share of uniforms at which one draws and the other may not
    int samples = 1000;    // at random uniforms, after all combinations of corner values
};

// At the same uniforms, corners and random ones, a strategy in float draws nearly what the same one in double draws.
// Both should be made of the same numbers, rounded to float. number: the worst relative distance between densities.
template <Strategy InFloat, Strategy InDouble>
    requires std::same_as<typename InFloat::Scalar, float> && std::same_as<typename InDouble::Scalar, double>
[[nodiscard]] LawResult stays_near(const InFloat& in_float, const InDouble& in_double,
                                   const NearnessOptions& options = {}) {
    LawResult result{true, 0, {}};
    double worst_value = 0;
    int draws = 0, undecided = 0;
    const auto fail = [&](const auto&... what) {
        if (result.passed) result.message = detail::text(what...);
        result.passed = false;
    };
    detail::for_each_draw(in_float, options.samples, [&](const auto& u, const auto& sample) {
        ++draws;
        const auto exact = in_double.sample(UniformsOf<InDouble>(u));
        const double a = sample.pdf, b = exact.pdf;
        if ((a > 0) != (b > 0)) {
            ++undecided;
            return;
        }
        if (a == 0 && b == 0) return;
        const double value = detail::distance<typename InDouble::Point>(
            static_cast<typename InDouble::Point>(sample.value), exact.value);
        const double pdf = std::abs(a - b) / std::fmax(a, b);
        if (!(value <= worst_value)) worst_value = value;
        if (!(pdf <= result.number)) result.number = pdf;
        if (!(value <= options.value)) fail("drew ", sample.value, ", in double ", exact.value, " at u = ", u);
        if (!(pdf <= options.pdf)) fail("density ", a, ", in double ", b, " at u = ", u);
    });
    if (!(undecided <= options.undecided * draws)) {
        fail("drew or not otherwise than in double at ", undecided, " of ", draws, " uniforms");
    }
    if (result.passed) result.message = detail::text("values agree to ", worst_value, ", densities to ", result.number);
    return result;
}

// A sweep: make.operator()<T>(parameter) yields the strategy in T. In float and in double each stays finite, and float
// stays near double. Parameters should be numbers that a float holds. number: the worst relative distance between
// densities. The message tells which parameter, by its place in the range, failed first.
template <class Parameters, class Make>
[[nodiscard]] LawResult stability(const Parameters& parameters, const Make& make, const NearnessOptions& options = {}) {
    LawResult result{true, 0, {}};
    std::size_t place = 0;
    for (const auto& parameter : parameters) {
        const auto in_float = make.template operator()<float>(parameter);
        const auto in_double = make.template operator()<double>(parameter);
        const auto check = [&](const LawResult& law, const char* what) {
            if (law.passed) return;
            if (result.passed) result.message = detail::text("parameter ", place, what) + law.message;
            result.passed = false;
        };
        check(stays_finite(in_float, options.samples), " in float: ");
        check(stays_finite(in_double, options.samples), " in double: ");
        const auto nearness = stays_near(in_float, in_double, options);
        check(nearness, ": ");
        if (!(nearness.number <= result.number)) result.number = nearness.number;
        ++place;
    }
    if (result.passed) {
        result.message = detail::text(place, " parameters: all finite, densities agree to ", result.number);
    }
    return result;
}

}  // namespace lumis::LUMIS_ISA::testing
