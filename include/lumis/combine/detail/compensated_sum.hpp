// A sum that keeps its digits, however many numbers it has.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

namespace lumis::LUMIS_ISA::detail {

// The sum as two numbers, of which the second is what the first rounds off (Dekker 1971, "A floating-point technique for
// extending the available precision"): as good as in twice the precision, of numbers that are not negative. Unlike where all that
// was rounded off is added up apart, the second stays small when the first has become so large that it takes nothing up. What
// overflows becomes a NaN: a caller keeps it from that.
template <Real R>
class CompensatedSum {
  public:
    LUMIS_INLINE constexpr void add(R next, R rest = scalar_of<R>(0)) noexcept {
        // Knuth's TwoSum: total + error == sum_ + next exactly.
        const R total = real::rounded(R(sum_ + next)), added = real::rounded(R(total - sum_));
        const R kept = real::rounded(R(total - added));
        const R error = real::rounded(R(real::rounded(R(sum_ - kept)) + real::rounded(R(next - added))));
        const R low = real::rounded(R(error + real::rounded(R(rest_ + rest))));
        // Dekker's Fast2Sum: total is the larger.
        sum_ = real::rounded(R(total + low));
        rest_ = real::rounded(R(low - real::rounded(R(sum_ - total))));
    }
    LUMIS_INLINE constexpr void add(const CompensatedSum& other) noexcept { add(other.sum_, other.rest_); }

    [[nodiscard]] LUMIS_INLINE constexpr R value() const noexcept { return sum_; }

  private:
    R sum_ = scalar_of<R>(0), rest_ = scalar_of<R>(0);
};

}  // namespace lumis::LUMIS_ISA::detail
