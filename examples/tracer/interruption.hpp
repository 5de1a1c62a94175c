// Ctrl-C asks a program to come to an end; a second one ends it at once.
#pragma once

#include <csignal>

namespace tracer {

class Interruption {
  public:
    // Remembers SIGINT (Ctrl-C), SIGTERM and SIGUSR1 from now on, once. A cluster's scheduler sends the last before time is
    // up; mpirun passes it on, whereas after Ctrl-C it leaves its processes one second.
    static void watch() {
        struct sigaction action {};
        action.sa_handler = [](int signal) { received_ = signal; };
        action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
        for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) sigaction(signal, &action, nullptr);
    }

    // The signal, or 0.
    [[nodiscard]] static int received() noexcept { return received_; }

  private:
    static inline volatile std::sig_atomic_t received_ = 0;
};

}  // namespace tracer
