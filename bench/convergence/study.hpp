// The figures of a study: several estimators of one answer, each run with several seeds to growing sample counts, and
// what follows from them: error against run time.
#pragma once

#include <lumis/statistics/running_moments.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace convergence {

// One run at one sample count, against the reference, whose own squared error has been subtracted.
struct Measurement {
    double cpu_seconds, wall_seconds;
    double squared_error, relative_squared_error;
};

// Equal-time image of an estimator.
struct Picture {
    std::string file;
    int samples;
    double cpu_seconds;
    int fireflies;  // lone pixels far brighter than they should be
};

struct Series {
    std::string name;
    bool unbiased = true;
    std::vector<std::int64_t> samples;           // growing
    std::vector<std::vector<Measurement>> runs;  // by seed, then by sample count
    std::optional<Picture> picture;

    // Mean over the seeds, at one sample count.
    [[nodiscard]] lumis::RunningMoments<> over_seeds(std::size_t point, double Measurement::*figure) const {
        lumis::RunningMoments<> moments;
        for (const auto& run : runs) moments.add(run[point].*figure);
        return moments;
    }
};

struct Reference {
    std::string source;
    std::optional<double> value;                       // of an integral
    double squared_error{}, relative_squared_error{};  // its own; 0 for a closed form
    std::string image;                                 // file; empty for an integral
};

struct Study {
    std::string name, title, description;
    std::vector<std::string> strategies;  // that its estimators consist of
    int width{}, height{};                // of an image; 0 for an integral
    Reference reference;
    std::vector<Series> series;
    std::vector<std::uint64_t> seeds;
};

struct Estimate {
    double value, standard_error;
};

// The exponent of relative error over CPU time: each seed's least-squares slope of log against log, averaged. -1/2 is
// Monte Carlo's. What is said of efficiency goes by relative errors as well: a few bright pixels rule an absolute one.
[[nodiscard]] Estimate slope(const Series& series);

// Root mean square error at one sample count.
[[nodiscard]] Estimate root_mean_square(const Series& series, std::size_t point);

// 1 / (relative squared error x CPU time) at the last sample count, over that of the baseline.
[[nodiscard]] Estimate relative_efficiency(const Series& series, const Series& baseline);

// The series called power.
[[nodiscard]] const Series& baseline(const Study& study);

// Sample counts from 1 to `largest`, each double the one before as nearly as whole numbers allow.
[[nodiscard]] std::vector<std::int64_t> doubling_up_to(std::int64_t largest);

// Told before each run what it will be.
using Progress = std::function<void(const std::string& what)>;

}  // namespace convergence
