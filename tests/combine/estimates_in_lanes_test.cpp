// Whole estimates in lanes are those of numbers, lane by lane.
#include "catch.hpp"
#include "even_in_lanes.hpp"
#include "instrumented.hpp"
#include "strategies.hpp"
#include <lumis/batch/batch.hpp>
#include <lumis/combine/allocate.hpp>
#include <lumis/lumis.hpp>
#include <lumis/testing/batch.hpp>
#include <lumis/testing/every_heuristic.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <type_traits>
#include <vector>

namespace {

namespace laws = lumis::testing;
using lumis::choose;
using lumis::take;

template <int N>
void check(const auto& estimator, const auto& f, const laws::EstimatesOptions& options = {}) {
    const auto law = laws::batch_agrees<N>(estimator, f, options);
    INFO(law.message);
    CHECK(law.passed);
}

// In both models, with a technique left out and one drawn twice.
template <int D>
void check_models(const auto& first, const auto& second, const auto& f) {
    const lumis::PowerHeuristic power;
    check<2 * D>(lumis::multi_sample(power, take(1, first), take(1, second)), f);
    check<1 + D>(lumis::one_sample(power, choose(0.3, first), choose(0.6, second)), f);
    check<3 * D>(lumis::multi_sample(power, take(1, first), take(0, second), take(2, second)), f);
    check<D>(lumis::multi_sample(power, take(1, first)), f);
    check<D>(lumis::one_sample(power, choose(1, second)), f);
    check<1 + D>(lumis::one_sample(power, choose(0, first), choose(1, second)), f);
}

// An integrand for a Real.
struct Smooth {
    template <lumis::Real R>
    [[nodiscard]] R operator()(const glm::vec<3, R>& w) const noexcept {
        return R(w.z * w.z + 1) + w.x;
    }
    template <lumis::Real R>
    [[nodiscard]] R operator()(const glm::vec<3, R>& w, lumis::delta_t) const noexcept {
        return R(w.z * w.z + 1) + w.x;
    }
};

template <class T>
struct Scene {
    using V = glm::vec<3, T>;
    V wo = glm::normalize(V(1, T(0.5), 1));
    lumis::CosineHemisphere<T> cosine{};
    lumis::GgxReflection<T> ggx{wo, glm::vec<2, T>(T(0.3))};
    lumis::AreaLight<lumis::Parallelogram<T>> square{{V(-1, -1, 2), V(2, 0, 0), V(0, 2, 0)}, V(T(0))};
    lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle> sphere{{V(1, 0, 3), T(1)}, V(T(0))};
};

// Lanes of one number each.
template <class L>
[[nodiscard]] L counting(typename L::Lane first) {
    L lanes{first};
    for (std::size_t i = 0; i < L::size; ++i) lanes.set(i, first + static_cast<typename L::Lane>(i));
    return lanes;
}

// A spectrum of a host, of numbers or lanes.
template <class R>
struct Spectrum {
    R a, b;
    friend Spectrum operator*(const Spectrum& s, R x) { return {s.a * x, s.b * x}; }
    friend Spectrum operator+(const Spectrum& s, const Spectrum& t) { return {s.a + t.a, s.b + t.b}; }
    friend Spectrum select(const lumis::MaskOf<R>& where, const Spectrum& s, const Spectrum& t) {
        return {lumis::real::select(where, s.a, t.a), lumis::real::select(where, s.b, t.b)};
    }
};

}  // namespace

TEMPLATE_TEST_CASE("strategies of one kernel", "[lanes]", float, double) {
    const Scene<TestType> scene;
    laws::for_each_heuristic([&](const auto& heuristic, const char* name) {
        INFO(name);
        check<4>(lumis::multi_sample(heuristic, take(1, scene.ggx), take(1, scene.square)), Smooth{});
        check<3>(lumis::one_sample(heuristic, choose(0.3, scene.ggx), choose(0.6, scene.square)), Smooth{});
    });
    check_models<2>(scene.ggx, scene.square, Smooth{});
    check_models<2>(scene.cosine, scene.sphere, Smooth{});
}

TEMPLATE_TEST_CASE("strategies for numbers alone are called lane by lane", "[lanes]", float, double) {
    using T = TestType;
    const Scene<T> scene;
    Calls calls;
    check_models<2>(Instrumented{scene.ggx, &calls}, scene.square, Smooth{});
    const Instrumented normals{lumis::GgxNdf<T>{glm::vec<2, T>(T(0.4))}, &calls};
    check<4>(lumis::multi_sample(lumis::PowerHeuristic{}, take(1, lumis::Reflected{scene.wo, normals}),
                                 take(1, scene.square)),
             Smooth{});
    const lumis::Frame<T> frame{glm::normalize(glm::vec<3, T>(1, 2, -1))};
    check<4>(
        lumis::multi_sample(lumis::PowerHeuristic{},
                            take(1, lumis::in_frame(frame, Instrumented{scene.cosine, &calls})), take(1, scene.sphere)),
        Smooth{});
}

TEMPLATE_TEST_CASE("mixtures, sets of lights and maps", "[lanes]", float, double) {
    using T = TestType;
    const Scene<T> scene;
    const lumis::Mixture mixture{choose(0.3, scene.ggx), choose(0.5, scene.cosine), choose(0, scene.sphere)};
    check_models<3>(mixture, subjects::LightSet::make<T>()[0].strategy, Smooth{});
    const lumis::Mixture of_lights{choose(0.3, scene.square), choose(0.5, scene.sphere)};
    const auto by_distance = [](const lumis::AnySample auto& sample) { return 1 / (1 + sample.distance); };
    check<6>(lumis::multi_sample(lumis::PowerHeuristic{}, take(1, of_lights), take(1, mixture)), by_distance);
    for (const auto& map : subjects::EnvironmentMap::make<T>()) {
        check<4>(lumis::multi_sample(lumis::PowerHeuristic{}, take(1, std::cref(map.strategy)), take(1, scene.cosine)),
                 Smooth{});
    }
}

TEMPLATE_TEST_CASE("points other than directions", "[lanes]", float, double) {
    using T = TestType;
    const lumis::PiecewiseConstant1D<T> even{std::vector<T>{1, 1}}, steps{std::vector<T>{1, 3, 0, 2}};
    check_models<1>(even, steps, [](const auto& x) { return x * x + 1; });
    const lumis::PiecewiseConstant2D<T> plane{2, 2, std::vector<T>{1, 3, 0, 2}}, flat{1, 1, std::vector<T>{1}};
    check_models<2>(plane, flat, [](const auto& x) { return x.x + x.y * x.y; });
    const lumis::AliasTable<T> table{std::vector<T>{1, 3, 0, 2}}, fair{std::vector<T>{1, 1, 1, 1}};
    check_models<1>(table, fair, [](std::size_t i) { return static_cast<T>(i + 1); });
    check<2>(
        lumis::multi_sample(lumis::BalanceHeuristic{}, take(1, lumis::Mixture{choose(0.5, table), choose(0.5, fair)})),
        [](std::size_t i) { return static_cast<T>(i + 1); });
}

TEMPLATE_TEST_CASE("delta strategies", "[lanes]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const Scene<T> scene;
    const lumis::PointLight<T> lamp{V(1, 2, 3), V(T(0))};
    const lumis::PerfectReflection<T> mirror{scene.wo};
    check<6>(lumis::multi_sample(lumis::PowerHeuristic{}, take(1, mirror), take(1, scene.ggx), take(1, lamp)),
             Smooth{});
    check<3>(lumis::one_sample(lumis::PowerHeuristic{}, choose(0.2, lumis::DirectionalLight<T>{V(0, 0, 1)}),
                               choose(0.3, scene.cosine), choose(0.4, scene.ggx)),
             Smooth{});
}

TEMPLATE_TEST_CASE("integrands of all kinds", "[lanes]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    using L = lumis::NativeLanes<T>;
    const Scene<T> scene;
    const auto direct = lumis::multi_sample(lumis::PowerHeuristic{}, take(1, scene.ggx), take(1, scene.square));
    check<4>(direct, [](const V& w) { return w.z > 0 ? std::sin(w.x) : T(0); });
    check<4>(direct, [](const V& w) { return w * w; });
    check<4>(direct, [](const auto& w) { return w * w; });
    check<4>(direct, [](const lumis::LightSample<V, T>& s) { return V(s.value.z / s.distance); });
    check<4>(direct, [](const lumis::AnySample auto& s) {
        return lumis::Direction<std::remove_cvref_t<decltype(s.pdf)>>(s.value.z / s.distance);
    });
    check<4>(direct, [](const auto&) { return T(2); });
    check<4>(lumis::multi_sample(lumis::PartitionWeights{[](const V& w) { return w.x > 0; }}, take(1, scene.ggx),
                                 take(1, scene.square)),
             Smooth{});

    const Same<L> source{L(T(0.3))};
    const auto spectrum = []<class R>(const glm::vec<3, R>& w) { return Spectrum<R>{w.z, w.x}; };
    const Spectrum<L> lanes = direct.estimate(spectrum, source);
    const L z = direct.estimate([](const auto& w) { return w.z; }, source);
    for (std::size_t i = 0; i < L::size; ++i) CHECK(lanes.a[i] == z[i]);
}

TEMPLATE_TEST_CASE("a lane that draws nothing keeps what an integrand makes of it to itself", "[lanes]", float,
                   double) {
    using T = TestType;
    using L = lumis::NativeLanes<T>;
    // Draws nothing for u above 0.5.
    const auto table = lumis::one_sample(lumis::BalanceHeuristic{}, choose(0.5, lumis::CosineHemisphere<T>{}));
    L u;
    for (std::size_t i = 0; i < L::size; ++i) u.set(i, static_cast<T>(i % 2 ? 0.75 : 0.25));
    const L inverse = table.estimate([](const auto& w) { return 1 / (w.z - w.z); }, Same<L>{u});
    for (std::size_t i = 0; i < L::size; ++i) CHECK((i % 2 ? inverse[i] == 0 : std::isinf(inverse[i])));

    int calls = 0;
    const auto counting_calls = [&](const auto& w) { return ++calls, w.z; };
    CHECK(table.estimate(counting_calls, Same<L>{L(T(0.75))})[0] == 0);
    CHECK(calls == 0);
    CHECK(table.estimate(counting_calls, Same<L>{u})[0] > 0);
    CHECK(calls == 1);
    const auto for_numbers = [&](const glm::vec<3, T>& w) { return ++calls, w.z; };
    CHECK(table.estimate(for_numbers, Same<L>{u})[0] > 0);
    CHECK(calls == 1 + static_cast<int>(L::size / 2));
}

TEMPLATE_TEST_CASE("densities and weights at lanes of points", "[lanes]", float, double) {
    using T = TestType;
    using L = lumis::NativeLanes<T>;
    const Scene<T> scene;
    const lumis::PerfectReflection<T> mirror{scene.wo};
    Calls calls;
    const auto direct =
        lumis::multi_sample(lumis::PowerHeuristic{}, take(1, scene.ggx), take(3, scene.square), take(0, scene.sphere),
                            take(1, mirror), take(1, Instrumented{scene.cosine, &calls}));
    const L x = counting<L>(T(-3)) * T(0.2);
    const lumis::Direction<L> w{x, L(T(0.1)), lumis::real::sqrt(L(T(0.99) - x * x))};
    const auto densities = direct.densities(w);
    const L first = direct.template weight<0>(w), last = direct.template weight<4>(w);
    const auto near = [](T a, T b) { return std::abs(a - b) <= 64 * std::numeric_limits<T>::epsilon() * b; };
    for (std::size_t i = 0; i < L::size; ++i) {
        const lumis::Direction<T> alone{w.x[i], w.y[i], w.z[i]};
        for (std::size_t k = 0; k < 5; ++k) CHECK(near(densities[k][i], direct.densities(alone)[k]));
        CHECK(near(first[i], direct.template weight<0>(alone)));
        CHECK(near(last[i], direct.template weight<4>(alone)));
        const T weight = lumis::mis_weight(lumis::PowerHeuristic{}, densities[0][i], densities[1][i]);
        CHECK(near(lumis::mis_weight(lumis::PowerHeuristic{}, densities[0], densities[1])[i], weight));
    }
}

TEMPLATE_TEST_CASE("weighted samples in lanes are those of each lane", "[lanes][weighted_sample]", float, double) {
    using T = TestType;
    using L = lumis::NativeLanes<T>;
    const Scene<T> scene;
    const auto direct = lumis::multi_sample(lumis::PowerHeuristic{}, take(2, scene.ggx), take(1, scene.square),
                                            take(1, lumis::PerfectReflection<T>{scene.wo}));
    const L u = counting<L>(T(0.25)) / T(2 * L::size), known = counting<L>(T(0));
    const auto lanes = direct.template weighted_sample<0>(Same<L>{u});
    const L weights = lanes.weight(), given = lanes.template weight_given<1>(known), factors = lanes.factor();
    const L mirrored = direct.template weighted_sample<2>(Same<L>{u}).weight();
    const auto near = [](T a, T b) { return std::abs(a - b) <= 1000 * std::numeric_limits<T>::epsilon() * b; };
    for (std::size_t i = 0; i < L::size; ++i) {
        const auto alone = direct.template weighted_sample<0>(Same<T>{u[i]});
        CHECK(near(lanes.density[i], alone.density));
        CHECK(near(weights[i], alone.weight()));
        CHECK(near(given[i], alone.template weight_given<1>(known[i])));
        CHECK(near(factors[i], alone.factor()));
        CHECK(mirrored[i] == 1);
    }
}

TEMPLATE_TEST_CASE("strategies that are made of lanes combine, and each lane has its own", "[lanes]", float, double) {
    using T = TestType;
    using L = lumis::NativeLanes<T>;
    const L width = counting<L>(T(1)), probability = counting<L>(T(0.5)) * T(0.1), u = counting<L>(T(0.25)) / T(9);
    const auto f = [](const auto& x) { return x * x + 1; };
    // Calls estimate(intervals, probability) with those of all lanes, and with those of each.
    const auto check_each = [&](const auto& estimate) {
        const L lanes = estimate(EvenUpTo<L>{width}, EvenUpTo<L>{L(T(2))}, probability, Same<L>{u});
        for (std::size_t i = 0; i < L::size; ++i) {
            const T alone = estimate(EvenUpTo<T>{width[i]}, EvenUpTo<T>{T(2)}, probability[i], Same<T>{u[i]});
            CHECK(std::abs(lanes[i] - alone) <= 8 * std::numeric_limits<T>::epsilon() * alone);
        }
    };
    const lumis::PowerHeuristic power;
    check_each([&](const auto& own, const auto& same, const auto&, const auto& uniforms) {
        return lumis::multi_sample(power, take(2, own), take(1, same)).estimate(f, uniforms);
    });
    check_each([&](const auto& own, const auto& same, const auto& chance, const auto& uniforms) {
        return lumis::one_sample(power, choose(chance, own), choose(1 - chance, same)).estimate(f, uniforms);
    });
    check_each([&](const auto& own, const auto& same, const auto& chance, const auto& uniforms) {
        const lumis::Mixture mixture{choose(chance * T(0.5), own), choose(0.005, same)};  // else nothing
        return lumis::multi_sample(power, take(1, mixture), take(1, same)).estimate(f, uniforms);
    });
}

TEMPLATE_TEST_CASE("moments of lanes are those of each", "[lanes]", float, double) {
    using L = lumis::NativeLanes<TestType>;
    lumis::RunningMoments<TestType> of_lanes, of_each;
    for (int k = 0; k < 5; ++k) {
        L lanes = counting<L>(TestType(k * k));
        if (k == 3) lanes.set(1, std::numeric_limits<TestType>::quiet_NaN());
        of_lanes.add(lanes);
        for (std::size_t i = 0; i < L::size; ++i) of_each.add(lanes[i]);
    }
    CHECK(of_lanes.mean() == of_each.mean());
    CHECK(of_lanes.variance() == of_each.variance());
    CHECK(of_lanes.count() == 5 * L::size - 1);
    CHECK(of_lanes.rejected() == 1);
}

TEST_CASE("pilot rounds in lanes are those of numbers", "[lanes]") {
    using L = lumis::Lanes<double, 4>;
    const Scene<double> scene;
    auto in_lanes = lumis::allocate(lumis::PowerHeuristic{}, take(1, scene.ggx), take(2, scene.cosine));
    auto in_numbers = in_lanes;
    for (int k = 0; k < 6; ++k) {
        const L u = (counting<L>(1) + 4.0 * k) / 25.0;
        const L estimates = in_lanes.add(Smooth{}, Same<L>{u});
        for (std::size_t i = 0; i < L::size; ++i) {
            const double estimate = in_numbers.add(Smooth{}, Same<double>{u[i]});
            CHECK(std::abs(estimates[i] / estimate - 1) <= 1e-12);
        }
    }
    const double variance = in_numbers.forecast().multi_sample_variance({2, 1});
    CHECK(std::abs(in_lanes.forecast().multi_sample_variance({2, 1}) / variance - 1) <= 1e-9);
}
