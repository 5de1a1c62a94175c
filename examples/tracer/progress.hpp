// When a rendering ends, and a line that shows how far it is.
#pragma once

#include "film/film.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

namespace tracer {

// Whichever is reached first.
struct Limits {
    int samples = max_samples;                                 // a pixel
    double seconds = std::numeric_limits<double>::infinity();  // of this run
    double error = 0;                                          // the film's relative error falls below it
};

// Samples of a pixel in each pass but the last, which may have fewer: powers of two, which points of a low-discrepancy sequence
// make the most of, and at least a packet. The error needs two passes, and Ctrl-C waits for the end of one.
[[nodiscard]] inline int samples_of_pass(const Limits& limits) {
    if (limits.samples == max_samples) return 32;
    return static_cast<int>(std::bit_floor(static_cast<unsigned>(std::clamp(limits.samples / 2, 16, 64))));
}

// What a run has reached, which began with some samples of an earlier one.
struct Reached {
    int samples = 0, samples_before = 0;
    double seconds = 0;
    double error = std::numeric_limits<double>::infinity();
};

// Seconds left until the first limit at this run's pace, where an error falls as 1 / sqrt(samples). Infinite if unknown.
[[nodiscard]] inline double seconds_left(const Limits& limits, const Reached& reached) {
    const double samples = reached.samples, done = samples - reached.samples_before;
    const double excess = limits.error > 0 ? reached.error / limits.error : std::numeric_limits<double>::infinity();
    const double needed = std::min<double>(limits.samples, samples * excess * excess);
    const double at_pace =
        done > 0 ? reached.seconds / done * (needed - samples) : std::numeric_limits<double>::infinity();
    return std::max(std::min(at_pace, limits.seconds - reached.seconds), 0.0);
}

// Whether the error is looked at after so many passes: it costs a walk over the film. At 32 passes and more, samples in excess
// of what a limit needs are at most a 32nd.
[[nodiscard]] inline bool is_error_due(std::uint32_t passes) {
    return passes % std::max(passes / 32, 1u) == 0;
}

// "12.3 s", "4 min 5 s", "2 h 30 min".
[[nodiscard]] inline std::string duration(double seconds) {
    char text[64];
    if (seconds < 60) {
        std::snprintf(text, sizeof(text), "%.1f s", seconds);
        return text;
    }
    const double minutes = std::floor(seconds / 60), hours = std::floor(minutes / 60);
    if (hours < 1) {
        std::snprintf(text, sizeof(text), "%.0f min %.0f s", minutes, std::floor(seconds - 60 * minutes));
    } else {
        std::snprintf(text, sizeof(text), "%.0f h %.0f min", hours, minutes - 60 * hours);
    }
    return text;
}

class Progress {
  public:
    Progress(std::string name, const Limits& limits, int samples_before)
        : name_{std::move(name)}, limits_{limits}, samples_before_{samples_before} {}

    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

    // Writes over the last line on stderr, at most ten times a second and when it is done.
    void show(int samples, double error, bool is_done) {
        const double now = seconds();
        if (!is_done && now < shown_ + 0.1) return;
        shown_ = now;
        std::string line = text({samples, samples_before_, now, error});
        const std::size_t length = line.size();
        line.resize(std::max(length, length_), ' ');
        length_ = length;
        std::fprintf(stderr, "\r%s%s", line.c_str(), is_done ? "\n" : "");
    }

  private:
    // "veach, power: 24 of 64 samples a pixel, 3.1 of 60 s, error 2.1 of 1 %, 12.3 s left": what has a limit is "of" it.
    [[nodiscard]] std::string text(const Reached& reached) const {
        char text[64];
        std::string line = name_ + ": " + std::to_string(reached.samples);
        if (limits_.samples < max_samples) line += " of " + std::to_string(limits_.samples);
        line += " samples a pixel, ";
        if (std::isfinite(limits_.seconds)) {
            std::snprintf(text, sizeof(text), "%.1f of %g s", reached.seconds, limits_.seconds);
            line += text;
        } else {
            line += duration(reached.seconds);
        }
        if (std::isfinite(reached.error)) {
            std::snprintf(text, sizeof(text), ", error %.3g", 100 * reached.error);
            line += text;
            if (limits_.error > 0) {
                std::snprintf(text, sizeof(text), " of %g", 100 * limits_.error);
                line += text;
            }
            line += " %";
        }
        const double left = seconds_left(limits_, reached);
        if (std::isfinite(left)) line += ", " + duration(left) + " left";
        return line;
    }

    std::string name_;
    Limits limits_;
    int samples_before_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double shown_ = 0;
    std::size_t length_ = 0;  // of the last line
};

}  // namespace tracer
