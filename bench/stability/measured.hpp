// What a case counts while it runs: evaluations, the worst error against the reference, broken rules, the largest bias.
#pragma once

// Cases ask heuristics about NaN densities on purpose: what is measured is the policy of release builds.
#ifndef LUMIS_ASSERT
#define LUMIS_ASSERT(condition) static_cast<void>(condition)
#endif

#include "quad.hpp"
#include <lumis/lumis.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <type_traits>

namespace stability {

// How much is measured: all, or less where a sanitizer makes it slow.
struct Effort {
    bool quick = false;

    [[nodiscard]] std::int64_t of(std::int64_t full) const noexcept { return quick ? full / 32 + 1 : full; }
};

// Whether NaN and infinity are known to this build: not under -ffinite-math-only, which -ffast-math implies.
inline constexpr bool knows_nan = !__FINITE_MATH_ONLY__;

// Whether one expression always gives one result: not where the compiler may re-associate it in one place and not in another.
#if defined(__ASSOCIATIVE_MATH__) || defined(__FAST_MATH__)
inline constexpr bool keeps_order = false;
#else
inline constexpr bool keeps_order = true;
#endif

// Whether subnormal numbers count as 0 in this process, as programs linked with -ffast-math have it.
template <std::floating_point T>
[[nodiscard]] bool flushes_subnormals() {
    const volatile T least = std::numeric_limits<T>::denorm_min();
    return !(least > 0);
}

// By their bits: std::isfinite is always true under -ffinite-math-only, and a subnormal number is 0 where
// those are flushed.
template <std::floating_point T>
[[nodiscard]] auto bits_of(T x) noexcept {
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    return std::bit_cast<Bits>(std::abs(x));
}
template <std::floating_point T>
[[nodiscard]] bool is_finite(T x) noexcept {
    return bits_of(x) < bits_of(std::numeric_limits<T>::infinity());
}

class Measured {
  public:
    // A result against its reference, which is positive.
    template <std::floating_point T>
    void compare(T value, const Quad& reference) {
        density(value);
        if (is_finite(value)) error(static_cast<double>(abs(Quad{value} - reference) / reference));
    }

    // An error that the case worked out itself.
    void error(double error) { keep_worst(worst_error_, error); }

    // The error of the formula that is usually used, at the same place; for comparison only.
    template <std::floating_point T>
    void usual(T value, const Quad& reference) {
        keep_worst(usual_error_, static_cast<double>(abs(Quad{value} - reference) / reference));
    }

    // A density or a weight: finite and not negative.
    template <std::floating_point T>
    void density(T value) {
        expect(is_finite(value) && value >= 0);
    }

    // A point must be finite, and its density a density.
    template <std::floating_point T, class S>
    void sample(const S& sample, T pdf_of_value) {
        density(sample.pdf);
        density(pdf_of_value);
        expect(is_finite(sample.value.x) && is_finite(sample.value.y) && is_finite(sample.value.z));
    }

    // A rule that must hold.
    void expect(bool holds) {
        ++evaluations_;
        misbehaved_ += !holds;
    }

    // Two results of one expression: the same to the last bit, or up to a few roundings where it is re-associated.
    template <std::floating_point T>
    void expect_same(T a, T b) {
        expect(keeps_order ? a == b : std::abs(a - b) <= 8 * std::numeric_limits<T>::epsilon() * b);
    }

    // The mean of estimates against the known answer, in standard errors; `rounding` is what single precision itself may
    // add, relative.
    void bias(const lumis::RunningMoments<double>& estimates, double answer, double rounding) {
        evaluations_ += estimates.count() + estimates.rejected();
        misbehaved_ += estimates.rejected();
        const double error = estimates.standard_error();
        const double excess = std::fmax(std::abs(estimates.mean() - answer) - rounding * std::abs(answer), 0.0);
        const double z = excess > 0 ? excess / error : 0.0;
        keep_worst(worst_z_, is_finite(excess) ? z : std::numeric_limits<double>::infinity());
        standard_error_ = std::fmax(standard_error_, error / answer);
    }

    // Whether a case is not to ask about the T nearest to x, because this build does not know it: NaN and infinity, or
    // subnormal numbers, which may have become 0 as a T already. What a case has left out so is said in the table.
    template <std::floating_point T>
    [[nodiscard]] bool leaves_out(double x) {
        const bool is_unknown = !knows_nan && !is_finite(x);
        const bool is_flushed =
            flushes_subnormals<T>() && is_finite(x) && x != 0 && std::abs(x) < double{std::numeric_limits<T>::min()};
        leaves_out_not_finite_ |= is_unknown;
        leaves_out_subnormal_ |= is_flushed;
        return is_unknown || is_flushed;
    }

    [[nodiscard]] bool leaves_out_not_finite() const noexcept { return leaves_out_not_finite_; }
    [[nodiscard]] bool leaves_out_subnormal() const noexcept { return leaves_out_subnormal_; }
    [[nodiscard]] std::uint64_t evaluations() const noexcept { return evaluations_; }
    [[nodiscard]] std::uint64_t misbehaved() const noexcept { return misbehaved_; }
    [[nodiscard]] const std::optional<double>& worst_error() const noexcept { return worst_error_; }
    [[nodiscard]] const std::optional<double>& usual_error() const noexcept { return usual_error_; }
    [[nodiscard]] const std::optional<double>& worst_z() const noexcept { return worst_z_; }
    // The largest of the estimates, relative: a bias of five of it would have been seen.
    [[nodiscard]] double standard_error() const noexcept { return standard_error_; }

  private:
    // What is not finite is the worst, and stays.
    static void keep_worst(std::optional<double>& worst, double value) {
        if (!worst || (is_finite(*worst) && !(is_finite(value) && value <= *worst))) worst = value;
    }

    std::uint64_t evaluations_{}, misbehaved_{};
    std::optional<double> worst_error_, usual_error_, worst_z_;
    double standard_error_{};
    bool leaves_out_not_finite_{}, leaves_out_subnormal_{};
};

template <class T>
[[nodiscard]] auto uniforms(std::uint64_t seed) {
    return lumis::Uniforms<std::mt19937_64, T>{std::mt19937_64{seed}};
}

// 0, the least uniform, the float grid's, one half, the largest two, and 1, which no source yields but hosts may.
template <std::floating_point T>
inline constexpr std::array corner_values{T(0),
                                          T(1) / static_cast<T>(std::uint64_t{1} << lumis::uniform_bits<T>),
                                          T(1) / T(1 << 24),
                                          T(0.5),
                                          T(1) - T(1) / T(1 << 24),
                                          T(1) - std::numeric_limits<T>::epsilon() / 2,
                                          T(1)};

// Calls visit(u) for all pairs of corner values, then for random ones.
template <std::floating_point T, class Visit>
void for_each_uniform(std::int64_t random, Visit visit) {
    for (const T x : corner_values<T>) {
        for (const T y : corner_values<T>) visit(glm::vec<2, T>{x, y});
    }
    auto source = uniforms<T>(1);
    for (std::int64_t i = 0; i < random; ++i) visit(source.template next<2>());
}

// Calls visit(x) for `steps` + 1 values from `first` to `last`, evenly in the logarithm.
template <class Visit>
void sweep(double first, double last, int steps, Visit visit) {
    for (int i = 0; i <= steps; ++i) visit(first * std::pow(last / first, i / static_cast<double>(steps)));
}

// Moments of `samples` estimates, estimate(uniforms).
template <class T, class Estimate>
[[nodiscard]] lumis::RunningMoments<double> moments_of(std::int64_t samples, Estimate estimate) {
    auto source = uniforms<T>(7);
    lumis::RunningMoments<double> moments;
    for (std::int64_t i = 0; i < samples; ++i) moments.add(static_cast<double>(estimate(source)));
    return moments;
}

// What rounding may add to a mean of numbers of type T, relative.
template <std::floating_point T>
inline constexpr double rounding_of_mean = 16 * double{std::numeric_limits<T>::epsilon()};

}  // namespace stability
