// The law of the Jacobian judges by steps whose error it knows: what it refuses, what it lets pass, and where it does not
// judge.
#include "broken.hpp"
#include "catch.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <string>

namespace {

// The textbook's power cosine: 1 - cos(theta) is a difference, so that float samples are noisy near the pole.
template <class T>
struct NoisyPowerCosine {
    using Scalar = T;
    using Point = lumis::Direction<T>;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;

    T n;

    lumis::Sample<Point, T> sample(glm::vec<2, T> u) const noexcept {
        const T cos_theta = std::pow(1 - u.x, 1 / (n + 1));
        const Point w = lumis::direction_at(1 - cos_theta, u.y);
        return {w, pdf(w)};
    }
    T pdf(const Point& w) const noexcept {
        return w.z > 0 ? (n + 1) * std::numbers::inv_pi_v<T> / 2 * std::pow(w.z, n) : T(0);
    }
};

// A density of 4/3 up to where u is `kink`, of 8/3 beyond.
template <class T>
struct Kinked {
    using Scalar = T;
    using Point = T;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    T kink;

    lumis::Sample<T, T> sample(glm::vec<1, T> u) const noexcept {
        const T beyond = u.x - kink, x = T(0.5) + beyond * (beyond < 0 ? T(0.75) : T(0.375));
        return {x, pdf(x)};
    }
    T pdf(T x) const noexcept { return x < T(0.5) ? 1 / T(0.75) : 1 / T(0.375); }
};

// Even over [0, 1], but for its density a little too high in one of the cells.
struct Notched {
    using Scalar = double;
    using Point = double;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    lumis::Sample<double, double> sample(glm::dvec1 u) const noexcept { return {u.x, pdf(u.x)}; }
    double pdf(double x) const noexcept { return x < 0 || x > 1 ? 0 : x > 0.5 && x < 0.625 ? 1.01 : 1; }
};

}  // namespace

TEMPLATE_TEST_CASE("rounding is not taken for a wrong Jacobian", "[laws]", float, double) {
    using T = TestType;
    for (const double n : {1.0, 10.0, 100.0, 1000.0, 1e4, 1e5}) {
        const auto law = laws::jacobian(NoisyPowerCosine<T>{static_cast<T>(n)});
        INFO(n << ": " << law);
        CHECK((law.passed || !law.decided));
        if (std::same_as<T, double> || n <= 100) CHECK(law.passed);
        CHECK(law.number <= (std::same_as<T, double> ? 1e-7 : 5e-3));  // half of the tolerance
    }
}

TEMPLATE_TEST_CASE("a wrong constant is told from a wrong formula", "[laws]", float, double) {
    using T = TestType;
    using Direction = glm::vec<3, T>;
    const auto doubled = laws::jacobian(
        consistently_broken(lumis::CosineHemisphere<T>{}, [](const Direction&, T pdf) { return 2 * pdf; }));
    INFO(doubled);
    CHECK_FALSE(doubled.passed);
    CHECK(doubled.decided);
    CHECK(doubled.message.find("off at 256 of 256 points, by the same factor 2 at all 256") != std::string::npos);
    const auto bent = laws::jacobian(
        consistently_broken(lumis::CosineHemisphere<T>{}, [](const Direction& w, T pdf) { return pdf * w.z; }));
    INFO(bent);
    CHECK_FALSE(bent.passed);
    CHECK(bent.message.find("by factors from 0.") != std::string::npos);
    const auto notched = laws::jacobian(Notched{});
    INFO(notched);
    CHECK_FALSE(notched.passed);
    CHECK(notched.message.find("off at 2 of 16 points") != std::string::npos);
}

// Kinks lie closer to some of the points than the narrowest step.
TEMPLATE_TEST_CASE("kinks are passed over, however close by", "[laws]", float, double) {
    using T = TestType;
    const double point = (5 + 0.381966) / 16;
    for (const double gap : {0.0, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3}) {
        const auto law = laws::jacobian(Kinked<T>{static_cast<T>(point + gap)});
        INFO(gap << ": " << law);
        CHECK(law.passed);
    }
}

// Steps instead of a map, or a lobe that a float direction cannot hold: there is nothing to compare.
TEST_CASE("where there are no differences the law does not judge", "[laws]") {
    const auto stepped = [](auto sample) {
        sample.value = glm::normalize(glm::round(sample.value * 1000.0));
        return sample;
    };
    const auto steps = laws::jacobian(Broken{Uniform{}, stepped, same_pdf});
    INFO(steps);
    CHECK_FALSE(steps.passed);
    CHECK_FALSE(steps.decided);
    const auto narrow = laws::jacobian(NoisyPowerCosine<float>{1e6f});
    INFO(narrow);
    CHECK_FALSE(narrow.passed);
    CHECK_FALSE(narrow.decided);
    CHECK(narrow.message.find("in double") != std::string::npos);
}
