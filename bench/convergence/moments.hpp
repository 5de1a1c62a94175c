// Mean and standard error of figures of which none may be missing. lumis::RunningMoments leaves out what is not finite, and
// counts it; here one such figure makes both NaN, and so does the mean of nothing.
#pragma once

#include <lumis/statistics/running_moments.hpp>

#include <cstdint>
#include <limits>

namespace convergence {

class Moments {
  public:
    void add(double figure) noexcept { moments_.add(figure); }

    [[nodiscard]] double mean() const noexcept { return is_known() ? moments_.mean() : nan; }
    [[nodiscard]] double variance() const noexcept { return is_known() ? moments_.variance() : nan; }
    [[nodiscard]] double standard_error() const noexcept { return is_known() ? moments_.standard_error() : nan; }
    [[nodiscard]] std::uint64_t rejected() const noexcept { return moments_.rejected(); }

  private:
    static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    [[nodiscard]] bool is_known() const noexcept { return moments_.rejected() == 0 && moments_.count() > 0; }

    lumis::RunningMoments<> moments_;
};

}  // namespace convergence
