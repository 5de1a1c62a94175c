// Sets of lights: the density of the whole set, none and one and very many, and how lights and tables are passed.
#include "catch.hpp"
#include "instrumented.hpp"
#include "irradiance.hpp"
#include <lumis/core/lanes.hpp>
#include <lumis/lumis.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

// A source that yields the same three numbers, or lanes of them.
template <class U>
struct Repeated {
    U u;
    template <int N>
    [[nodiscard]] glm::vec<N, typename U::value_type> next() const {
        glm::vec<N, typename U::value_type> result;
        for (int i = 0; i < N; ++i) result[i] = u[i % 3];
        return result;
    }
};

template <class T>
using SphereLight = lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle>;

template <class T>
SphereLight<T> sphere(double x, double y, double z, double radius) {
    return {{{static_cast<T>(x), static_cast<T>(y), static_cast<T>(z)}, static_cast<T>(radius)}, {T(0), T(0), T(0)}};
}

// Three spheres, of which the first two overlap in the view of the origin.
template <class T>
std::vector<SphereLight<T>> overlapping() {
    return {sphere<T>(0, 0.2, 2, 0.8), sphere<T>(0.5, 0, 3, 1.2), sphere<T>(-2, 1, 1, 0.5)};
}

bool meets(const glm::dvec3& w, const glm::dvec3& center, double radius) {
    return glm::dot(w, center) > 0 && glm::length(glm::cross(w, center)) <= radius;
}

template <class T>
auto table(std::initializer_list<double> weights) {
    std::vector<T> list;
    for (const double weight : weights) list.push_back(static_cast<T>(weight));
    return lumis::AliasTable<T>{list};
}

}  // namespace

TEMPLATE_TEST_CASE("a light set's sample has the density of the whole set", "[light_set]", float, double) {
    using T = TestType;
    const auto lights = overlapping<T>();
    const auto weights = table<T>({1, 2, 0.5});
    const lumis::LightSet set{lights, weights};
    static_assert(lumis::Strategy<decltype(set)>);
    CHECK_FALSE(set.empty());
    auto uniforms = irradiance::uniforms<T>(1);
    int shared = 0;
    for (int i = 0; i < 5000; ++i) {
        const auto sample = set.sample(uniforms.template next<3>());
        REQUIRE(sample.pdf > 0);
        REQUIRE(sample.pdf == set.pdf(sample.value));
        double expected = 0;
        int met = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            expected += double{weights.pdf(k)} * double{lights[k].pdf(sample.value)};
            met += lights[k].pdf(sample.value) > 0;
            CHECK(set.pdf_of(k, sample.value) == weights.pdf(k) * lights[k].pdf(sample.value));
        }
        shared += met == 2;
        REQUIRE(std::abs(double{sample.pdf} / expected - 1) <= 4 * double{std::numeric_limits<T>::epsilon()});
    }
    CHECK(shared > 1000);
    CHECK(set.pdf({T(0), T(0), T(-1)}) == 0);
}

TEMPLATE_TEST_CASE("irradiance from a set of overlapping lights", "[light_set]", float, double) {
    using T = TestType;
    const auto lights = overlapping<T>();
    const lumis::LightSet set{lights, table<T>({1, 2, 0.5})};
    // Each adds its own, as if it were transparent: pi (r / d)^2 cos(omega), all above the horizon.
    const double pi = std::numbers::pi;
    const double parts[] = {0.64 * 2 / std::pow(4.04, 1.5), 1.44 * 3 / std::pow(9.25, 1.5), 0.25 / std::pow(6, 1.5)};
    const double radiance[] = {1, 3, 10};
    double answer = 0;
    for (int k = 0; k < 3; ++k) answer += pi * parts[k] * radiance[k];
    const auto f = [&](const glm::vec<3, T>& w) {
        const glm::dvec3 d{w};
        const double sum = (meets(d, {0, 0.2, 2}, 0.8) ? 1.0 : 0.0) + (meets(d, {0.5, 0, 3}, 1.2) ? 3.0 : 0.0) +
                           (meets(d, {-2, 1, 1}, 0.5) ? 10.0 : 0.0);
        return static_cast<T>(sum) * std::max(w.z, T(0));
    };
    const auto alone = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, set));
    irradiance::check_unbiased<T>(
        "set", [&](auto& uniforms) { return alone.estimate(f, uniforms); }, answer);
    const auto both =
        lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(2, set), lumis::take(1, lumis::CosineHemisphere<T>{}));
    irradiance::check_unbiased<T>(
        "set and BSDF", [&](auto& uniforms) { return both.estimate(f, uniforms); }, answer);
    // What a light draws as its own: selected by sample_one, weighed against another technique's density.
    const lumis::CosineHemisphere<T> cosine;
    const double centers[3][4] = {{0, 0.2, 2, 0.8}, {0.5, 0, 3, 1.2}, {-2, 1, 1, 0.5}};
    const auto next_event = [&](auto& uniforms) {
        const auto [index, sample] = set.sample_one(uniforms.template next<3>());
        double sum = 0;
        if (sample.pdf > 0) {
            sum += radiance[index] * std::max(double{sample.value.z}, 0.0) / double{sample.pdf} *
                   double{lumis::mis_weight(lumis::BalanceHeuristic{}, sample.pdf, cosine.pdf(sample.value))};
        }
        const auto bounce = cosine.sample(uniforms.template next<2>());
        if (!(bounce.pdf > 0)) return sum;
        for (std::size_t k = 0; k < 3; ++k) {
            if (!meets(glm::dvec3{bounce.value}, {centers[k][0], centers[k][1], centers[k][2]}, centers[k][3]))
                continue;
            sum += radiance[k] * pi *
                   double{lumis::mis_weight(lumis::BalanceHeuristic{}, bounce.pdf, set.pdf_of(k, bounce.value))};
        }
        return sum;
    };
    irradiance::check_unbiased<T>("one by one", next_event, answer);
}

TEMPLATE_TEST_CASE("environment and area lights add up", "[light_set]", float, double) {
    using T = TestType;
    const std::vector<T> texels(16 * 8, T(0.5));
    const lumis::EnvironmentMap sky{16, 8, texels};
    const auto lights = overlapping<T>();
    const lumis::LightSet set{lights, table<T>({1, 1, 1})};
    const double pi = std::numbers::pi;
    const double answer =
        pi * (0.64 * 2 / std::pow(4.04, 1.5) + 1.44 * 3 / std::pow(9.25, 1.5) + 0.25 / std::pow(6, 1.5)) + 0.5 * pi;
    const auto f = [&](const glm::vec<3, T>& w) {
        const glm::dvec3 d{w};
        const int met = meets(d, {0, 0.2, 2}, 0.8) + meets(d, {0.5, 0, 3}, 1.2) + meets(d, {-2, 1, 1}, 0.5);
        return (T(0.5) + static_cast<T>(met)) * std::max(w.z, T(0));
    };
    const auto all = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, sky), lumis::take(1, set),
                                         lumis::take(1, lumis::CosineHemisphere<T>{}));
    irradiance::check_unbiased<T>(
        "all", [&](auto& uniforms) { return all.estimate(f, uniforms); }, answer);
}

TEMPLATE_TEST_CASE("light sets without light and of one light", "[light_set]", float, double) {
    using T = TestType;
    const auto lights = overlapping<T>();
    auto uniforms = irradiance::uniforms<T>(2);
    const lumis::LightSet dark{lights, table<T>({0, 0, 0})};
    CHECK(dark.empty());
    const lumis::LightSet second{lights, table<T>({0, 1, 0})};
    const lumis::LightSet single{std::vector<SphereLight<T>>{lights[1]}, std::vector<T>{T(7)}};
    for (int i = 0; i < 1000; ++i) {
        const auto u = uniforms.template next<3>();
        CHECK(dark.sample(u).pdf == 0);
        CHECK(dark.sample_one(u).sample.pdf == 0);
        CHECK(dark.pdf(lights[0].sample({u.y, u.z}).value) == 0);
        const auto expected = lights[1].sample({u.y, u.z});
        for (const auto& sample : {second.sample(u), single.sample(u)}) {
            REQUIRE(sample.value == expected.value);
            REQUIRE(sample.pdf == expected.pdf);
            REQUIRE(sample.distance == expected.distance);
        }
        CHECK(second.sample_one(u).index == 1);
        // A light of weight 0 has no density, not even where it is seen.
        CHECK(second.pdf(lights[2].sample({u.y, u.z}).value) == 0);
    }
    for (const T u : {T(0), T(1)}) CHECK(second.sample({u, u, u}).pdf > 0);
    const lumis::LightSet none{std::vector<SphereLight<T>>{}, std::vector<T>{}};
    CHECK(none.empty());
    CHECK(none.sample({T(0.5), T(0.5), T(0.5)}).pdf == 0);
    CHECK(none.sample_one({T(1), T(0), T(1)}).sample.pdf == 0);
    CHECK(none.pdf({T(0), T(0), T(1)}) == 0);
}

TEMPLATE_TEST_CASE("lights of a set by function and as many as 100000", "[light_set]", float, double) {
    using T = TestType;
    constexpr std::size_t number = 100'000;
    std::vector<T> weights(number);
    for (std::size_t i = 0; i < number; ++i) weights[i] = static_cast<T>(i % 10);
    const lumis::AliasTable<T> selection{weights};
    std::size_t made = 0;
    const auto make = [&](std::size_t i) {
        ++made;
        return sphere<T>(std::cos(static_cast<double>(i)), std::sin(static_cast<double>(i)), 2, 0.01);
    };
    const lumis::LightSet set{make, selection};
    auto uniforms = irradiance::uniforms<T>(3);
    constexpr int samples = 20'000;
    bool right = true;
    std::size_t bright = 0;
    for (int i = 0; i < samples; ++i) {
        const auto [index, sample] = set.sample_one(uniforms.template next<3>());
        right = right && index < number && weights[index] > 0 && sample.pdf > 0;
        right = right && sample.pdf == set.pdf_of(index, sample.value);
        bright += index % 10 == 9;
    }
    CHECK(right);
    CHECK(made == 2 * samples);  // one for the sample and one for pdf_of: constant time
    CHECK(std::abs(static_cast<double>(bright) / samples - 0.2) <= 5 * std::sqrt(0.16 / samples));
    // The whole set's density asks every light that can be selected.
    made = 0;
    const auto sample = set.sample(uniforms.template next<3>());
    CHECK(made == 1 + number / 10 * 9);
    CHECK((sample.pdf > 0 && sample.pdf == set.pdf(sample.value)));
}

TEST_CASE("a light set keeps tables and lights by reference and takes rvalues", "[light_set]") {
    const auto lights = overlapping<float>();
    const auto weights = table<float>({1, 2, 3});
    const lumis::LightSet by_reference{lights, weights};
    static_assert(sizeof(by_reference) == 2 * sizeof(void*), "neither is copied");
    const auto owning = [] { return lumis::LightSet{overlapping<float>(), std::vector<float>{1, 2, 3}}; }();
    const auto moved = [] { return lumis::LightSet{overlapping<float>(), table<float>({1, 2, 3})}; }();
    const glm::vec3 u{0.7f, 0.2f, 0.4f};
    CHECK(by_reference.sample(u).value == owning.sample(u).value);
    CHECK(by_reference.sample(u).pdf == owning.sample(u).pdf);
    CHECK(by_reference.sample(u).pdf == moved.sample(u).pdf);
}

TEST_CASE("a light set refuses other numbers of lights and weights", "[light_set]") {
    const auto lights = overlapping<float>();
    const auto refusal = [&](std::vector<float> weights) {
        try {
            const lumis::LightSet set{lights, weights};
        } catch (const std::invalid_argument& error) {
            return std::string{error.what()};
        }
        return std::string{"accepted"};
    };
    using Catch::Matchers::Contains;
    CHECK_THAT(refusal({1, 2}), Contains("3 lights") && Contains("2 weights"));
    CHECK_THAT(refusal({1, 2, 3, 4}), Contains("3 lights") && Contains("4 weights"));
    CHECK_THAT(refusal({1, -2, 3}), Contains("weight 1 is -2"));
    CHECK_THAT(refusal({}), Contains("3 lights"));
    CHECK(refusal({0, 0, 0}) == "accepted");
}

// Which light stands at the distance, whichever of the set drew the direction.
TEMPLATE_TEST_CASE("a set's sample tells the index of the light that is seen", "[light_set]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    using L = lumis::Lanes<T, 4>;
    using Light = lumis::AreaLight<lumis::Parallelogram<T>>;
    const auto square = [](T half, T height) {
        return Light{{V(-half, -half, height), V(2 * half, 0, 0), V(0, 2 * half, 0)}, V(T(0))};
    };
    const std::vector lights{square(T(2), T(2)), square(T(0.5), T(1)), square(T(4), T(-1))};
    const lumis::LightSet set{lights, std::vector<T>{1, 1, 2}};
    const auto expected = [&](const V& w) { return w.z < 0 ? std::size_t{2} : lights[1].pdf(w) > 0 ? 1 : 0; };
    CountingUniforms<T> uniforms;
    std::array<int, 3> seen{};
    glm::vec<3, L> u;
    for (int i = 0; i < 400; ++i) {
        const auto numbers = uniforms.template next<3>();
        const auto sample = set.sample(numbers);
        REQUIRE(sample.index == expected(sample.value));
        REQUIRE(std::abs(sample.distance - lights[sample.index].distance_along(sample.value)) <= T(1e-5));
        ++seen[sample.index];
        for (int k = 0; k < 3; ++k) u[k].set(static_cast<std::size_t>(i) % 4, numbers[k]);
        if (i % 4 != 3) continue;
        const auto lanes = set.sample(u);
        for (std::size_t lane = 0; lane < 4; ++lane) {
            REQUIRE(lanes.index[lane] == expected(lumis::detail::lane_of(lanes.value, lane)));
        }
    }
    CHECK((seen[0] > 20 && seen[1] > 100 && seen[2] > 150));

    // Through an estimator, for numbers and lane by lane.
    const auto direct = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, set));
    const auto by_index = [](const lumis::IndexedSample<lumis::LightSample<V, T>>& s) { return T(s.index + 1); };
    const auto by_point = [&](const V& w) { return T(expected(w) + 1); };
    CountingUniforms<T> again = uniforms;
    const Repeated<glm::vec<3, L>> lanes{u};
    for (int i = 0; i < 20; ++i) REQUIRE(direct.estimate(by_index, uniforms) == direct.estimate(by_point, again));
    for (std::size_t i = 0; i < 4; ++i)
        CHECK(direct.estimate(by_index, lanes)[i] == direct.estimate(by_point, lanes)[i]);
}

// 1 for a light of the set that is hidden, 10 for its second, 0 for other samples: as the index tells, or as is expected.
template <class T>
struct IndexSeen {
    using V = glm::vec<3, T>;
    bool expected;

    T operator()(const lumis::IndexedSample<lumis::LightSample<V, T>>& s) const {
        if (expected) return s.value.z > 0 ? T(1) : T(10);
        return s.index == lumis::no_light ? T(1) : s.index == 1 ? T(10) : T(0);
    }
    T operator()(const lumis::LightSample<V, T>&) const { return 0; }
    T operator()(const lumis::SurfaceLightSample<V, T>&) const { return 0; }
};

// A light that is none of the set stands before all of its upper lights, and before no other.
TEMPLATE_TEST_CASE("a set's light behind another light is not the one that is seen", "[light_set]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    using L = lumis::Lanes<T, 4>;
    const auto parallelogram = [](T half, T height) {
        return lumis::Parallelogram<T>{V(-half, -half, height), V(2 * half, 0, 0), V(0, 2 * half, 0)};
    };
    const std::vector lights{lumis::AreaLight{parallelogram(T(2), T(2)), V(T(0))},
                             lumis::AreaLight{parallelogram(T(2), T(-2)), V(T(0))}};
    const lumis::LightSet set{lights, std::vector<T>{1, 1}};
    const IndexSeen<T> told{false}, expected{true};
    const auto check = [&](const auto& in_front) {
        const auto both =
            lumis::multi_sample(lumis::EqualWeights{}, lumis::take(1, set), lumis::take(1, std::cref(in_front)));
        CountingUniforms<T> uniforms, again;
        for (int i = 0; i < 50; ++i) REQUIRE(both.estimate(told, uniforms) == both.estimate(expected, again));
        glm::vec<3, L> u;
        for (int k = 0; k < 3; ++k) {
            for (std::size_t lane = 0; lane < 4; ++lane) {
                u[k].set(lane, uniforms.template next<3>()[k]);
            }
        }
        const Repeated<glm::vec<3, L>> lanes{u};
        const auto found = both.estimate(told, lanes), wanted = both.estimate(expected, lanes);
        for (std::size_t lane = 0; lane < 4; ++lane) CHECK(found[lane] == wanted[lane]);
    };
    check(lumis::AreaLight{parallelogram(T(1.5), T(1)), V(T(0))});
    check(lumis::SurfaceLight{parallelogram(T(1.5), T(1)), V(T(0))});
}
