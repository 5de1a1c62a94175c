// The laws of numbers that misbehave: whatever a strategy was made of, what it answers is finite and not negative.
#pragma once

#include "lumis/core/strategy.hpp"
#include "lumis/core/uniforms.hpp"
#include "lumis/testing/agreement.hpp"
#include "lumis/testing/result.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <random>

namespace lumis::testing {

namespace detail {

// Values for one component of a point that no sane caller passes, and some that one does.
template <class T>
inline constexpr std::array<T, 10> odd_components{T(0),
                                                  -T(0),
                                                  T(1),
                                                  T(-1),
                                                  T(0.6),
                                                  std::numeric_limits<T>::denorm_min(),
                                                  std::numeric_limits<T>::max(),
                                                  std::numeric_limits<T>::infinity(),
                                                  -std::numeric_limits<T>::infinity(),
                                                  std::numeric_limits<T>::quiet_NaN()};

// Calls visit(x) for all points made of them.
template <class T, class Visit>
void for_each_odd_point(Visit visit) {
    constexpr auto& odd = odd_components<T>;
    for (const T x : odd) {
        for (const T y : odd) {
            for (const T z : odd) visit(glm::vec<3, T>{x, y, z});
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
    const auto is_density = [](Scalar pdf) { return pdf >= 0 && pdf <= std::numeric_limits<Scalar>::max(); };
    detail::for_each_draw(strategy, samples, [&](const auto& u, const auto& sample) {
        check(detail::is_finite(sample.value) && is_density(sample.pdf), "drew ", sample.value, " with density ",
              double{sample.pdf}, " at u = ", u);
        check(is_density(strategy.pdf(sample.value)), "pdf is ", double{strategy.pdf(sample.value)}, " at ",
              sample.value);
    });
    detail::for_each_odd_point<Scalar>([&](const glm::vec<3, Scalar>& w) {
        check(is_density(strategy.pdf(w)), "pdf is ", double{strategy.pdf(w)}, " at ", w);
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

}  // namespace lumis::testing
