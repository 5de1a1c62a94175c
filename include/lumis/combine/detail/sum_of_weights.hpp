// A sum that keeps its digits, however many numbers it has.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <concepts>

namespace lumis::LUMIS_ISA::detail {

// Numbers of either type are summed in double.
template <Real R>
class SumOfWeights {
  public:
    using Value = double;

    LUMIS_INLINE constexpr void add(double weight) noexcept { sum_ += weight; }
    LUMIS_INLINE constexpr void add(const SumOfWeights& other) noexcept { sum_ += other.sum_; }

    [[nodiscard]] LUMIS_INLINE constexpr double value() const noexcept { return sum_; }

  private:
    double sum_ = 0;
};

// Lanes, which it would cost more to convert, as two numbers each, of which the second is what the first rounds off (Dekker
// 1971, "A floating-point technique for extending the available precision"). Unlike where all that was rounded off is added up
// apart, the second stays small when the first has become so large that it takes nothing up.
template <Real R>
    requires(!std::floating_point<R>)
class SumOfWeights<R> {
  public:
    using Value = R;

    LUMIS_INLINE void add(const R& weight, const R& rest = scalar_of<R>(0)) noexcept {
        // Knuth's TwoSum: total + error == sum_ + weight exactly.
        const R total = real::rounded(R(sum_ + weight)), added = real::rounded(R(total - sum_));
        const R kept = real::rounded(R(total - added));
        const R error = real::rounded(R(real::rounded(R(sum_ - kept)) + real::rounded(R(weight - added))));
        const R low = real::rounded(R(error + real::rounded(R(rest_ + rest))));
        // Dekker's Fast2Sum: total is the larger.
        sum_ = real::rounded(R(total + low));
        rest_ = real::rounded(R(low - real::rounded(R(sum_ - total))));
    }
    LUMIS_INLINE void add(const SumOfWeights& other) noexcept { add(other.sum_, other.rest_); }

    [[nodiscard]] LUMIS_INLINE R value() const noexcept { return sum_; }

  private:
    R sum_ = scalar_of<R>(0), rest_ = scalar_of<R>(0);
};

}  // namespace lumis::LUMIS_ISA::detail
