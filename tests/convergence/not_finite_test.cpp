// What is not finite is never exact, fast or left out: problems that yield NaN, infinity or nothing, end to end.
#include "catch.hpp"
#include "moments.hpp"
#include "one_dimensional.hpp"
#include "problem_study.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

using namespace convergence;

namespace {

constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();

Study measure(const Problem& problem) {
    return problem_study("test", problem, {1, 2, 3, 4}, 2e-4, [](const std::string&) {});
}

// x over [0, 1), but for `value` in [0.25, 0.5).
Study spoilt(double value) {
    Problem problem{"test", "Spoilt", "", Answer{0.5}};
    return measure(problem.compare([=](double x) { return x >= 0.25 && x < 0.5 ? value : x; },
                                   Technique{"uniform", everywhere},
                                   Technique{"right half", Interval<double>{0.5, 1}}));
}

}  // namespace

TEST_CASE("moments of which one is missing are unknown, and so are those of nothing") {
    Moments moments;
    CHECK(std::isnan(moments.mean()));
    moments.add(1);
    moments.add(3);
    CHECK(moments.mean() == 2);
    CHECK(moments.variance() == 2);
    for (const double spoiler : {quiet_nan, infinity, -infinity}) {
        Moments other = moments;
        other.add(spoiler);
        CHECK(std::isnan(other.mean()));
        CHECK(std::isnan(other.variance()));
        CHECK(std::isnan(other.standard_error()));
        CHECK(other.rejected() == 1);
    }
}

TEST_CASE("an integrand that is not finite in places has no efficiency and no time to an error") {
    for (const double value : {quiet_nan, infinity, -infinity}) {
        const Study study = spoilt(value);
        for (const Series& series : study.series) {
            INFO(series.name << " of " << value);
            const Pooled& pooled = series.pooled;
            if (series.name == "right half") {  // never sees it
                CHECK(verdict(series) == Verdict::Plateau);
                CHECK(pooled.not_finite == 0);
                continue;
            }
            CHECK(verdict(series) == Verdict::NotFinite);
            CHECK_FALSE(effort_to(series, 0.01).has_value());
            CHECK(std::isnan(efficiency(series).value));
            CHECK(std::isnan(pooled.mean));
            CHECK(std::isnan(pooled.bias_z));
            CHECK(std::isnan(relative_error(series, 0).value));
        }
        // A quarter of the points is hit; 4096 samples at least, 5 standard errors.
        const Pooled& uniform = study.series.front().pooled;
        const double share = static_cast<double>(uniform.not_finite) / static_cast<double>(uniform.evaluated);
        CHECK(std::abs(share - 0.25) <= 5 * std::sqrt(0.25 * 0.75 / static_cast<double>(uniform.evaluated)));
    }
}

TEST_CASE("a single estimate that is not finite is found") {
    // Hit with a probability of 2e-5 a sample: seldom, but in all runs together.
    Problem problem{"test", "Spoilt", "", Answer{1}};
    const Study study = problem_study(
        "test", problem.alone([](double x) { return x < 2e-5 ? quiet_nan : 1.0; }, Technique{"uniform", everywhere}),
        {1, 2, 3, 4}, 1e-2, [](const std::string&) {});
    const Series& series = study.series.front();
    CHECK(verdict(series) == Verdict::NotFinite);
    CHECK((series.pooled.not_finite > 0 && series.pooled.not_finite < series.pooled.evaluated / 1000));
}

TEST_CASE("sums that overflow are not finite, though each estimate is") {
    Problem problem{"test", "Vast", "", Answer{1.5e308}};
    const Study study = measure(problem.alone([](double) { return 1.5e308; }, Technique{"uniform", everywhere}));
    CHECK(verdict(study.series.front()) == Verdict::NotFinite);
    CHECK(study.series.front().pooled.not_finite == 0);
}

TEST_CASE("an estimator that hits nothing is told apart") {
    Problem problem{"test", "Missed", "", Answer{1}};
    const Study study = measure(problem.alone([](double) { return 0.0; }, Technique{"uniform", everywhere}));
    CHECK(verdict(study.series.front()) == Verdict::NoHits);
    CHECK(std::isnan(efficiency(study.series.front()).value));
}

TEST_CASE("a problem without a measure of error is refused by name") {
    const auto constant = [](double) { return 1.0; };
    for (const Answer& answer : {Answer{0}, Answer{quiet_nan}, Answer{infinity}, Answer{1, quiet_nan}, Answer{1, -1}}) {
        Problem problem{"test", "Unmeasurable", "", answer};
        problem.alone(constant, Technique{"uniform", everywhere});
        CHECK_THROWS_AS(measure(problem), std::runtime_error);
    }
    const Problem empty{"test", "Empty", "", Answer{1}};
    CHECK_THROWS_AS(measure(empty), std::runtime_error);
}
