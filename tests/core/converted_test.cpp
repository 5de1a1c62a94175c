// What concepts call convertible is converted: points, densities and uniforms of other types than a strategy names.
#include "catch.hpp"
#include <lumis/combine/in_frame.hpp>
#include <lumis/combine/mixture.hpp>
#include <lumis/combine/multi_sample.hpp>
#include <lumis/combine/one_sample.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/lights/light_set.hpp>

#include <array>
#include <cstddef>
#include <numbers>
#include <random>
#include <span>
#include <type_traits>
#include <vector>

namespace {

// Works in double, whatever its users work in.
struct CosineInDouble {
    using Scalar = float;
    using Point = glm::vec3;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;

    [[nodiscard]] lumis::Sample<glm::dvec3, double> sample(glm::vec2 u) const noexcept {
        return lumis::CosineHemisphere<double>{}.sample(glm::dvec2{u});
    }
    [[nodiscard]] double pdf(const glm::vec3& w) const noexcept { return w.z > 0 ? w.z * std::numbers::inv_pi : 0; }
};
static_assert(lumis::Strategy<CosineInDouble>);

// A host's sampler that yields doubles.
struct DoubleUniforms {
    lumis::Uniforms<std::mt19937_64, double> source{std::mt19937_64{1}};

    template <int N>
    [[nodiscard]] glm::vec<N, double> next() {
        return source.next<N>();
    }
};
static_assert(lumis::UniformSource<DoubleUniforms, float>);

// A heuristic that works in double as well.
struct BalanceInDouble {
    [[nodiscard]] double operator()(std::size_t own, std::span<const float> densities) const noexcept {
        double sum = 0;
        for (const float density : densities) sum += density;
        return sum > 0 ? densities[own] / sum : 0;
    }
};
static_assert(lumis::Heuristic<BalanceInDouble, float>);

}  // namespace

TEST_CASE("strategies, sources and heuristics that work in another precision", "[converted]") {
    using namespace lumis;
    const CosineInDouble strategy;
    const CosineHemisphere<float> cosine;
    DoubleUniforms uniforms;
    const auto cos_theta = [](const glm::vec3& w) { return w.z; };
    const auto of_sample = [](const AnySample auto& s) {
        static_assert(std::is_same_v<decltype(s.value), glm::vec3> && std::is_same_v<decltype(s.pdf), float>);
        return s.value.z;
    };
    // Both densities are the integrand but for a factor: every estimate is right.
    const auto check = [&](const auto& estimator) {
        for (int i = 0; i < 100; ++i) {
            const auto estimate = estimator.estimate(cos_theta, uniforms);
            static_assert(std::is_same_v<decltype(estimate), const float>);
            CHECK(estimate == Approx(std::numbers::pi));
            CHECK(estimator.estimate(of_sample, uniforms) == Approx(std::numbers::pi));
        }
    };
    check(multi_sample(BalanceHeuristic{}, take(1, strategy)));
    check(multi_sample(BalanceInDouble{}, take(1, strategy), take(2, cosine)));
    check(one_sample(PowerHeuristic{}, choose(0.5, strategy), choose(0.5, cosine)));
    const Mixture mixture{choose(0.25, strategy), choose(0.75, cosine)};
    static_assert(std::is_same_v<decltype(mixture.pdf({})), float>);
    check(multi_sample(BalanceHeuristic{}, take(1, mixture)));
    const std::vector lights{strategy, strategy};
    const LightSet set{lights, std::vector{1.0f, 2.0f}};
    static_assert(std::is_same_v<decltype(set.pdf({})), float>);
    check(multi_sample(BalanceHeuristic{}, take(1, set), take(1, cosine)));
    const auto framed = in_frame(Frame{glm::vec3{0, 0, 1}}, strategy);
    static_assert(std::is_same_v<decltype(framed.pdf(glm::vec3{})), float>);
    check(multi_sample(BalanceHeuristic{}, take(1, framed)));
    CHECK(mis_weight(BalanceInDouble{}, 1.0f, 3.0f) == 0.25f);
}
