// Count, mean and variance of a stream of numbers, by Welford's update and Chan, Golub and LeVeque's merge (1979), in
// double whatever is added: the mean of 1e8 floats keeps its digits, and so does a small variance about a large mean.
// The mean of finite numbers is always finite. Their variance is infinite, never NaN, where the sum of squared deviations
// exceeds double's range: deviations beyond 1e154, which no float reaches.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace lumis::LUMIS_ISA {

template <std::floating_point T = double>
class RunningMoments {
  public:
    // A number that is not finite is counted in rejected() and enters nothing else.
    LUMIS_HD void add(T value) noexcept {
        if (!std::isfinite(value)) {
            ++rejected_;
            return;
        }
        ++count_;
        const auto count = static_cast<double>(count_);
        const double from_old_mean = real::rounded(double{value} - mean_);
        if (std::isfinite(from_old_mean)) {
            mean_ += from_old_mean / count;
        } else {
            mean_ = weighted_mean(mean_, count - 1, double{value}, 1);
        }
        squares_ += from_old_mean * real::rounded(double{value} - real::rounded(mean_));
    }

    // Each of several lanes, in their order.
    template <class R>
        requires(Real<R> && !std::floating_point<R> && std::convertible_to<scalar_of<R>, T>)
    LUMIS_HD void add(const R& lanes) noexcept {
        for (std::size_t i = 0; i < R::size; ++i) add(static_cast<T>(lanes[i]));
    }

    // As if everything added to `other` had been added here.
    LUMIS_HD void merge(const RunningMoments& other) noexcept {
        rejected_ += other.rejected_;
        if (other.count_ == 0) return;
        if (count_ == 0) {  // exactly as they are: the square below may overflow
            count_ = other.count_, mean_ = other.mean_, squares_ = other.squares_;
            return;
        }
        const auto mine = static_cast<double>(count_), theirs = static_cast<double>(other.count_);
        const double between = real::rounded(other.mean_ - mean_);
        if (std::isfinite(between)) {
            mean_ += between * (theirs / (mine + theirs));
        } else {
            mean_ = weighted_mean(mean_, mine, other.mean_, theirs);
        }
        squares_ += other.squares_ + between * between * real::rounded(mine * theirs / (mine + theirs));
        count_ += other.count_;
    }

    [[nodiscard]] LUMIS_HD std::uint64_t count() const noexcept { return count_; }
    [[nodiscard]] LUMIS_HD std::uint64_t rejected() const noexcept { return rejected_; }

    // 0 of nothing.
    [[nodiscard]] LUMIS_HD double mean() const noexcept { return mean_; }

    // Unbiased (divided by count - 1); NaN for fewer than two numbers, infinite beyond double's range.
    [[nodiscard]] LUMIS_HD double variance() const noexcept {
        return count_ > 1 ? squares_ / static_cast<double>(count_ - 1) : std::numeric_limits<double>::quiet_NaN();
    }

    // The standard error of the mean; NaN for fewer than two numbers.
    [[nodiscard]] LUMIS_HD double standard_error() const noexcept {
        return std::sqrt(variance() / static_cast<double>(count_));
    }

  private:
    // The mean of two groups of numbers, given their means and sizes, without the difference of the means: that of
    // 1e308 and -1e308 overflows.
    LUMIS_HD static double weighted_mean(double a, double a_size, double b, double b_size) noexcept {
        const double size = a_size + b_size;
        return real::rounded(a * real::rounded(a_size / size)) + real::rounded(b * real::rounded(b_size / size));
    }

    std::uint64_t count_{};
    std::uint64_t rejected_{};
    double mean_{};
    double squares_{};  // sum of squared deviations from the mean
};

}  // namespace lumis::LUMIS_ISA
