// Problems, measured with a tiny budget: the one that docs/problems.md shows, and one with a technique that is wrong.
#include "catch.hpp"
#include "one_dimensional.hpp"
#include "problem_study.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <set>

using namespace convergence;

namespace {

Study measure(const Problem& problem, double seconds = 2e-4) {
    return problem_study("test", problem, {1, 2, 3, 4, 5, 6, 7, 8}, seconds, [](const std::string&) {});
}

const Series& series_of(const Study& study, const std::string& name) {
    const auto found = std::ranges::find(study.series, name, &Series::name);
    REQUIRE(found != study.series.end());
    return *found;
}

}  // namespace

TEST_CASE("a file in the folder of problems is found and measured") {
    const auto entries = registered_problems();
    const auto entry = std::ranges::find(entries, "quarter-circle", &Entry::name);
    REQUIRE(entry != entries.end());
    const Study study = measure(entry->make());
    CHECK(study.reference.value == std::numbers::pi / 4);

    // 5 heuristics with three counts and three probabilities, two techniques alone, Sobol's points, and two that learn.
    std::set<std::string> names;
    for (const Series& series : study.series) {
        names.insert(series.name);
        INFO(series.name);
        CHECK(series.unbiased);
        CHECK(std::abs(series.pooled.bias_z) <= 5);
        CHECK(verdict(series) == Verdict::Converges);
        CHECK(series.samples.size() == series.runs.front().size());
        CHECK(series.is_whole == (series.name == "sobol" || series.name == "optimal"));
    }
    CHECK(study.series.size() == 35);
    CHECK(names.size() == 35);
    CHECK(names.contains("power 1:4"));
    CHECK(names.contains("one-sample maximum 0.9"));
    CHECK(series_of(study, "balance 4:1").recipe.counts == std::vector{4, 1});
    CHECK(series_of(study, "one-sample 0.1").recipe.probabilities == std::vector{0.1, 0.9});
}

TEST_CASE("runs that are wholes are measured length by length") {
    // One number: the count of estimates, by which a run is off.
    Problem problem{"test", "Counts", "", Answer{1}};
    problem.compete(
        "counts", true, {"counting"},
        [](std::span<double> sums, std::int64_t count, RandomNumbers& uniforms) {
            const auto n = static_cast<double>(count);
            for (double& sum : sums) sum = n + (uniforms.next<1>().x < 0.5 ? 1 : -1);
        },
        true);
    const Study study = measure(problem);
    const Series& series = study.series.front();
    CHECK(series.samples == std::vector<std::int64_t>{16, 64, 256, 1024});
    for (std::size_t i = 0; i < series.samples.size(); ++i) {
        CHECK(series.runs_per_seed[i] >= 16);
        const double error = std::sqrt(series.over_seeds(i, &Measurement::squared_error).mean());
        CHECK(std::abs(error * static_cast<double>(series.samples[i]) - 1) <= 1e-12);
    }
    CHECK(verdict(series) == Verdict::Converges);  // with a slope of -1
    CHECK(std::abs(slope(series, Over::Samples).value + 1) <= 1e-9);
    CHECK(series.pooled.evaluated == 8 * std::accumulate(series.runs_per_seed.begin(), series.runs_per_seed.end(), 0));
}

TEST_CASE("Sobol's points converge faster than random numbers") {
    const Study study = measure(std::ranges::find(registered_problems(), "quarter-circle", &Entry::name)->make());
    CHECK(slope(series_of(study, "sobol"), Over::Samples).value <= -0.9);
    CHECK(efficiency(series_of(study, "sobol")).value >= 10 * efficiency(series_of(study, "power")).value);
}

TEST_CASE("a technique that converges elsewhere is marked") {
    Problem problem{"test", "Step", "", Answer{Step::integral}};
    const Study study =
        measure(problem.compare(Step{}, Technique{"all", everywhere}, Technique{"blind", above, false}));
    CHECK(verdict(series_of(study, "blind")) == Verdict::Plateau);
    CHECK_FALSE(series_of(study, "blind").unbiased);
    CHECK_FALSE(effort_to(series_of(study, "blind"), 0.01).has_value());
    CHECK(verdict(series_of(study, "power")) == Verdict::Converges);

    // What learns from samples finds weights and counts that no heuristic has: the integrand is 8 and 7.2 times the densities, so
    // that optimal weights leave little of its variance.
    CHECK(verdict(series_of(study, "optimal")) == Verdict::Converges);
    CHECK(efficiency(series_of(study, "optimal")).value >= 100 * efficiency(series_of(study, "balance")).value);
    CHECK(verdict(series_of(study, "allocated")) == Verdict::Converges);
    CHECK(efficiency(series_of(study, "allocated")).value >= 2 * efficiency(series_of(study, "power")).value);
}

TEST_CASE("a density that is wrong by a percent is marked though it is called right") {
    struct Skewed : Interval<double> {
        [[nodiscard]] lumis::Sample<double, double> sample(glm::dvec1 u) const noexcept {
            const auto drawn = Interval::sample(u);
            return {drawn.value, 1.01 * drawn.pdf};
        }
    };
    Problem problem{"test", "Skewed", "", Answer{std::numbers::pi / 4}};
    const Study study = measure(
        problem.alone([](double x) { return std::sqrt(1 - x * x); }, Technique{"skewed", Skewed{{0, 1}}}), 4e-3);
    CHECK(verdict(study.series.front()) == Verdict::Plateau);
}

TEST_CASE("an estimator of any kind competes") {
    // The mean of the square of two uniforms in a row: 1/3.
    Problem problem{"test", "Square", "", Answer{1 / 3.0}};
    problem.compete("pairs", true, {"in pairs"},
                    [](std::span<double> sums, std::int64_t count, RandomNumbers& uniforms) {
                        for (double& sum : sums) {
                            sum = 0;
                            for (std::int64_t i = 0; i < count; ++i) {
                                const glm::dvec2 u = uniforms.next<2>();
                                sum += (u.x * u.x + u.y * u.y) / 2;
                            }
                        }
                    });
    const Study study = measure(problem);
    const Series& series = study.series.front();
    CHECK(series.name == "pairs");
    CHECK(series.recipe.model == "in pairs");
    CHECK(series.headline);
    CHECK(verdict(series) == Verdict::Converges);
}

TEST_CASE("random numbers of different seeds and streams differ and those of one do not") {
    RandomNumbers one{1, 0}, again{1, 0}, other_seed{2, 0}, other_stream{1, 1};
    const auto a = one.next<2>();
    CHECK(a == again.next<2>());
    CHECK(a != other_seed.next<2>());
    CHECK(a != other_stream.next<2>());
    for (int i = 0; i < 1000; ++i) {
        const auto u = one.next<3>();
        CHECK((u.x >= 0 && u.x < 1 && u.z >= 0 && u.z < 1));
    }
}
