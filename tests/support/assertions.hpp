// Stands before every other header of the tests: a failed assertion of Lumis ends the program, as assert does, unless a
// test has asked for it and counts it.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <utility>

// While one lives, assertions that fail on this thread are counted.
class CaughtAssertions {
  public:
    CaughtAssertions() noexcept : outer_{std::exchange(innermost, this)} {}
    ~CaughtAssertions() { innermost = outer_; }
    CaughtAssertions(const CaughtAssertions&) = delete;
    CaughtAssertions& operator=(const CaughtAssertions&) = delete;

    [[nodiscard]] int count() const noexcept { return count_; }

    static void failed(const char* condition) noexcept {
        if (innermost == nullptr) {
            std::fprintf(stderr, "assertion failed: %s\n", condition);
            std::abort();
        }
        ++innermost->count_;
    }

  private:
    inline static thread_local CaughtAssertions* innermost = nullptr;
    CaughtAssertions* outer_;
    int count_ = 0;
};

#define LUMIS_ASSERT(condition) \
    (static_cast<bool>(condition) ? static_cast<void>(0) : CaughtAssertions::failed(#condition))
