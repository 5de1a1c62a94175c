// No strategy, heuristic or estimator divides by 0 or computes what is invalid, not even to discard the result: a host may
// trap FE_INVALID and FE_DIVBYZERO. NaN is not asked for here: comparing it is an invalid operation already.
#include "assertions.hpp"
#include "exceptions.hpp"
#include "strategies.hpp"
#include <lumis/testing/every_heuristic.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <type_traits>
#include <vector>

namespace {

template <class T>
constexpr T below_one = T(1) - T(1) / T(1 << 24);

// Corners of the unit cube, the largest float below 1 among them, and random points.
template <int N, class T>
std::vector<glm::vec<N, T>> uniforms() {
    std::vector<glm::vec<N, T>> result;
    const std::array corners{T(0), T(1) / T(1 << 24), T(0.5), below_one<T>, T(1)};
    int combinations = 1;
    for (int i = 0; i < N; ++i) combinations *= static_cast<int>(corners.size());
    for (int k = 0; k < combinations; ++k) {
        glm::vec<N, T> u;
        for (int i = 0, rest = k; i < N; ++i, rest /= static_cast<int>(corners.size())) {
            u[i] = corners[static_cast<std::size_t>(rest) % corners.size()];
        }
        result.push_back(u);
    }
    lumis::Uniforms<std::mt19937, T> source{std::mt19937{1}};
    for (int i = 0; i < 500; ++i) result.push_back(source.template next<N>());
    return result;
}

// Points that a strategy may be asked about without having drawn them.
template <class Point>
std::vector<Point> points() {
    std::vector<Point> result;
    if constexpr (std::integral<Point>) {
        result = {0, 1, 59, 1'000'000};
    } else if constexpr (std::floating_point<Point>) {
        for (const auto& u : uniforms<1, Point>()) result.push_back(u.x);
        result.insert(result.end(), {Point(-1), Point(2)});
    } else if constexpr (Point::length() == 2) {
        result = uniforms<2, typename Point::value_type>();
        result.insert(result.end(), {Point(-1), Point(2)});
    } else {
        using T = typename Point::value_type;
        const lumis::UniformSphere<T> anywhere;
        for (const auto& u : uniforms<2, T>()) result.push_back(anywhere.sample(u).value);
        for (int axis = 0; axis < 3; ++axis) {
            for (const T sign : {T(1), T(-1)}) {
                Point w{T(0)};
                w[axis] = sign;
                result.push_back(w);
            }
        }
    }
    return result;
}

// The point itself, and what lies beside and behind it.
template <class Point>
std::vector<Point> around(const Point& x) {
    if constexpr (requires { x.z; }) {
        return {x, -x, {-x.x, -x.y, x.z}, {x.x, x.y, -x.z}};
    } else {
        return {x};
    }
}

// What a strategy does for all of those raises, by what it was asked for.
struct Raised {
    int sample = 0, pdf_of_drawn = 0, pdf_of_any = 0, invert = 0;
};

template <class S>
Raised raised_by(const S& strategy) {
    Raised raised;
    const auto asked = points<typename S::Point>();
    raised.pdf_of_any = exceptions_raised_by([&] {
        for (const auto& x : asked) keep(strategy.pdf(x));
    });
    for (const auto& u : uniforms<S::dimensions, typename S::Scalar>()) {
        typename S::Point drawn{};
        bool is_drawn = false;
        raised.sample |= exceptions_raised_by([&] {
            const auto sample = strategy.sample(u);
            keep(sample);
            drawn = sample.value;
            is_drawn = sample.pdf > 0;
        });
        raised.pdf_of_drawn |= exceptions_raised_by([&] {
            for (const auto& x : around(drawn)) keep(strategy.pdf(x));
        });
        if constexpr (lumis::InvertibleStrategy<S>) {
            if (is_drawn) raised.invert |= exceptions_raised_by([&] { keep(strategy.invert(drawn)); });
        }
    }
    return raised;
}

template <class S>
void check_raises_nothing(const S& strategy) {
    const Raised raised = raised_by(strategy);
    CHECK(raised.sample == 0);
    CHECK(raised.pdf_of_drawn == 0);
    CHECK(raised.pdf_of_any == 0);
    CHECK(raised.invert == 0);
}

// make() constructs the strategy, which is watched as well.
template <class Make>
void check_making_raises_nothing(Make make) {
    std::optional<decltype(make())> strategy;
    CHECK(exceptions_raised_by([&] { strategy.emplace(make()); }) == 0);
    check_raises_nothing(*strategy);
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("strategies raise no floating-point exception", "[exceptions]", Strategies) {
    const auto check = [](auto make) {
        decltype(make()) subjects;
        CHECK(exceptions_raised_by([&] { subjects = make(); }) == 0);
        for (const auto& subject : subjects) {
            INFO(subject.label);
            check_raises_nothing(subject.strategy);
        }
    };
    SECTION("float") {
        check([] { return TestType::template make<float>(); });
    }
    SECTION("double") {
        check([] { return TestType::template make<double>(); });
    }
}

TEMPLATE_TEST_CASE("GGX of nothing to draw raises no floating-point exception", "[exceptions]", float, double) {
    using T = TestType;
    const CaughtAssertions caught;  // of the zero vector, which is no unit vector
    using V = glm::vec<3, T>;
    for (const T alpha : {T(0), T(0.5), T(1e4), T(2e4), T(-1)}) {
        for (const V wo : {V(0, 0, 1), V(T(0.6), 0, T(0.8)), V(1, 0, T(1e-30f)), V(1, 0, 0), V(0, 0, -1), V(T(0))}) {
            INFO("wo.x " << wo.x << ", wo.z " << wo.z << ", alpha " << alpha);
            const glm::vec<2, T> a{unknown(alpha), T(0.5)};
            const V o{unknown(wo.x), T(0), unknown(wo.z)};
            check_making_raises_nothing([&] { return lumis::GgxNdf<T>{a}; });
            check_making_raises_nothing([&] { return lumis::GgxVndf<T>{o, a}; });
            check_making_raises_nothing([&] { return lumis::GgxReflection<T>{o, a}; });
            check_making_raises_nothing([&] { return lumis::GgxBoundedReflection<T>{o, a}; });
            check_making_raises_nothing([&] { return lumis::Reflected{o, lumis::GgxNdf<T>{a}}; });
            check_making_raises_nothing([&] { return lumis::PerfectReflection<T>{o}; });
            for (const T eta : {T(1.5), T(1 / 1.5), T(1), T(0), T(1e4), T(1e-4)}) {
                check_making_raises_nothing([&] { return lumis::GgxDielectric<T>{o, a, unknown(eta)}; });
                check_making_raises_nothing([&] { return lumis::SmoothDielectric<T>{o, unknown(eta)}; });
                const lumis::GgxDielectric<T> glass{o, a, unknown(eta)};
                CHECK(exceptions_raised_by([&] {
                          for (const V& wi : {-o, V(-o.x, -o.y, o.z), V(o.x, o.y, -o.z)}) {
                              keep(glass.pdf(wi));
                              keep(glass.bsdf(wi));
                              keep(glass.weight(wi));
                          }
                      }) == 0);
            }
            const lumis::GgxReflection<T> reflection{o, a};
            const lumis::Reflected by_ndf{o, lumis::GgxNdf<T>{a}};
            // The half vector vanishes, and the textbook's terms divide by the cosine.
            CHECK(exceptions_raised_by([&] {
                      for (const V& wi : {-o, V(-o.x, -o.y, o.z), V(o.x, o.y, -o.z)}) {
                          keep(reflection.pdf(wi));
                          keep(by_ndf.pdf(wi));
                          keep(reflection.ggx().brdf(o, wi));
                          keep(reflection.ggx().G1(wi));
                          keep(reflection.ggx().G2(o, wi));
                          keep(reflection.ggx().lambda(wi));
                          keep(reflection.ggx().D(wi + o));
                      }
                  }) == 0);
        }
    }
}

// Seen from a vertex or the centre, from within the plane or the surface, and lights without area.
TEMPLATE_TEST_CASE("lights of nothing to draw raise no floating-point exception", "[exceptions]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const auto check = [](const auto& shape, auto by, const V& point) {
        INFO("seen from " << point.x << ", " << point.y << ", " << point.z);
        using Light = lumis::AreaLight<std::remove_cvref_t<decltype(shape)>, decltype(by)>;
        check_making_raises_nothing([&] { return Light{shape, point}; });
        CHECK(exceptions_raised_by([&] {
                  const lumis::SurfaceLight<std::remove_cvref_t<decltype(shape)>, decltype(by)> light{
                      shape, point, lumis::Sides::One};
                  keep(light.sample({T(0.5), T(0.25)}));
                  keep(light.hit_along({T(0), T(0), T(1)}));
                  keep(light.hit_along({T(1), T(0), T(0)}));
                  keep(lumis::pdf_from_hit<decltype(by)>(shape, point, T(0), T(0)));
                  const lumis::SurfaceArea area{shape};
                  keep(area.sample({T(0.5), T(0.25)}));
                  keep(area.pdf(point));
                  keep(area.invert(point));
              }) == 0);
    };
    const auto check_by_cosine = [](const auto& shape, const V& point) {
        using Light = lumis::AreaLight<std::remove_cvref_t<decltype(shape)>, lumis::ByCosine>;
        for (const V& normal : {V(0, 0, 1), V(0, 0, -1), V(1, 0, 0), V(0, T(-0.6), T(0.8))}) {
            INFO("seen from " << point.x << ", " << point.y << ", " << point.z << " at the normal " << normal.x << ", "
                              << normal.y << ", " << normal.z);
            check_making_raises_nothing([&] { return Light{shape, point, normal}; });
            CHECK(exceptions_raised_by([&] {
                      const Light light{shape, point, normal};
                      keep(light.sample({T(0.5), T(0.25)}));
                      keep(light.pdf({T(0), T(0), T(1)}));
                      keep(light.invert({T(0), T(0), T(1)}));
                  }) == 0);
        }
    };
    for (const V& point : {V(0, 0, 0), V(T(0.25), T(0.25), 0), V(5, 0, 0), V(1, 0, 0), V(T(0.25), T(0.25), -1)}) {
        for (const T size : {T(1), T(0)}) {
            const lumis::Triangle<T> triangle{V(0, 0, 0), V(size, 0, 0), V(0, size, 0)};
            const lumis::Parallelogram<T> square{V(0, 0, 0), V(size, 0, 0), V(0, size, 0)};
            const lumis::Parallelogram<T> skew{V(0, 0, 0), V(size, 0, 0), V(size / 2, size, 0)};
            const lumis::Sphere<T> sphere{V(0, 0, 0), size};
            check(triangle, lumis::ByArea{}, point);
            check(triangle, lumis::BySolidAngle{}, point);
            check(square, lumis::ByArea{}, point);
            check(square, lumis::BySolidAngle{}, point);
            check(skew, lumis::BySolidAngle{}, point);
            check_by_cosine(triangle, point);
            check_by_cosine(skew, point);
            check(lumis::Disk<T>{V(0, 0, 0), V(0, 0, 1), size}, lumis::ByArea{}, point);
            check(sphere, lumis::ByArea{}, point);
            check(sphere, lumis::BySolidAngle{}, point);
        }
    }
}

TEMPLATE_TEST_CASE("heuristics raise no floating-point exception", "[exceptions]", float, double) {
    using T = TestType;
    using Limits = std::numeric_limits<T>;
    const std::array densities{
        T(0),    Limits::denorm_min(), Limits::min(), T(1e-30), T(1e-20f), T(0.3), T(1e20f), T(1e30),
        T(1e38), Limits::max()};
    lumis::testing::for_each_heuristic([&](const auto& heuristic, const char* name) {
        INFO(name);
        for (const T a : densities) {
            for (const T b : densities) {
                INFO(a << " against " << b);
                CHECK(exceptions_raised_by([&] {
                          keep(lumis::mis_weight(heuristic, a, b));
                          keep(lumis::mis_weight(heuristic, a, b, T(1)));
                          keep(lumis::mis_weight(lumis::BalanceWithFactors{1e-3, 1e3}, a, b));
                      }) == 0);
                for (const std::size_t size : {2u, 8u, 40u}) {
                    std::vector<T> many(size, b);
                    many[1] = a;
                    CHECK(exceptions_raised_by([&] {
                              keep(lumis::mis_weight(heuristic, 0, std::span<const T>{many}));
                              keep(lumis::mis_weight(heuristic, 1, std::span<const T>{many}));
                          }) == 0);
                }
            }
        }
    });
}

// The irradiance of a square light, which most of the directions of the other technique miss.
TEMPLATE_TEST_CASE("estimators raise no floating-point exception", "[exceptions]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const lumis::AreaLight light{lumis::Parallelogram<T>{V(-1, -1, 1), V(2, 0, 0), V(0, 2, 0)}, V(T(0))};
    const lumis::CosineHemisphere<T> bsdf;
    const lumis::GgxReflection<T> glossy{V(T(0.6), T(0), T(0.8)), {T(0.1), T(0.1)}};
    const auto f = [&](const V& w) { return w.z > 0 && light.pdf(w) > 0 ? w.z : T(0); };
    lumis::testing::for_each_heuristic([&](const auto& heuristic, const char* name) {
        INFO(name);
        const auto all = multi_sample(heuristic, lumis::take(1, bsdf), lumis::take(2, light), lumis::take(1, glossy));
        const auto one =
            one_sample(heuristic, lumis::choose(0.25, bsdf), lumis::choose(0.5, light), lumis::choose(0.25, glossy));
        const lumis::Mixture mixture{lumis::choose(0.25, bsdf), lumis::choose(0.75, light)};
        const auto mixed = multi_sample(heuristic, lumis::take(1, mixture));
        lumis::Uniforms<std::mt19937, T> source{std::mt19937{2}};
        lumis::RunningMoments<T> moments;
        CHECK(exceptions_raised_by([&] {
                  for (int i = 0; i < 2000; ++i) {
                      moments.add(all.estimate(f, source));
                      moments.add(one.estimate(f, source));
                      moments.add(mixed.estimate(f, source));
                  }
                  keep(moments.standard_error());
              }) == 0);
    });
}

// Rounds are asked about from the first on: where there are no others, nothing is known of the weights and of the error.
TEMPLATE_TEST_CASE("optimal weights raise no floating-point exception", "[exceptions]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const lumis::AreaLight light{lumis::Parallelogram<T>{V(-1, -1, 1), V(2, 0, 0), V(0, 2, 0)}, V(T(0))};
    const lumis::CosineHemisphere<T> bsdf;
    const lumis::GgxReflection<T> glossy{V(T(0.6), T(0), T(0.8)), {T(0.9), T(0.9)}};
    const auto f = [&](const V& w) { return w.z > 0 && light.pdf(w) > 0 ? V(w.z, 1, 0) : V(T(0)); };
    const auto check = [&](auto best) {
        lumis::Uniforms<std::mt19937, T> source{std::mt19937{2}};
        CHECK(exceptions_raised_by([&] {
                  for (int i = 0; i < 200; ++i) {
                      keep(best.estimate());
                      keep(best.standard_error());
                      keep(best.weights());
                      best.add(f, source);
                  }
              }) == 0);
    };
    check(lumis::optimal<V>(lumis::take(1, bsdf), lumis::take(2, light), lumis::take(1, glossy), lumis::take(1, bsdf)));
    check(lumis::optimal<V>(lumis::choose(0.3, bsdf), lumis::choose(0.5, light), lumis::choose(0, light)));
}

TEMPLATE_TEST_CASE("resampling raises no floating-point exception", "[exceptions]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const lumis::AreaLight light{lumis::Parallelogram<T>{V(-1, -1, 1), V(2, 0, 0), V(0, 2, 0)}, V(T(0))};
    const lumis::CosineHemisphere<T> bsdf;
    const lumis::UniformSphere<T> sphere;
    const auto f = [&](const V& w) { return w.z > 0 && light.pdf(w) > 0 ? w.z : T(0); };
    const auto none = [](const V&) { return T(0); };
    lumis::Uniforms<std::mt19937, T> source{std::mt19937{2}};
    CHECK(exceptions_raised_by([&] {
              for (int i = 0; i < 500; ++i) {
                  keep(resample(f, lumis::take(2, bsdf), lumis::take(1, light)).estimate(f, source));
                  keep(resample(f, 3, lumis::choose(0.3, bsdf), lumis::choose(0.3, sphere)).estimate(f, source));
                  keep(resample(lumis::PairwiseWeights{}, f, lumis::take(2, light), lumis::take(1, bsdf),
                                lumis::take(1, sphere))
                           .sample(source)
                           .contribution_weight);
                  keep(resample(none, lumis::take(2, bsdf)).sample(source).contribution_weight);
              }
          }) == 0);
    lumis::Reservoir<int, T> kept;
    CHECK(exceptions_raised_by([&] {
              for (T u : {T(0), T(0.5), T(1)}) {
                  for (const T weight : {T(0), std::numeric_limits<T>::denorm_min(), T(1), T(1e30)}) {
                      kept.add_reusing(0, weight, u);
                      kept.merge(kept, u);
                      keep(kept.inverse_probability());
                      keep(kept.contribution_weight(T(0)));
                  }
              }
          }) == 0);
}
