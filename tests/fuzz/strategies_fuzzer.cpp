// Every strategy, made of any numbers and asked with any numbers: values and densities are finite, densities not negative,
// and what cannot be drawn has density 0. Combinations of them, and the heuristics, likewise.
#include "check.hpp"

// Strategies are made of wrong arguments here, which they assert that they are not given. Where none are given, what is
// asserted holds: heuristics get no NaN from any strategy.
namespace fuzz {

inline bool arguments_are_right = false;

struct RightArguments {
    RightArguments() { arguments_are_right = true; }
    ~RightArguments() { arguments_are_right = false; }
};

}  // namespace fuzz

#define LUMIS_ASSERT(condition) CHECK(!fuzz::arguments_are_right || (condition))
#include <lumis/lumis.hpp>

#include <array>
#include <vector>

namespace {

using fuzz::Input;
using fuzz::is_density;

template <class T>
bool is_finite(const glm::vec<3, T>& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Any numbers, or scaled to unit length, which may have failed.
template <class T>
glm::vec<3, T> any_direction(Input& input) {
    const bool unit = (input.bits<std::uint8_t>() & 1) != 0;
    const auto v = input.numbers<glm::vec<3, T>>();
    return unit ? v / glm::length(v) : v;
}

template <class T>
lumis::Frame<T> any_frame(Input& input) {
    if (input.bits<std::uint8_t>() & 1) return lumis::Frame<T>{any_direction<T>(input)};
    const auto x = any_direction<T>(input), y = any_direction<T>(input), z = any_direction<T>(input);
    return {x, y, z};
}

// Whether what is drawn must have unit length whatever the strategy was made of.
enum class Value { Direction, UnitDirection };

template <class S>
void check(Input& input, const S& strategy, Value value = Value::Direction) {
    using T = typename S::Scalar;
    using U = lumis::UniformsOf<S>;
    for (const U& u : {U(T(0)), U(T(1)), input.uniforms<U>()}) {
        const auto sample = strategy.sample(u);
        CHECK(is_finite(sample.value));
        CHECK(is_density(sample.pdf));
        CHECK(is_density(strategy.pdf(sample.value)));
        if (sample.pdf > 0) {
            if constexpr (requires { sample.distance; }) CHECK(sample.distance >= 0);
            if (value == Value::UnitDirection) CHECK(std::abs(glm::length(sample.value) - 1) <= T(1e-5));
        }
        if constexpr (lumis::InvertibleStrategy<S>) (void)strategy.invert(sample.value);
    }
    const auto x = any_direction<T>(input);
    CHECK(is_density(strategy.pdf(x)));
    if constexpr (lumis::InvertibleStrategy<S>) (void)strategy.invert(x);
}

template <class T, class H>
void check_heuristic(const H& heuristic, std::span<const T> densities, bool sums_to_one) {
    T sum = 0;
    bool any = false;
    for (std::size_t i = 0; i < densities.size(); ++i) {
        const T weight = lumis::mis_weight(heuristic, i, densities);
        CHECK(weight >= 0 && weight <= 1);
        CHECK(densities[i] > 0 || weight == 0);
        sum += weight;
        any |= densities[i] > 0;
    }
    if (sums_to_one) CHECK(any ? std::abs(sum - 1) <= T(1e-4) : sum == 0);
}

template <class T>
void fuzz_heuristics(Input& input) {
    const double parameter = input.number<double>();
    std::vector<T> densities;
    const std::size_t count = 1 + input.bits<std::uint8_t>() % 8;
    while (densities.size() < count) {
        const T density = std::abs(input.number<T>());
        densities.push_back(std::isnan(density) ? T(0) : density);
    }
    const std::span<const T> all{densities};
    {
        const fuzz::RightArguments right;
        check_heuristic(lumis::BalanceHeuristic{}, all, true);
        check_heuristic(lumis::PowerHeuristic{}, all, true);
        check_heuristic(lumis::MaximumHeuristic{}, all, true);
        check_heuristic(lumis::EqualWeights{}, all, true);
    }
    check_heuristic(lumis::PowerHeuristic{parameter}, all, parameter >= 1 && parameter <= 8);
    check_heuristic(lumis::CutoffHeuristic{parameter}, all, true);
}

// Estimates of a bounded integrand: whatever the densities, no NaN.
template <class T, class A, class B>
void check_estimates(Input& input, const A& a, const B& b) {
    const auto f = [](const auto& /*w*/) { return T(1); };
    auto uniforms = lumis::uniforms_from<T>([&] { return input.uniform<T>(); });
    const int n = input.bits<std::uint8_t>() % 4, m = input.bits<std::uint8_t>() % 4;
    const T c = input.uniform<T>();
    const auto estimate = [&](const auto& heuristic) {
        const fuzz::RightArguments right;
        const T many = lumis::multi_sample(heuristic, lumis::take(n, a), lumis::take(m, b)).estimate(f, uniforms);
        const T one = lumis::one_sample(heuristic, lumis::choose(c, a), lumis::choose(1 - c, b)).estimate(f, uniforms);
        CHECK(many >= 0 && one >= 0);
    };
    estimate(lumis::BalanceHeuristic{});
    estimate(lumis::PowerHeuristic{});
    estimate(lumis::MaximumHeuristic{});
    // Weights beyond the largest number are asserted to be none, and count as 0.
    const auto target = [](const glm::vec<3, T>& w) { return w.x * w.x; };
    const auto at_target = [&](const glm::vec<3, T>& w) { return target(w) > 0 ? T(1) : T(0); };
    const T taken = lumis::resample(target, lumis::take(n, a), lumis::take(m, b)).estimate(at_target, uniforms);
    const T chosen = lumis::resample(lumis::PairwiseWeights{}, target, n, lumis::choose(c, a), lumis::choose(1 - c, b))
                         .estimate(at_target, uniforms);
    CHECK(taken >= 0 && chosen >= 0);
    check(input, lumis::Mixture{lumis::choose(c, a), lumis::choose(input.number<T>(), b)});
}

template <class T>
void fuzz_strategies(Input& input, unsigned kind) {
    using V = glm::vec<3, T>;
    const auto numbers = [&] { return input.numbers<V>(); };
    const auto any_alpha = [&] { return input.numbers<glm::vec<2, T>>(); };
    const auto any_triangle = [&] {
        const V a = numbers(), b = numbers(), c = numbers();
        return lumis::Triangle<T>{a, b, c};
    };
    const auto any_parallelogram = [&] {
        const V corner = numbers(), u = numbers(), v = numbers();
        return lumis::Parallelogram<T>{corner, u, v};
    };
    const auto any_sphere = [&] {
        const V center = numbers();
        return lumis::Sphere<T>{center, input.number<T>()};
    };
    const auto light = [&]<class Shape, class Sampling>(const Shape& shape, Sampling) {
        check(input, lumis::AreaLight<Shape, Sampling>{shape, numbers()}, Value::UnitDirection);
    };
    const auto light_by_cosine = [&]<class Shape>(const Shape& shape) {
        const V point = numbers();
        check(input, lumis::AreaLight<Shape, lumis::ByCosine>{shape, point, any_direction<T>(input)},
              Value::UnitDirection);
    };
    switch (kind % 25) {
        case 0:
            return check(input, lumis::UniformSphere<T>{}, Value::UnitDirection);
        case 1:
            return check(input, lumis::UniformHemisphere<T>{}, Value::UnitDirection);
        case 2:
            return check(input, lumis::CosineHemisphere<T>{}, Value::UnitDirection);
        case 3:
            return check(input, lumis::GgxNdf<T>{any_alpha()}, Value::UnitDirection);
        case 4:
            return check(input, lumis::GgxVndf<T>{any_direction<T>(input), any_alpha()}, Value::UnitDirection);
        case 5:
            return check(input, lumis::GgxReflection<T>{any_direction<T>(input), any_alpha()});
        case 6:
            return check(input, lumis::GgxBoundedReflection<T>{any_direction<T>(input), any_alpha()});
        case 7:
            return check(input, lumis::Reflected{any_direction<T>(input), lumis::CosineHemisphere<T>{}});
        case 8: {
            const V wo = any_direction<T>(input);
            const T eta = input.number<T>();
            check(input, lumis::GgxDielectric<T>{wo, any_alpha(), eta});
            check(input, lumis::SmoothDielectric<T>{wo, eta});
            return check(input, lumis::PerfectReflection<T>{wo});
        }
        case 9:
            return check(input, lumis::PointLight<T>{numbers(), numbers()}, Value::UnitDirection);
        case 10:
            return check(input, lumis::DirectionalLight<T>{any_direction<T>(input)});
        case 11:
            return light(any_triangle(), lumis::ByArea{});
        case 12:
            return light(any_parallelogram(), lumis::ByArea{});
        case 13: {
            const V center = numbers(), normal = numbers();
            return light(lumis::Disk<T>{center, normal, input.number<T>()}, lumis::ByArea{});
        }
        case 14:
            return light(any_sphere(), lumis::ByArea{});
        case 15:
            return light(any_triangle(), lumis::BySolidAngle{});
        case 16:
            return light(any_parallelogram(), lumis::BySolidAngle{});
        case 17:
            return light(any_sphere(), lumis::BySolidAngle{});
        case 18:
            return check(input, lumis::HenyeyGreenstein<T>{any_direction<T>(input), input.number<T>()});
        case 19: {
            const auto bsdf =
                lumis::in_frame(any_frame<T>(input), lumis::GgxReflection<T>{any_direction<T>(input), any_alpha()});
            check(input, bsdf);
            return check_estimates<T>(input, bsdf, lumis::AreaLight{any_triangle(), numbers()});
        }
        case 20:
            return light_by_cosine(any_triangle());
        case 21:
            return light_by_cosine(any_parallelogram());
        case 22:
            return check(input, lumis::UniformCone<T>{input.number<T>()}, Value::UnitDirection);
        case 23: {
            const V direction = any_direction<T>(input);
            return check(input, lumis::Sun<T>{direction, input.number<T>()});
        }
        default: {
            using Light = lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle>;
            const std::vector<Light> lights{{any_sphere(), numbers()}, {any_sphere(), numbers()}};
            const std::array<T, 2> weights{input.uniform<T>(), input.uniform<T>()};
            const lumis::LightSet set{lights, weights};
            check(input, set, Value::UnitDirection);
            return check_estimates<T>(input, lumis::CosineHemisphere<T>{}, set);
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Input input{data, size};
    const auto kind = input.bits<std::uint8_t>();
    if (kind & 1) {
        fuzz_strategies<float>(input, kind / 2);
        fuzz_heuristics<float>(input);
    } else {
        fuzz_strategies<double>(input, kind / 2);
        fuzz_heuristics<double>(input);
    }
    return 0;
}
