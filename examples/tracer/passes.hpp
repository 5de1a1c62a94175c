// The passes of a rendering, added to its film one by one and in order, whichever rank renders them: the image does not depend
// on how many ranks there are.
#pragma once

#include "command_line.hpp"
#include "interruption.hpp"
#include "ranks.hpp"
#include "renderer.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <thread>

namespace tracer {

// The root's view of all passes. Pass p is rendered by rank p % count. Every rank but the root has one pass ahead of it at any
// time: it renders while the root merges, looks at the error and saves.
class Passes {
  public:
    // Begins after the passes that the rendering has.
    Passes(const Ranks& ranks, const Renderer& renderer, const Settings& settings, const Checkpoint& rendering)
        : ranks_{ranks},
          renderer_{renderer},
          settings_{settings},
          pass_samples_{rendering.pass_samples},
          added_{rendering.film.passes()},
          asked_{added_},
          received_{ranks.count() > 1 ? rendering.film.width : 0, rendering.film.height} {}

    // Takes in the passes that nobody waits for any more. The others could not send them otherwise, nor end.
    ~Passes() {
        for (std::uint64_t pass = added_; pass < asked_; ++pass) {
            if (rank_of(pass) != 0) ranks_.receive_pass(rank_of(pass), received_);
        }
    }
    Passes(const Passes&) = delete;
    Passes& operator=(const Passes&) = delete;

    // Samples of a pixel in a pass: only the last has fewer, and those after it none.
    [[nodiscard]] int samples_of(std::uint64_t pass) const {
        const auto before = static_cast<std::int64_t>(pass) * pass_samples_;
        return static_cast<int>(std::clamp<std::int64_t>(settings_.limits.samples - before, 0, pass_samples_));
    }

    // Adds the pass that comes next in a film; nothing if the user interrupts before another rank has sent it. Returns the
    // CPU seconds that it took.
    double add_to(Film& film) {
        const std::uint64_t pass = film.passes();
        const auto round = static_cast<std::uint64_t>(ranks_.count());
        ask_until(pass + round);
        double cpu_seconds = 0;
        if (const int rank = rank_of(pass); rank == 0) {
            cpu_seconds =
                renderer_.add_pass(film, settings_.integrator, settings_.options(), range_of(pass), settings_.seed);
        } else {
            while (!ranks_.has_pass(rank)) {
                if (Interruption::received() != 0) return 0;
                std::this_thread::sleep_for(std::chrono::microseconds{200});
            }
            cpu_seconds = ranks_.receive_pass(rank, received_);
            ask_until(pass + round + 1);
            film.merge(received_);
        }
        added_ = pass + 1;
        return cpu_seconds;
    }

  private:
    [[nodiscard]] int rank_of(std::uint64_t pass) const {
        return static_cast<int>(pass % static_cast<std::uint64_t>(ranks_.count()));
    }

    [[nodiscard]] SampleRange range_of(std::uint64_t pass) const {
        return {static_cast<std::uint32_t>(pass) * static_cast<std::uint32_t>(pass_samples_), samples_of(pass)};
    }

    void ask_until(std::uint64_t end) {
        for (; asked_ < end && samples_of(asked_) > 0; ++asked_) {
            if (rank_of(asked_) != 0) ranks_.send_task(rank_of(asked_), range_of(asked_));
        }
    }

    const Ranks& ranks_;
    const Renderer& renderer_;
    const Settings& settings_;
    int pass_samples_;
    std::uint64_t added_, asked_;  // the next pass to add, and the next to ask for
    Film received_;                // a pass of another rank
};

}  // namespace tracer
