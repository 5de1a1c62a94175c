// The chi-square law where charts do not fit: it refines what it expects, or says that it cannot judge. Either way it is
// not the chart that fails a strategy.
#include "broken.hpp"
#include "catch.hpp"
#include <lumis/directions/henyey_greenstein.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace {

// A narrow peak about +z on a broad base, which no chart suits well.
struct Lobe : lumis::HenyeyGreenstein<double> {
    explicit Lobe(double g) : HenyeyGreenstein{{0, 0, -1}, g} {}
};

laws::DirectionChart chart_of_width(double width) {
    return laws::lobe_chart(glm::dvec3{0, 0, 1}, width);
}

laws::LawResult ask(const Lobe& lobe, const laws::Expectation<V>& expected, int seed) {
    laws::ChiSquareOptions options;
    options.seed = static_cast<std::uint64_t>(seed);
    return laws::chi_square(lobe, expected, options);
}

}  // namespace

// 200 seeds at 1 %: 2 failures are expected, and more than 8 come about once in 5,000 times. Many of the cells are thin
// and pooled, of equal expectations.
TEST_CASE("chi-square's false alarms are as rare as stated, whatever the chart", "[laws]") {
    int failed = 0, below_half = 0;
    for (const double width : {0.001, 1e-4}) {
        const Lobe lobe{0.999};
        const auto expected = laws::expectation(laws::density_of(lobe), chart_of_width(width));
        for (int seed = 0; seed < 100; ++seed) {
            const auto law = ask(lobe, expected, seed);
            REQUIRE(law.decided);
            failed += !law.passed;
            below_half += law.number < 0.5;
        }
    }
    CHECK(failed <= 8);
    CHECK(std::abs(below_half - 100) <= 28);  // four standard deviations
}

TEST_CASE("chi-square still sees a narrow lobe that is a little wrong", "[laws]") {
    const Lobe lobe{0.999};
    laws::ChiSquareOptions options;
    options.significance.false_alarm = 1e-3;
    for (const double width : {0.01, 0.001, 1e-4}) {
        const auto chart = chart_of_width(width);
        const auto right = laws::chi_square(lobe, chart, options);
        INFO(width << ": " << right);
        CHECK(right.passed);
        CHECK(laws::integrates(lobe, chart, {.probability = 1.0}).passed);
        const auto expected = laws::expectation(laws::density_of(Lobe{0.9991}), chart);
        const auto law = laws::chi_square(lobe, expected, options);
        INFO(width << ": " << law);
        CHECK_FALSE(law.passed);
        CHECK(law.decided);
    }
}

// A density that alternates too fast for any quadrature: 0 and twice that of the uniform hemisphere.
TEST_CASE("a density that the chart does not resolve is undecided", "[laws]") {
    const auto comb = consistently_broken(
        Uniform{}, [](const V& w, double pdf) { return std::sin(1e7 * w.x) + std::sin(1e7 * w.y) > 0 ? 2 * pdf : 0; });
    const auto expected =
        laws::expectation(laws::density_of(comb), laws::sphere_chart(), 4, 4, laws::Accuracy{1e-6, 2});
    const auto law = laws::chi_square(comb, expected);
    INFO(law);
    CHECK_FALSE(law.passed);
    CHECK_FALSE(law.decided);
    CHECK(law.message.find("the chart does not resolve the density: it integrates to ") == 0);
}

// Which cells are pooled depends on what is expected alone: here 400 equal ones are, in groups of 10.
TEST_CASE("pooling does not look at what was observed", "[laws]") {
    std::vector<std::pair<double, double>> counts;
    for (int i = 0; i < 400; ++i) counts.emplace_back(1.0, i % 2 == 0 ? 0.0 : 2.0);
    const auto pearson = laws::detail::pearson(counts, 10);
    CHECK(pearson.terms == 40);
    CHECK(pearson.statistic == 0);
}
