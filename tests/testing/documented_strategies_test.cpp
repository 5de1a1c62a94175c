// Every law over every strategy that the documentation shows.
#include "catch.hpp"
#include "one_dimensional.hpp"
#include "power_cosine.hpp"
#include <lumis/testing/laws.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace {

namespace laws = lumis::testing;

// The laws that need to know nothing but where the strategy's points and its integrand are.
template <class S, class Point, class F>
void check_laws(const S& strategy, const laws::Chart<Point>& chart, const F& integrand,
                std::optional<double> probability = 1.0) {
    CHECK(laws::agreement(strategy));
    laws::IntegrationOptions options;
    options.probability = probability;
    CHECK(laws::integrates(strategy, chart, options));
    CHECK(laws::covers(strategy, integrand, chart));
    CHECK(laws::chi_square(strategy, chart));
    CHECK(laws::stays_finite(strategy));
    if constexpr (laws::MapsUniforms<S>) CHECK(laws::jacobian(strategy));
    if constexpr (lumis::InvertibleStrategy<S>) CHECK(laws::round_trip(strategy));
}

}  // namespace

TEMPLATE_TEST_CASE("the laws over the guide's own strategy", "[laws]", float, double) {
    using T = TestType;
    const auto above_horizon = [](const glm::dvec3& w) { return w.z > 0; };
    for (const double n : {0.0, 1.0, 10.0, 100.0, 1000.0}) {
        INFO(n);
        const PowerCosine<T> lobe{static_cast<T>(n)};
        // cos^n(theta) falls to 1/e at theta = sqrt(2 / n).
        const double width = n > 1 ? std::sqrt(2 / n) : 2;
        // Where the cosine's power is less than the least number, the density is 0.
        const auto is_representable = [&](const glm::dvec3& w) {
            return above_horizon(w) && std::pow(w.z, n) > double{std::numeric_limits<T>::min()};
        };
        check_laws(lobe, laws::lobe_chart(glm::dvec3{0, 0, 1}, width), is_representable);
    }
}

TEST_CASE("the guide's own strategy draws in float what it draws in double", "[laws]") {
    const auto lobe = []<class T>(double n) { return PowerCosine<T>{static_cast<T>(n)}; };
    CHECK(laws::stability(std::vector{0.0, 1.0, 10.0, 100.0}, lobe, {.value = 1e-5, .pdf = 1e-3, .undecided = 0.01}));
}

TEMPLATE_TEST_CASE("the laws over the one-dimensional strategies", "[laws]", float, double) {
    using T = TestType;
    const auto chart = laws::interval_chart(10);
    check_laws(Interval<T>{0, 1}, chart, laws::everywhere);
    check_laws(Interval<T>{T(0.25), T(0.75)}, chart, [](double x) { return x > 0.25 && x < 0.75; });
    check_laws(Ramp<T>{}, chart, laws::everywhere);
}

TEMPLATE_TEST_CASE("the laws over the normal distribution", "[laws]", float, double) {
    using T = TestType;
    // The line, as the logistic distribution's quantiles of [0, 1]: its tails are heavier.
    const double mean = 0.7, scale = 0.1;
    laws::Chart<double> line;
    line.at = [=](double at, double) -> laws::Chart<double>::Place {
        const double s = std::clamp(at, 1e-12, 1 - 1e-12);
        return {mean + scale * std::log(s / (1 - s)), scale / (s * (1 - s))};
    };
    line.coordinates = [=](double x) -> glm::dvec2 { return {1 / (1 + std::exp((mean - x) / scale)), 0.5}; };
    line.dimensions = 1;
    const auto is_representable = [=](double x) { return std::abs(x - mean) < 12 * scale; };
    check_laws(Gaussian<T>{static_cast<T>(mean), static_cast<T>(scale)}, line, is_representable);
}
