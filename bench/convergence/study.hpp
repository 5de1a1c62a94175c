// The figures of a study: several estimators of one answer, each run with several seeds to growing sample counts, and
// what follows from them: error against run time.
#pragma once

#include "moments.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace convergence {

// One seed at one sample count, against the reference, whose own squared error has been subtracted.
struct Measurement {
    double cpu_seconds, wall_seconds;
    double squared_error, relative_squared_error;
};

// Equal-time image of an estimator.
struct Picture {
    std::string file, error_file;
    int samples;
    double cpu_seconds;
    int fireflies;  // lone pixels far brighter than they should be
};

// How an estimator is composed; what does not apply is empty.
struct Recipe {
    std::string model, heuristic{};
    std::vector<int> counts{};
    std::vector<double> probabilities{};
};

// What all samples of all seeds say together; NaN where one of them is not finite.
struct Pooled {
    double mean{}, standard_error{};  // NaN for an image
    double bias_z{};                  // distance of the mean from the answer, in standard errors of both
    double tail_share{};              // of all squared deviations, what the largest thousandth of them holds
    bool no_hits{};                   // every estimate is 0
    std::int64_t not_finite{};        // samples that are not finite; pixels, for the images of all seeds
    std::int64_t evaluated{};         // how many samples there are, or pixels
};

struct Series {
    std::string name;
    bool unbiased = true;                        // in theory
    std::vector<std::int64_t> samples;           // growing
    std::vector<std::vector<Measurement>> runs;  // by seed, then by sample count
    std::optional<Picture> picture;
    Recipe recipe;
    bool headline = true;   // one of the few that a plot has room for
    bool is_whole = false;  // a run's length decides its efficiency: it is not the sum of shorter ones
    std::vector<std::int64_t> runs_per_seed;  // by sample count: independent runs whose mean a measurement is
    Pooled pooled;

    // Mean over the seeds, at one sample count.
    [[nodiscard]] Moments over_seeds(std::size_t point, double Measurement::*figure) const {
        Moments moments;
        for (const auto& run : runs) moments.add(run[point].*figure);
        return moments;
    }
};

// The test that two renderings of one reference agree, see agreement.hpp.
struct Agreement {
    int block, blocks;  // pixels along the edge of a block, and how many there are
    double worst_z, limit;
};

struct Reference {
    std::string source;
    std::optional<double> value;                       // of an integral
    double squared_error{}, relative_squared_error{};  // its own; 0 for a closed form
    std::string image;                                 // file; empty for an integral
    std::optional<Agreement> agreement;                // of an image
};

// One of two ways to render a scene, see left_out.hpp.
struct Variant {
    Moments seconds_per_sample, relative_squared_error;  // over the seeds
    std::optional<double> instructions_per_sample;
};
struct LeftOut {
    std::vector<std::string> strategies, materials;
    Variant composed, everything;
    double seconds;               // CPU time of each run
    std::string instructions_by;  // how they were counted, or why not
};

struct Study {
    std::string name, group, title, description;
    std::vector<std::string> strategies;  // that its estimators consist of
    int width{}, height{};                // of an image; 0 for an integral
    Reference reference;
    std::vector<Series> series;
    std::vector<std::uint64_t> seeds;
    std::optional<LeftOut> left_out;
};

struct Estimate {
    double value, standard_error;
};

// For two independent means.
[[nodiscard]] Estimate ratio(const Moments& numerator, const Moments& denominator);

// The exponent of relative error over effort: the least-squares slope of log against log, with its error by leaving out
// one seed at a time (the jackknife), or of as many normal errors, whichever is larger. -1/2 is Monte Carlo's: exactly so
// over samples, and over CPU time a little steeper where a run has a cost of its own. What is said of efficiency goes by
// relative errors as well: a few bright pixels rule an absolute one.
enum class Over { CpuTime, Samples };
[[nodiscard]] Estimate slope(const Series& series, Over over = Over::CpuTime);

// Root mean square error at one sample count.
[[nodiscard]] Estimate root_mean_square(const Series& series, std::size_t point);

// The same of the relative error, and its 95 % band: Student's t of the logarithm.
struct Band {
    double value, low, high;
};
[[nodiscard]] Band relative_error(const Series& series, std::size_t point);

// The seeds' relative errors over their root mean square, in order, where efficiency is read off: an outlier shows in the largest.
// NaN where there is no error to go by.
struct Spread {
    double least, lower_quartile, median, upper_quartile, largest;
};
[[nodiscard]] Spread spread(const Series& series);

// |slope + 1/2| over samples may be this many standard errors. Where runs are wholes it may be steeper by any number.
[[nodiscard]] double slope_limit(const Series& series);

struct Rules {
    static constexpr double bias_z_limit = 5, slope_significance = 1e-4;
    // The pixels of an image are not alike: even without outliers, few of them hold more of its error.
    static constexpr double tail_share_limit = 0.2, tail_share_limit_of_images = 0.5;
};

// The part of a sum of squares that its largest thousandth (at least one) holds. 0 if all are 0, NaN if one is not finite.
[[nodiscard]] double tail_share(std::vector<double> squares);

// What pooled runs of one length say; the answer may itself be off by its error.
[[nodiscard]] Pooled pool(std::span<const double> means, double answer, double answer_error);

// What the measurement says about where an estimator converges; the first that fits, see SCHEMA.md.
enum class Verdict { NotFinite, NoHits, Exact, HeavyTails, Plateau, Converges, Unexplained };
[[nodiscard]] Verdict verdict(const Series& series);
[[nodiscard]] std::string_view name(Verdict verdict);

// The effort that takes an estimator to a relative error: of one that converges, from where most runs stand behind it, by
// the slope -1/2; of others, and of wholes, between two measured points, and beyond those by the slope -1/2. One sample is the
// least. Nothing if a plateau is in the way, or the verdict says that nothing is known.
struct Effort {
    double samples, cpu_seconds;
    bool extrapolated;  // beyond the points measured
};
[[nodiscard]] std::optional<Effort> effort_to(const Series& series, double relative_error);

// 1 / (relative squared error x CPU time), in 1/s, where most runs stand behind it: an unbiased estimator has the same at
// every sample count. One that converges elsewhere is judged by its longest run, and so is one whose runs are wholes. NaN where there is no error to go by: of
// what is exact, not finite or without hits, and where the error vanishes in that of the reference.
[[nodiscard]] Estimate efficiency(const Series& series);

// The same over that of the baseline.
[[nodiscard]] Estimate relative_efficiency(const Series& series, const Series& baseline);

// The series called power, or the first whose efficiency is known if power has none.
[[nodiscard]] const Series& baseline(const Study& study);

// Sample counts from 1 to `largest`, each double the one before as nearly as whole numbers allow.
[[nodiscard]] std::vector<std::int64_t> doubling_up_to(std::int64_t largest);

// Told before each run what it will be.
using Progress = std::function<void(const std::string& what)>;

}  // namespace convergence
