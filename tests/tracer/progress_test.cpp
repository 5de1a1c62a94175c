// When a rendering is said to end.
#include "progress.hpp"

#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace tracer;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("the time left is that of the first limit") {
    // 30 samples in 6 s, after 10 of an earlier run.
    const Reached reached{40, 10, 6, 0.02};
    CHECK(seconds_left({.samples = 100}, reached) == 12);
    CHECK(seconds_left({.seconds = 10}, reached) == 4);
    CHECK(seconds_left({.seconds = 1}, reached) == 0);
    // Half the error takes four times the samples: 120 more.
    CHECK(std::abs(seconds_left({.error = 0.01}, reached) - 24) <= 1e-9);
    CHECK(seconds_left({.error = 0.03}, reached) == 0);
    CHECK(std::abs(seconds_left({.samples = 100, .seconds = 100, .error = 0.01}, reached) - 12) <= 1e-9);
    CHECK(std::abs(seconds_left({.samples = 1000, .seconds = 26, .error = 0.01}, reached) - 20) <= 1e-9);
    // What is not known yet.
    CHECK(seconds_left({.samples = 100}, {10, 10, 0, infinity}) == infinity);
    CHECK(std::isfinite(seconds_left({.error = 0.01}, {40, 10, 6, infinity})));  // by max_samples
}

TEST_CASE("time is told in units of its size") {
    CHECK(duration(0) == "0.0 s");
    CHECK(duration(12.34) == "12.3 s");
    CHECK(duration(245.9) == "4 min 5 s");
    CHECK(duration(9000) == "2 h 30 min");
    CHECK(duration(360000) == "100 h 0 min");
}

TEST_CASE("passes are powers of two, whole packets, and two at least where there are samples enough") {
    for (int samples = 1; samples < 500; ++samples) {
        const int pass = samples_of_pass({.samples = samples});
        CHECK((pass == 16 || pass == 32 || pass == 64));
        if (samples >= 32) CHECK(2 * pass <= samples);
        if (pass < 64) CHECK(samples < 4 * pass);
    }
    CHECK(samples_of_pass({}) == 32);
}

TEST_CASE("an error is looked at before a 32nd more samples are added than it needs") {
    std::uint32_t last = 0;
    double excess = 0;
    for (std::uint32_t passes = 1; passes < 100'000; ++passes) {
        if (is_error_due(passes)) last = passes;
        excess = std::max(excess, static_cast<double>(passes - last) / last);
    }
    CHECK(excess <= 1 / 32.0);
}
