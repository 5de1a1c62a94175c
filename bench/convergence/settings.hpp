// What a run of the program is asked to do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace convergence {

struct Settings {
    std::filesystem::path output = "report";
    std::vector<std::uint64_t> seeds;
    double seconds = 0.25;
    int width = 240;
    int reference_samples = 128;
    int threads = 1;
    std::string environment;
    std::vector<std::string> problems;  // none: all
    bool all_scenes = false;            // not only those that the demo has time for
    bool page = true;

    // What asks for the same measurement, but for the place of its results.
    [[nodiscard]] std::string arguments() const;

    // An integral is one number where an image is thousands: it is run for less, in more estimators.
    [[nodiscard]] double seconds_of_integrals() const { return seconds / 200; }
};

}  // namespace convergence
