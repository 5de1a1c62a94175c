// The order in which TBB runs tasks, told to the thread sanitizer, which does not see into a libtbb that is built without it: a
// task begins after the call that makes it, and ends before that call returns. Tasks of one call are in no order. Without
// the sanitizer all this is nothing.
#pragma once

#if defined(__SANITIZE_THREAD__)
#define TRACER_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define TRACER_THREAD_SANITIZER
#endif
#endif

#ifdef TRACER_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace tracer {

class TaskOrder {
  public:
    // Called before anything that the call captured is read; that is why these functions need no object.
    static void task_begins() { acquire(begin_); }
    static void task_ends() { release(end_); }
    static void call_begins() { release(begin_); }
    static void call_ends() { acquire(end_); }

  private:
#ifdef TRACER_THREAD_SANITIZER
    static void release(char& place) {
        __tsan_release(&place);
    }
    static void acquire(char& place) {
        __tsan_acquire(&place);
    }
#else
    static void release(char& /*place*/) {}
    static void acquire(char& /*place*/) {}
#endif

    static inline char begin_{}, end_{};  // of which only the places matter
};

}  // namespace tracer
