#include "problem_study.hpp"

#include "thread_clock.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string_view>

namespace convergence {

namespace {

// A seed's run is cut into 4^4 pieces, whose sums are kept; four pieces make one of the next length.
constexpr int ratio_of_lengths = 4, lengths = 5;
constexpr std::size_t pieces = 256;

// Runs that are wholes have these lengths, in estimates: what a pixel may get. There are at least so many of each for a seed.
constexpr std::array<std::int64_t, 4> whole_lengths{16, 64, 256, 1024};
constexpr std::int64_t fewest_wholes = 16;

// The combinations shown first: of a family by weights and counts only these; what is none of it always.
constexpr std::array<std::string_view, 4> headlines{"balance", "power", "one-sample", "average"};
bool is_headline(const Competitor& competitor) {
    const std::string& model = competitor.recipe.model;
    return competitor.is_whole || (model != "multi-sample" && model != "one-sample") ||
           std::ranges::count(headlines, competitor.name) > 0;
}

struct Timed {
    double cpu_seconds, wall_seconds;
};

// Nothing but estimation lies between the two readings of the clocks.
Timed run(const Competitor& competitor, std::span<double> sums, std::int64_t count, RandomNumbers& uniforms) {
    const auto start = std::chrono::steady_clock::now();
    const tracer::ThreadClock clock;
    competitor.run(sums, count, uniforms);
    const double cpu_seconds = clock.seconds();
    return {cpu_seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

// Calls of run(count) double its count until they take long enough to be timed: the seconds for each of `count`. Finding out
// warms the machine up as well.
double seconds_each(double seconds, const auto& run) {
    for (std::int64_t count = 1;; count *= 2) {
        const double taken = run(count).cpu_seconds;
        if (taken >= std::min(seconds / 2, 1e-3)) return taken / static_cast<double>(count);
    }
}

// Runs of one length: so many of each seed.
struct Length {
    std::int64_t samples, runs;
};

// What a seed's run consists of, so that it takes `seconds`; wholes may take longer, for there are a few of each length.
std::vector<Length> affordable_lengths(const Competitor& competitor, double seconds) {
    const auto at_least = [](std::int64_t least, double count) {
        return std::max(least, static_cast<std::int64_t>(std::llround(count)));
    };
    std::vector<Length> result;
    RandomNumbers uniforms{0};
    std::vector<double> sums(pieces);
    competitor.run(sums, 1, uniforms);  // what is found out once is found out here
    if (competitor.is_whole) {
        for (const std::int64_t samples : whole_lengths) {
            const double each = seconds_each(seconds, [&](std::int64_t runs) {
                sums.resize(static_cast<std::size_t>(runs));
                return run(competitor, sums, samples, uniforms);
            });
            const double share = seconds / static_cast<double>(whole_lengths.size());
            result.push_back({samples, std::min(at_least(fewest_wholes, share / each), std::int64_t{pieces})});
        }
        return result;
    }
    const double each =
        seconds_each(seconds, [&](std::int64_t count) { return run(competitor, sums, count, uniforms); });
    std::int64_t samples = at_least(1, seconds / each);
    for (std::int64_t runs = pieces; runs >= 1; runs /= ratio_of_lengths, samples *= ratio_of_lengths) {
        result.push_back({samples, runs});
    }
    return result;
}

std::int64_t count_not_finite(std::span<const double> values) {
    return std::ranges::count_if(values, [](double value) { return !std::isfinite(value); });
}

// How many of the run's estimates are not finite. The timed loop keeps sums alone; where one of them is spoilt, the run is
// made once more, estimate by estimate. Wholes are counted as one each.
std::int64_t count_not_finite(const Competitor& competitor, std::span<const double> sums, std::int64_t count,
                              RandomNumbers uniforms) {
    const std::int64_t spoilt = count_not_finite(sums);
    if (spoilt == 0 || competitor.is_whole) return spoilt;
    std::vector<double> estimates(sums.size());
    std::int64_t found = 0;
    for (std::int64_t i = 0; i < count; ++i) {
        competitor.run(estimates, 1, uniforms);
        found += count_not_finite(estimates);
    }
    return found;
}

// The mean square error of runs of one length, and the time of one.
Measurement measurement(std::span<const double> sums, std::int64_t count, const Timed& time, double answer) {
    Moments squares;
    for (const double sum : sums) {
        const double error = sum / static_cast<double>(count) - answer;
        squares.add(error * error);
    }
    const double part = 1 / static_cast<double>(sums.size());
    return {part * time.cpu_seconds, part * time.wall_seconds, squares.mean(), squares.mean() / (answer * answer)};
}

// One seed's run of a competitor: a measurement for each length, and the means by which it is judged as a whole.
struct SeedsRun {
    std::vector<Measurement> measurements;
    std::vector<double> means;
    std::int64_t not_finite = 0, evaluated = 0;
};

// Each length by itself. The longest runs are those to be judged by.
SeedsRun run_wholes(const Competitor& competitor, std::span<const Length> lengths_of_runs, std::uint64_t seed,
                    std::uint64_t stream, double answer) {
    SeedsRun result;
    RandomNumbers uniforms{seed, stream};
    for (const auto& [samples, runs] : lengths_of_runs) {
        std::vector<double> sums(static_cast<std::size_t>(runs));
        const Timed time = run(competitor, sums, samples, uniforms);
        result.measurements.push_back(measurement(sums, samples, time, answer));
        result.not_finite += count_not_finite(sums);
        result.evaluated += runs;
        result.means = std::move(sums);
        for (double& mean : result.means) mean /= static_cast<double>(samples);
    }
    return result;
}

// One run, and the shorter runs that it consists of. The shortest are those to be judged by.
SeedsRun run_pieces(const Competitor& competitor, std::int64_t count, std::uint64_t seed, std::uint64_t stream,
                    double answer) {
    SeedsRun result;
    std::vector<double> sums(pieces);
    RandomNumbers uniforms{seed, stream};
    const Timed time = run(competitor, sums, count, uniforms);
    for (const double sum : sums) result.means.push_back(sum / static_cast<double>(count));
    result.not_finite = count_not_finite(competitor, sums, count, RandomNumbers{seed, stream});
    result.evaluated = count * static_cast<std::int64_t>(pieces);
    for (int length = 0; length < lengths; ++length) {
        if (length > 0) {
            for (std::size_t i = 0; i < sums.size() / ratio_of_lengths; ++i) {
                const auto first = sums.begin() + static_cast<std::ptrdiff_t>(i * ratio_of_lengths);
                sums[i] = first[0] + first[1] + first[2] + first[3];
            }
            sums.resize(sums.size() / ratio_of_lengths);
            count *= ratio_of_lengths;
        }
        result.measurements.push_back(measurement(sums, count, time, answer));
    }
    return result;
}

// What the figures are relative to, and compared by.
void check(const std::string& name, const Problem& problem) {
    const Answer& answer = problem.answer;
    if (!std::isfinite(answer.value) || answer.value == 0 || !(answer.error >= 0 && std::isfinite(answer.error))) {
        throw std::runtime_error("problem " + name + ": errors are relative to an answer that is finite and not 0");
    }
    if (problem.competitors.empty()) throw std::runtime_error("problem " + name + ": there is no technique");
}

}  // namespace

Study problem_study(const std::string& name, const Problem& problem, const std::vector<std::uint64_t>& seeds,
                    double seconds, const Progress& progress) {
    check(name, problem);
    Study study;
    study.name = name;
    study.group = problem.group;
    study.title = problem.title;
    study.description = problem.description;
    study.strategies = problem.strategies;
    study.seeds = seeds;
    const Answer& answer = problem.answer;
    study.reference = {answer.source,
                       answer.value,
                       answer.error * answer.error,
                       answer.error * answer.error / (answer.value * answer.value),
                       {},
                       {}};

    progress(name);
    std::vector<std::vector<Length>> runs;
    for (const Competitor& competitor : problem.competitors) {
        runs.push_back(affordable_lengths(competitor, seconds));
        Series series;
        series.name = competitor.name;
        series.unbiased = competitor.unbiased;
        series.is_whole = competitor.is_whole;
        series.recipe = competitor.recipe;
        series.headline = is_headline(competitor);
        for (const Length& length : runs.back()) {
            series.samples.push_back(length.samples);
            series.runs_per_seed.push_back(length.runs);
        }
        study.series.push_back(std::move(series));
    }
    // All estimators take turns, so that a drift of the machine's speed hits all alike.
    std::vector<std::vector<double>> means(study.series.size());
    for (const std::uint64_t seed : seeds) {
        for (std::size_t i = 0; i < study.series.size(); ++i) {
            const Competitor& competitor = problem.competitors[i];
            SeedsRun result = competitor.is_whole
                                  ? run_wholes(competitor, runs[i], seed, i, answer.value)
                                  : run_pieces(competitor, runs[i].front().samples, seed, i, answer.value);
            study.series[i].runs.push_back(std::move(result.measurements));
            means[i].insert(means[i].end(), result.means.begin(), result.means.end());
            study.series[i].pooled.not_finite += result.not_finite;
            study.series[i].pooled.evaluated += result.evaluated;
        }
    }
    for (std::size_t i = 0; i < study.series.size(); ++i) {
        Pooled& pooled = study.series[i].pooled;
        const std::int64_t not_finite = pooled.not_finite, evaluated = pooled.evaluated;
        pooled = pool(means[i], answer.value, answer.error);
        pooled.not_finite = not_finite;
        pooled.evaluated = evaluated;
    }
    return study;
}

}  // namespace convergence
