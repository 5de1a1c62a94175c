#include "assertions.hpp"
#include "catch.hpp"
#include "instrumented.hpp"
#include "one_dimensional.hpp"
#include <lumis/combine/in_frame.hpp>
#include <lumis/combine/mixture.hpp>
#include <lumis/combine/multi_sample.hpp>
#include <lumis/combine/one_sample.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/directions/uniform_hemisphere.hpp>
#include <lumis/lights/area_light.hpp>
#include <lumis/lights/environment_map.hpp>
#include <lumis/lights/light_set.hpp>
#include <lumis/microfacets/perfect_reflection.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

using lumis::choose;
using lumis::take;

namespace {

// Points on a sphere's surface, as densities per area have them: the point's type is that of a direction.
template <class T>
struct SurfacePoints {
    using Scalar = T;
    using Point = glm::vec<3, T>;
    using Measure = lumis::measure::Area;
    static constexpr int dimensions = 2;

    [[nodiscard]] lumis::Sample<Point, T> sample(glm::vec<2, T> u) const noexcept {
        const Point p = lumis::direction_at(2 * u.x, u.y);
        return {p, pdf(p)};
    }
    [[nodiscard]] T pdf(const Point&) const noexcept { return std::numbers::inv_pi_v<T> / 4; }
};

template <class A, class B>
concept InMultiSample = requires(A a, B b) {
    lumis::multi_sample(lumis::BalanceHeuristic{}, take(1, a), take(1, b));
};
template <class A, class B>
concept InOneSample = requires(A a, B b) {
    lumis::one_sample(lumis::BalanceHeuristic{}, choose(0.5, a), choose(0.5, b));
};
template <class A, class B>
concept InMixture = requires(A a, B b) {
    lumis::Mixture{choose(0.5, a), choose(0.5, b)};
};

template <class A, class B>
constexpr bool compose = InMultiSample<A, B>&& InOneSample<A, B>&& InMixture<A, B>;
template <class A, class B>
constexpr bool nowhere = !InMultiSample<A, B> && !InOneSample<A, B> && !InMixture<A, B>;

using Cosine = lumis::CosineHemisphere<float>;
using Uniform = lumis::UniformHemisphere<float>;
using Light = lumis::AreaLight<lumis::Triangle<float>>;
using Mirror = lumis::PerfectReflection<float>;
using InWorld = decltype(lumis::in_frame(std::declval<lumis::Frame<float>>(), Cosine{}));

}  // namespace

TEST_CASE("strategies compose that agree in scalar, point and measure", "[technique]") {
    STATIC_REQUIRE(compose<Cosine, Uniform>);
    STATIC_REQUIRE(compose<InWorld, Light>);
    STATIC_REQUIRE(compose<Light, lumis::EnvironmentMap<float>>);
    STATIC_REQUIRE(compose<SurfacePoints<float>, SurfacePoints<float>>);
    STATIC_REQUIRE(compose<Interval<double>, Gaussian<double>>);
    STATIC_REQUIRE((InMultiSample<Mirror, Cosine> && InOneSample<Mirror, Cosine>));
}

TEST_CASE("strategies that differ in scalar, point or measure do not compose", "[technique]") {
    STATIC_REQUIRE(nowhere<Cosine, lumis::CosineHemisphere<double>>);
    STATIC_REQUIRE(nowhere<Interval<float>, Cosine>);
    STATIC_REQUIRE(nowhere<Cosine, Interval<float>>);
    STATIC_REQUIRE(nowhere<Cosine, SurfacePoints<float>>);
    STATIC_REQUIRE(nowhere<SurfacePoints<float>, Light>);

    STATIC_REQUIRE(lumis::Strategy<SurfacePoints<float>>);
    STATIC_REQUIRE(lumis::SamePoint<SurfacePoints<float>, Light>);
    STATIC_REQUIRE_FALSE(lumis::SameMeasure<SurfacePoints<float>, Light>);
    STATIC_REQUIRE_FALSE(lumis::SameScalar<Cosine, lumis::CosineHemisphere<double>>);
}

namespace {

template <class X>
concept Taken = requires(X x) {
    take(1, x);
};
template <class X>
concept Chosen = requires(X x) {
    choose(0.5, x);
};

}  // namespace

TEST_CASE("only strategies make a technique", "[technique]") {
    STATIC_REQUIRE((Taken<Cosine> && Chosen<Cosine>));
    STATIC_REQUIRE_FALSE((Taken<int> || Chosen<float>));
    STATIC_REQUIRE_FALSE((Taken<lumis::Triangle<float>> || Chosen<lumis::Triangle<float>>));
}

TEST_CASE("a probability takes the strategy's scalar", "[technique]") {
    STATIC_REQUIRE(std::is_same_v<decltype(choose(1, Cosine{}).probability), float>);
    STATIC_REQUIRE(std::is_same_v<decltype(choose(0.5f, Interval<double>{}).probability), double>);
    CHECK(choose(0.25, Cosine{}).probability == 0.25f);
    CHECK(take(7, Cosine{}).count == 7);
}

TEST_CASE("a strategy that owns memory is not copied by composing", "[technique]") {
    using Table = Owning<Interval<double>>;
    Table::Log log;
    const Table table{everywhere, log};
    CountingUniforms<double> uniforms;
    const auto one = [](double) { return 1.0; };

    const auto multi = lumis::multi_sample(lumis::BalanceHeuristic{}, take(1, table), take(1, Ramp<double>{}));
    const auto single = lumis::one_sample(lumis::BalanceHeuristic{}, choose(0.5, Ramp<double>{}), choose(0.5, table));
    const lumis::Mixture mixture{choose(0.5, table), choose(0.5, Ramp<double>{})};
    CHECK(multi.estimate(one, uniforms) > 0);
    CHECK(single.estimate(one, uniforms) > 0);
    CHECK(mixture.pdf(0.5) == 1);
    CHECK(&multi.strategy<0>() == &table);
    CHECK(&single.strategy<1>() == &table);
    CHECK(log.copies == 0);
    CHECK(log.moves == 0);

    // What is small is copied, so that the original may go.
    const Ramp<double> ramp;
    const auto small = lumis::multi_sample(lumis::BalanceHeuristic{}, take(1, ramp));
    CHECK(&small.strategy<0>() != &ramp);

    const auto moved = lumis::multi_sample(lumis::BalanceHeuristic{}, take(1, Table{everywhere, log}));
    const auto chosen = lumis::one_sample(lumis::BalanceHeuristic{}, choose(1, Table{everywhere, log}));
    const lumis::Mixture of_moved{choose(1, Table{everywhere, log})};
    CHECK(moved.estimate(one, uniforms) == 1);
    CHECK(chosen.estimate(one, uniforms) == 1);
    CHECK(of_moved.pdf(0.5) == 1);
    CHECK(log.copies == 0);
    CHECK(log.moves > 0);
}

TEST_CASE("std::cref spares the copy", "[technique]") {
    const Ramp<double> ramp;
    const auto multi = lumis::multi_sample(lumis::BalanceHeuristic{}, take(2, std::cref(ramp)), take(1, everywhere));
    const auto single = lumis::one_sample(lumis::BalanceHeuristic{}, choose(0.5, std::cref(ramp)), choose(0.5, ramp));
    CHECK(&multi.strategy<0>() == &ramp);
    CHECK(&single.strategy<0>() == &ramp);
    CHECK(&single.strategy<1>() != &ramp);
    CHECK(multi.densities(0.5) == std::array{2.0, 1.0});
    CHECK(single.densities(0.5) == std::array{0.5, 0.5});
}

TEST_CASE("what has no share is neither sampled nor evaluated, whatever weighs it", "[technique]") {
    Calls unused;
    const Instrumented left_out{Ramp<double>{}, &unused};
    CountingUniforms<double> uniforms;
    const auto run = [&](const auto& combined) {
        for (int i = 0; i < 100; ++i) {
            REQUIRE(std::abs(combined.estimate([](double) { return 1.0; }, uniforms) - 1) <= 1e-15);
        }
        CHECK(combined.densities(0.5) == std::array{0.0, 1.0, 0.0});
        CHECK(combined.template weight<0>(0.5) == 0);
        CHECK(combined.template weight<1>(0.5) == 1);
        CHECK(combined.template weight<2>(0.5) == 0);
    };
    const auto both_models = [&](const auto& heuristic) {
        run(lumis::multi_sample(heuristic, take(0, left_out), take(1, everywhere), take(0, left_out)));
        run(lumis::one_sample(heuristic, choose(0, left_out), choose(1, everywhere), choose(0, left_out)));
    };
    both_models(lumis::BalanceHeuristic{});
    both_models(lumis::PowerHeuristic{});
    both_models(lumis::PowerHeuristic{3});
    both_models(lumis::MaximumHeuristic{});
    both_models(lumis::CutoffHeuristic{});
    both_models(lumis::EqualWeights{});

    // The same of a mixture's parts and of a set's lights.
    Calls lit;
    const lumis::Mixture mixture{choose(0, left_out), choose(1, everywhere), choose(0, left_out)};
    const lumis::AreaLight light{lumis::Sphere{glm::vec3{0, 0, 3}, 1.0f}, glm::vec3{0}};
    const std::vector lights{Instrumented{light, &unused}, Instrumented{light, &lit}, Instrumented{light, &unused}};
    const lumis::LightSet set{lights, std::vector{0.0f, 2.0f, 0.0f}};
    for (const double u : {0.0, 0.3, 0.7, 1 - 0x1p-53}) {
        CHECK(mixture.sample({u, 0.25}).pdf == 1);
        CHECK(set.sample({static_cast<float>(u), 0.5f, 0.5f}).pdf >= 0);
        CHECK(set.pdf({0, 0, 1}) > 0);
    }
    CHECK(mixture.pdf(0.5) == 1);
    CHECK(lit.sample == 4);
    CHECK(lit.pdf >= 4);
    CHECK(unused.sample == 0);
    CHECK(unused.pdf == 0);
}

TEST_CASE("an environment map is held by reference", "[technique]") {
    const float luminance[] = {1, 2, 3, 4, 5, 6, 7, 8};
    const lumis::EnvironmentMap map{4, 2, luminance};
    const auto held = take(1, map);
    STATIC_REQUIRE(std::is_reference_v<decltype(held.strategy)>);
    CHECK(&held.strategy == &map);
    const auto owned = take(1, lumis::EnvironmentMap{4, 2, luminance});
    STATIC_REQUIRE_FALSE(std::is_reference_v<decltype(owned.strategy)>);
    CHECK(owned.strategy.width() == 4);
}

TEST_CASE("a combination is trivially copyable where its parts are", "[technique]") {
    const lumis::CosineHemisphere<float> cosine;
    const lumis::AreaLight light{lumis::Sphere{glm::vec3{0, 0, 3}, 1.0f}, glm::vec3{0}};
    const lumis::Mixture mixture{choose(0.5, cosine), choose(0.5, light)};
    const auto multi = lumis::multi_sample(lumis::PowerHeuristic{}, take(1, cosine), take(2, light), take(1, mixture));
    const auto one = lumis::one_sample(lumis::BalanceHeuristic{}, choose(0.5, cosine), choose(0.5, std::cref(light)));
    STATIC_REQUIRE(std::is_trivially_copyable_v<decltype(mixture)>);
    STATIC_REQUIRE(std::is_trivially_copyable_v<decltype(multi)>);
    STATIC_REQUIRE(std::is_trivially_copyable_v<decltype(one)>);
    const auto copy = multi;
    CHECK(copy.densities({0, 0, 1}) == multi.densities({0, 0, 1}));
}
