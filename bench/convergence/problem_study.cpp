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

// The combinations shown first: of a family by weights and counts only these; what is none of it always.
constexpr std::array<std::string_view, 4> headlines{"balance", "power", "one-sample", "average"};
bool is_headline(const Competitor& competitor) {
    const std::string& model = competitor.recipe.model;
    return (model != "multi-sample" && model != "one-sample") || std::ranges::count(headlines, competitor.name) > 0;
}

struct Timed {
    double cpu_seconds, wall_seconds;
};

// Nothing but estimation lies between the two readings of the clocks.
Timed run(const Competitor& competitor, std::span<double> sums, std::int64_t count, RandomNumbers uniforms) {
    const auto start = std::chrono::steady_clock::now();
    const tracer::ThreadClock clock;
    competitor.run(sums, count, uniforms);
    const double cpu_seconds = clock.seconds();
    return {cpu_seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

// Estimates in a piece, so that a run takes `seconds`; finding out warms the machine up as well.
std::int64_t affordable_count(const Competitor& competitor, double seconds) {
    std::vector<double> sums(pieces);
    for (std::int64_t count = 1;; count *= 2) {
        const double taken = run(competitor, sums, count, RandomNumbers{0}).cpu_seconds;
        if (taken < std::min(seconds / 4, 1e-3)) continue;
        return std::max<std::int64_t>(1, std::llround(static_cast<double>(count) * seconds / taken));
    }
}

// How many of the run's estimates are not finite. The timed loop keeps sums alone; where one of them is spoilt, the run is
// made once more, estimate by estimate.
std::int64_t count_not_finite(const Competitor& competitor, std::span<const double> sums, std::int64_t count,
                              RandomNumbers uniforms) {
    const auto is_finite = [](double value) { return std::isfinite(value); };
    if (std::ranges::all_of(sums, is_finite)) return 0;
    std::vector<double> estimates(sums.size());
    std::int64_t found = 0;
    for (std::int64_t i = 0; i < count; ++i) {
        competitor.run(estimates, 1, uniforms);
        found += std::ranges::count_if(estimates, std::not_fn(is_finite));
    }
    return found;
}

// The errors of one seed's run, and of the shorter runs that it consists of.
std::vector<Measurement> measurements(std::vector<double> sums, std::int64_t count, const Timed& time, double answer) {
    std::vector<Measurement> result;
    for (int length = 0; length < lengths; ++length) {
        if (length > 0) {
            for (std::size_t i = 0; i < sums.size() / ratio_of_lengths; ++i) {
                const auto first = sums.begin() + static_cast<std::ptrdiff_t>(i * ratio_of_lengths);
                sums[i] = first[0] + first[1] + first[2] + first[3];
            }
            sums.resize(sums.size() / ratio_of_lengths);
            count *= ratio_of_lengths;
        }
        Moments squares;
        for (const double sum : sums) {
            const double error = sum / static_cast<double>(count) - answer;
            squares.add(error * error);
        }
        const double part = 1 / static_cast<double>(sums.size());
        result.push_back(
            {part * time.cpu_seconds, part * time.wall_seconds, squares.mean(), squares.mean() / (answer * answer)});
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
    std::vector<std::int64_t> counts;
    std::vector<std::vector<double>> means(problem.competitors.size());
    std::vector<std::int64_t> not_finite(problem.competitors.size());
    for (const Competitor& competitor : problem.competitors) {
        counts.push_back(affordable_count(competitor, seconds));
        Series series;
        series.name = competitor.name;
        series.unbiased = competitor.unbiased;
        series.recipe = competitor.recipe;
        series.headline = is_headline(competitor);
        std::int64_t samples = counts.back(), runs = pieces;
        for (int length = 0; length < lengths; ++length) {
            series.samples.push_back(samples);
            series.runs_per_seed.push_back(runs);
            samples *= ratio_of_lengths;
            runs /= ratio_of_lengths;
        }
        study.series.push_back(std::move(series));
    }
    // All estimators take turns, so that a drift of the machine's speed hits all alike.
    std::vector<double> sums(pieces);
    for (const std::uint64_t seed : seeds) {
        for (std::size_t i = 0; i < study.series.size(); ++i) {
            const Timed time = run(problem.competitors[i], sums, counts[i], RandomNumbers{seed, i});
            study.series[i].runs.push_back(measurements(sums, counts[i], time, answer.value));
            for (const double sum : sums) means[i].push_back(sum / static_cast<double>(counts[i]));
            not_finite[i] += count_not_finite(problem.competitors[i], sums, counts[i], RandomNumbers{seed, i});
        }
    }
    for (std::size_t i = 0; i < study.series.size(); ++i) {
        Pooled& pooled = study.series[i].pooled;
        pooled = pool(means[i], answer.value, answer.error);
        pooled.not_finite = not_finite[i];
        pooled.evaluated = counts[i] * static_cast<std::int64_t>(means[i].size());
    }
    return study;
}

}  // namespace convergence
