// CPU time of the calling thread, which other programs on the machine do not lengthen.
#pragma once

#include <ctime>

namespace tracer {

class ThreadClock {
  public:
    [[nodiscard]] double seconds() const noexcept { return now() - start_; }

  private:
    static double now() noexcept {
        std::timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    double start_ = now();
};

}  // namespace tracer
