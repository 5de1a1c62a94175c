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
