// Resampled estimates in lanes are those of numbers, lane by lane.
#include "assertions.hpp"
#include "catch.hpp"
#include "even_in_lanes.hpp"
#include <lumis/batch/batch.hpp>
#include <lumis/combine/resample.hpp>
#include <lumis/core/lanes.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/lights/area_light.hpp>
#include <lumis/lights/environment_map.hpp>
#include <lumis/lights/light_set.hpp>
#include <lumis/lights/surface_light.hpp>
#include <lumis/microfacets/ggx_reflection.hpp>
#include <lumis/testing/batch.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace {

namespace laws = lumis::testing;
using lumis::choose;
using lumis::resample;
using lumis::take;

template <int N>
void check(const auto& estimator, const auto& f) {
    REQUIRE(estimator.uniforms_per_estimate() == N);
    const auto law = laws::batch_agrees<N>(estimator, f, {.samples = 4'000});
    INFO(law.message);
    CHECK(law.passed);
}

// A target for lanes and numbers: 0 where f is.
template <class T>
struct Upper {
    T exponent;
    template <lumis::Real R>
    [[nodiscard]] R operator()(const glm::vec<3, R>& w) const noexcept {
        return lumis::real::select(w.z > 0, R(w.z + exponent * w.z * w.z), T(0));
    }
};

TEMPLATE_TEST_CASE("estimates in lanes are those of numbers", "[resample][lanes]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const V origin(T(0));
    const lumis::CosineHemisphere<T> cosine;
    const lumis::GgxReflection<T> ggx{glm::normalize(V(1, T(0.5), 1)), glm::vec<2, T>(T(0.3))};
    const lumis::AreaLight square{lumis::Parallelogram<T>{V(-1, -1, T(-0.5)), V(2, 0, 0), V(0, 2, 2)}, origin};
    const Upper<T> f{T(2)}, target{T(0)};

    check<2>(resample(target, take(1, cosine)), f);
    check<4 * 3 - 1>(resample(target, take(4, square)), f);
    check<5 * 3 - 1>(resample(target, take(2, square), take(0, cosine), take(3, ggx)), f);
    check<4 * 3 - 1>(resample(lumis::PairwiseWeights{}, target, take(1, cosine), take(2, square), take(1, ggx)), f);
    check<3 * 4 - 1>(resample(target, 3, choose(0.5, square), choose(0.5, ggx)), f);
    // A colour, and an integrand for numbers alone.
    const auto in_color = [&](const auto& w) {
        using R = std::remove_cvref_t<decltype(w.x)>;
        return glm::vec<3, R>{f(w), R(2 * f(w)), R(T(0))};
    };
    check<4 * 3 - 1>(resample(target, take(2, square), take(2, ggx)), in_color);
    check<4 * 3 - 1>(resample([](const V& w) { return w.z > 0 ? w.z : T(0); }, take(2, square), take(2, ggx)),
                     [](const V& w) { return w.z > 0 ? w.z * w.z : T(0); });

    // Whole samples of lights.
    const auto near = [](const lumis::AnySample auto& s) {
        using R = std::remove_cvref_t<decltype(s.pdf)>;
        return R(T(1)) / (R(T(1)) + lumis::real::lesser(s.distance, T(100)));
    };
    const auto seen = [](const lumis::AnySample auto& s) {
        return lumis::real::lesser(s.distance, T(100)) * s.surface.normal.z;
    };
    const lumis::SurfaceLight panel{lumis::Triangle<T>{V(-1, -1, 2), V(2, -1, 2), V(0, 1, 3)}, origin};
    check<4 * 3 - 1>(resample(near, take(2, panel), take(2, square)), seen);
    const lumis::LightSet set{std::vector{square}, std::vector<T>{T(1)}};
    check<2 * 4 - 1>(resample(near, take(2, set)),
                     [](const lumis::AnySample auto& s) { return lumis::real::lesser(s.distance, T(100)); });
}

using Four = lumis::Lanes<double, 4>;

TEST_CASE("strategies that are made of lanes are resampled", "[resample][lanes]") {
    const Four widths = Four::of_lanes([](auto i) { return 1.0 + static_cast<double>(i); });
    Same source{Four(0.375)};
    const auto target = [](const auto& x) { return x + 1; };
    const auto f = [](const auto& x) { return x * x + 1; };
    const auto estimate = [&](const auto& width, const auto& wide, auto& uniforms) {
        using R = std::remove_cvref_t<decltype(width)>;
        const EvenUpTo<R> own{width}, same{wide};
        return resample(lumis::PairwiseWeights{}, target, take(2, own), take(1, same), take(1, own))
                   .estimate(f, uniforms) +
               resample(target, 3, choose(0.3, own), choose(0.7, same)).estimate(f, uniforms);
    };
    const Four lanes = estimate(widths, Four(5.0), source);
    auto numbers = lumis::uniforms_from<double>([] { return 0.375; });
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(std::abs(lanes[i] / estimate(widths[i], 5.0, numbers) - 1) <= 1e-14);
    }
}

// What an integrand makes of a lane that keeps nothing stays there.
TEST_CASE("a lane without a candidate adds nothing", "[resample][lanes]") {
    const Same source{Four::of_lanes([](auto i) { return i % 2 ? 0.75 : 0.25; })};
    const auto half = resample([](const auto&) { return 1; }, 3, choose(0.5, lumis::CosineHemisphere<double>{}));
    const Four inverse = half.estimate([](const auto& w) { return 1 / (w.z - w.z); }, source);
    for (std::size_t i = 0; i < 4; ++i) CHECK((i % 2 ? inverse[i] == 0 : std::isinf(inverse[i])));
    const auto s = half.sample(source);
    for (std::size_t i = 0; i < 4; ++i) CHECK((s.contribution_weight[i] > 0) == (i % 2 == 0));
}

}  // namespace
