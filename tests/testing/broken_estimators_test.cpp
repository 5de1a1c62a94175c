// A law is worth what it refuses: estimators broken on purpose.
#include "broken.hpp"
#include "catch.hpp"
#include "strategies.hpp"
#include <lumis/testing/laws.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

TEST_CASE("unbiasedness refuses", "[laws]") {
    auto uniforms = lumis::Uniforms<std::mt19937_64, double>{std::mt19937_64{1}};
    const auto estimate = [&] { return 2 * uniforms.next<1>().x; };
    const auto fair = laws::unbiased(estimate, 1);
    CHECK(fair.passed);
    CHECK(fair.smallest_bias_seen < 0.002);
    CHECK_FALSE(laws::unbiased([&] { return 1.003 * estimate(); }, 1).passed);
    CHECK_FALSE(laws::unbiased([&] { return 0.997 * estimate(); }, 1).passed);
    bool once = true;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(laws::unbiased([&] { return std::exchange(once, false) ? nan : estimate(); }, 1).passed);
    CHECK(laws::unbiased([] { return 1.0; }, 1).passed);
    CHECK_FALSE(laws::unbiased([] { return 1.0; }, 1.0001).passed);
}

namespace {

// A two-technique estimator written out, with what is easily got wrong left to the caller: the density that weighs, and
// the selection probability that divides.
template <class Weigh>
auto handwritten(const Weigh& weigh, double divisor) {
    return [=](const auto& heuristic, auto& uniforms) {
        const bool first = uniforms.template next<1>().x < 0.2;
        const auto sample =
            first ? Cosine{}.sample(uniforms.template next<2>()) : Uniform{}.sample(uniforms.template next<2>());
        if (!(sample.pdf > 0)) return 0.0;
        const double p = 0.2 * Cosine{}.pdf(sample.value), q = 0.8 * Uniform{}.pdf(sample.value);
        const double selection = std::fmax(first ? 0.2 : 0.8, divisor);
        return weigh(heuristic, first ? p : q, first ? q : p, first) * sample.value.z / (selection * sample.pdf);
    };
}

}  // namespace

TEST_CASE("unbiasedness under every heuristic refuses", "[laws]") {
    const double pi = std::numbers::pi;
    const auto passes = [pi](const auto& estimate) {
        return laws::unbiased_under_every_heuristic<double>(estimate, pi, {20'000}).passed;
    };
    const auto right = [](const auto& h, double own, double other, bool) { return lumis::mis_weight(h, own, other); };
    // In one of the two techniques: swapped in both, weights would still sum to 1.
    const auto swapped = [](const auto& h, double own, double other, bool first) {
        return first ? lumis::mis_weight(h, other, own) : lumis::mis_weight(h, own, other);
    };
    CHECK(passes(handwritten(right, 0)));
    CHECK_FALSE(passes(handwritten(swapped, 0)));
    CHECK_FALSE(passes(handwritten(right, 1)));  // forgot the selection probability

    const auto integrates = [pi](const auto& first, const auto& second) {
        const auto f = [](const V& w) { return std::fmax(w.z, 0); };
        return laws::unbiased_under_every_heuristic(f, pi, laws::factors_of_two, {20'000}, first, second).passed;
    };
    CHECK(integrates(Cosine{}, Uniform{}));
    const auto doubled = consistently_broken(Uniform{}, [](const V&, double pdf) { return 2 * pdf; });
    CHECK_FALSE(integrates(Cosine{}, doubled));
    const auto narrowed = consistently_broken(Uniform{}, [](const V& w, double pdf) { return w.z < 0.3 ? 0 : pdf; });
    CHECK_FALSE(integrates(narrowed, Cosine{}));
    // A light set that forgot how likely it was to select its light.
    using Set = lumis::Mixture<Cosine, Uniform>;
    const Set set{lumis::choose(0.5, Cosine{}), lumis::choose(0.5, Uniform{})};
    CHECK(integrates(Cosine{}, set));
    CHECK_FALSE(integrates(Cosine{}, consistently_broken(set, [](const V&, double pdf) { return pdf / 0.5; })));
}

TEST_CASE("unbiasedness of estimates without variance", "[laws]") {
    const auto ones = [] { return 1.0; };
    const auto right = laws::unbiased(ones, 1);
    CHECK(right.passed);
    CHECK(right.number == 1);
    CHECK(right.message == "all 1000000 estimates are 1, answer 1; off by 0, allowed 8.8817842e-16");
    const auto wrong = laws::unbiased(ones, 1.001, {100});
    CHECK_FALSE(wrong.passed);
    CHECK(wrong.decided);
    CHECK(wrong.number == 0);
    CHECK(wrong.message.find("all 100 estimates are 1, answer 1.001; off by 0.001") == 0);
    CHECK(laws::unbiased(ones, 1.001, {.samples = 100, .answer_error = 0.0011}).passed);
    // What a float estimate rounds is no bias, with variance or without; more is.
    const auto third = [] { return 1.0f / 3; };
    CHECK(laws::unbiased(third, 1 / 3.0, {100}).passed);
    CHECK_FALSE(laws::unbiased(third, 1 / 3.0 + 1e-6, {100}).passed);
    int n = 0;
    CHECK(laws::unbiased([&] { return std::nextafter(1.0f / 3, n++ % 2 == 0 ? 1.0f : 0.0f); }, 1 / 3.0).passed);
}

TEST_CASE("unbiasedness of too few estimates, or too large ones, is undecided", "[laws]") {
    const auto one = laws::unbiased([] { return 1.0; }, 1, {1});
    CHECK_FALSE(one.passed);
    CHECK_FALSE(one.decided);
    double sign = 1;
    const auto huge = laws::unbiased([&] { return 1e308 * (sign = -sign); }, 0, {100});
    CHECK_FALSE(huge.passed);
    CHECK_FALSE(huge.decided);
    CHECK(huge.message.find("no finite standard error") != std::string::npos);
}

TEST_CASE("unbiasedness of colours", "[laws]") {
    auto uniforms = lumis::Uniforms<std::mt19937_64, float>{std::mt19937_64{1}};
    const glm::vec3 albedo{0.2f, 0.5f, 0};
    const auto estimate = [&] { return 2 * uniforms.next<1>().x * albedo; };
    const laws::UnbiasedOptions options{200'000};
    CHECK(laws::unbiased(estimate, glm::dvec3{albedo}, options).passed);
    const auto tinted = laws::unbiased(estimate, glm::vec3{0.2f, 0.505f, 0}, options);
    CHECK_FALSE(tinted.passed);
    CHECK(tinted.message.find("component 1: ") == 0);
    CHECK_FALSE(laws::unbiased(estimate, glm::vec3{0.2f, 0.5f, 1e-6f}, options).passed);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK_FALSE(laws::unbiased([&] { return glm::vec3{0.2f, 0.5f, nan}; }, albedo, options).passed);

    const auto f = [&](const V& w) { return std::fmax(w.z, 0) * glm::dvec3{1, 2, 3}; };
    const auto integrates = [&](const glm::dvec3& answer) {
        return laws::unbiased_under_every_heuristic(f, answer, laws::factors_of_two, {20'000}, Cosine{}, Uniform{});
    };
    CHECK(integrates(std::numbers::pi * glm::dvec3{1, 2, 3}).passed);
    CHECK_FALSE(integrates(std::numbers::pi * glm::dvec3{1, 2, 3.1}).passed);
}

TEST_CASE("two estimators agree, or do not", "[laws]") {
    auto uniforms = lumis::Uniforms<std::mt19937_64, double>{std::mt19937_64{1}};
    const auto square = [&] { return 3 * std::pow(uniforms.next<1>().x, 2); };
    const auto twice = [&] { return 2 * uniforms.next<1>().x; };
    const auto tripled = [&](double factor) { return [=] { return factor * twice() * glm::dvec3{1, 0, 3}; }; };
    const laws::UnbiasedOptions options{100'000};
    const auto right = laws::agreement(square, twice, options);
    INFO(right);
    CHECK(right.passed);
    CHECK(right.smallest_bias_seen < 0.01);
    CHECK_FALSE(laws::agreement(
                    square, [&] { return 1.01 * twice(); }, options)
                    .passed);
    CHECK(laws::agreement(square, [&] { return 1.01 * twice(); }, {100'000, {}, 0.02}).passed);
    CHECK(laws::agreement(tripled(1), tripled(1), options).passed);
    const auto wrong = laws::agreement(tripled(1), tripled(1.02), options);
    CHECK_FALSE(wrong.passed);
    CHECK(wrong.message.find("component ") == 0);
    // Pairs that share their random numbers differ by what they are wrong by.
    double u = 0;
    const auto first = [&] { return 2 * (u = uniforms.next<1>().x); };
    CHECK(laws::agreement(
              first, [&] { return 2 * (1 - u); }, options)
              .passed);
    CHECK_FALSE(laws::agreement(
                    first, [&] { return 2.0001 * u; }, options)
                    .passed);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(laws::agreement(
                    square, [&] { return nan; }, options)
                    .passed);
}

TEST_CASE("a law's message tells what its p-value means, and the law prints it", "[laws]") {
    auto uniforms = lumis::Uniforms<std::mt19937_64, double>{std::mt19937_64{1}};
    const auto law = laws::unbiased([&] { return 2 * uniforms.next<1>().x; }, 1.02, {100'000, {0.01, 1000}});
    const std::string printed = Catch::Detail::stringify(law);
    CAPTURE(printed);
    CHECK(printed.find("failed: mean ") == 0);
    CHECK(printed.find("standard errors; p = ") != std::string::npos);
    CHECK(printed.find("below 1.005") != std::string::npos);
    CHECK(printed.find("a correct strategy fails with probability 0.01 in any of 1000 tests") != std::string::npos);
    CHECK(Catch::Detail::stringify(laws::LawResult{true, 0, "agreed"}) == "passed: agreed");
    CHECK(Catch::Detail::stringify(laws::LawResult{false, 0, "no chart", false}) == "undecided: no chart");
}
