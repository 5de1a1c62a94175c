// How far away a light is along a direction, and how far the nearest of several: what an integrand is told of samples.
#include "catch.hpp"
#include "irradiance.hpp"
#include <lumis/lumis.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <type_traits>
#include <vector>

TEMPLATE_TEST_CASE("every light says how far away it is along a direction", "[distance_along]", float, double) {
    using namespace lumis;
    using T = TestType;
    using V = glm::vec<3, T>;
    constexpr T infinity = std::numeric_limits<T>::infinity();
    const V origin{T(0)}, up{0, 0, 1}, aside = glm::normalize(V{1, 0, T(0.2)});
    const Parallelogram<T> square{{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}};
    const Triangle<T> triangle{{-1, -1, 3}, {1, -1, 3}, {0, 2, 3}};
    const Disk<T> disk{{0, 0, 4}, {0, 0, -1}, T(0.5)};
    const Sphere<T> sphere{{0, 0, 7}, 2}, around{{0, 0, 1}, 5};
    const auto check = [&](const auto& light, double expected) {
        static_assert(LightStrategy<std::remove_cvref_t<decltype(light)>>);
        CHECK(double{light.distance_along(up)} == Approx(expected).epsilon(1e-6));
        CHECK(light.distance_along(-up) == infinity);
        CHECK(light.distance_along(aside) == infinity);
        CHECK(light.distance_along(V{std::numeric_limits<T>::quiet_NaN()}) == infinity);
    };
    check(AreaLight{square, origin}, 2);
    check(AreaLight{triangle, origin}, 3);
    check(AreaLight{disk, origin}, 4);
    check(AreaLight{sphere, origin}, 5);
    check(AreaLight<Parallelogram<T>, BySolidAngle>{square, origin}, 2);
    check(AreaLight<Triangle<T>, BySolidAngle>{triangle, origin}, 3);
    check(AreaLight<Sphere<T>, BySolidAngle>{sphere, origin}, 5);
    CHECK(AreaLight{around, origin}.distance_along(-up) == Approx(4));
    CHECK(AreaLight<Sphere<T>, BySolidAngle>{around, origin}.distance_along(-up) == Approx(4));
    CHECK(EnvironmentMap<T>{2, 1, std::vector<T>{1, 1}}.distance_along(up) == infinity);

    // In a frame that turns +z to +x.
    const Frame<T> frame{V{1, 0, 0}};
    CHECK(in_frame(frame, AreaLight{square, origin}).distance_along(V{1, 0, 0}) == Approx(2));

    // The nearest of several.
    check(Mixture{choose(0.5, AreaLight{sphere, origin}), choose(0.5, AreaLight{disk, origin})}, 4);
    check(Mixture{choose(0.5, CosineHemisphere<T>{}), choose(0.5, AreaLight{disk, origin})}, 4);
    const std::vector lights{AreaLight{triangle, origin},
                             AreaLight{Triangle<T>{triangle.a * T(2), triangle.b * T(2), triangle.c * T(2)}, origin}};
    check(LightSet{lights, std::vector<T>{1, 1}}, 3);
    check(LightSet{lights, std::vector<T>{0, 1}}, 6);
    static_assert(!LightStrategy<CosineHemisphere<T>>);
    static_assert(!LightStrategy<decltype(in_frame(frame, CosineHemisphere<T>{}))>);
}

namespace {

// A light of a host's own, which does not say how far away it is along directions that it has not drawn.
struct Untold : lumis::AreaLight<lumis::Parallelogram<float>> {
    using AreaLight::AreaLight;

  private:
    using AreaLight::distance_along;
};

// A strategy of a host's own, whose samples hold more than others.
struct Lobes : lumis::CosineHemisphere<float> {
    struct Drawn {
        glm::vec3 value;
        float pdf;
        int lobe;
    };
    [[nodiscard]] Drawn sample(glm::vec2 u) const noexcept {
        const auto s = CosineHemisphere::sample(u);
        return {s.value, s.pdf, 7};
    }
};

template <class S>
constexpr bool has_distance = requires(const S sample) {
    sample.distance;
};

}  // namespace

TEST_CASE("samples as an integrand is given them", "[distance_along]") {
    using namespace lumis;
    const glm::vec3 origin{0};
    const Parallelogram<float> square{{-2, -2, 2}, {4, 0, 0}, {0, 4, 0}};
    const AreaLight light{square, origin};
    const CosineHemisphere<float> bsdf;
    auto uniforms = irradiance::uniforms<float>(1);

    // A BSDF's sample alone has no distance; next to a light it has.
    const auto alone = multi_sample(BalanceHeuristic{}, take(1, bsdf));
    const auto constant = [](const AnySample auto& s) {
        static_assert(!has_distance<decltype(s)>);
        return 1.0f;
    };
    CHECK(alone.estimate(constant, uniforms) > 0);
    int met = 0, missed = 0;
    const auto both = multi_sample(BalanceHeuristic{}, take(1, bsdf), take(1, light), take(1, Lobes{}));
    const auto count = [&](const AnySample auto& s) {
        static_assert(has_distance<decltype(s)>);
        if constexpr (requires { s.lobe; }) CHECK(s.lobe == 7);
        const float expected = light.distance_along(s.value);
        CHECK((s.distance == expected || std::abs(s.distance / expected - 1) <= 1e-5f));
        ++(std::isinf(s.distance) ? missed : met);
        return 1.0f;
    };
    for (int i = 0; i < 1000; ++i) CHECK(both.estimate(count, uniforms) >= 0);
    CHECK(met > 500);
    CHECK(missed > 500);

    // A delta light keeps its own distance, a mirror's direction has that of the nearest light.
    const PointLight lamp{glm::vec3{0, 0, 5}, origin};
    const PerfectReflection mirror{glm::vec3{0, 0, 1}};
    std::vector<float> distances;
    struct Reflected {
        std::vector<float>& distances;
        float operator()(const LightSample<glm::vec3, float>& s, delta_t) const {
            distances.push_back(s.distance);
            return 1;
        }
        float operator()(const glm::vec3&) const { return 1; }
    };
    const auto reflecting = multi_sample(BalanceHeuristic{}, take(1, lamp), take(1, mirror), take(1, light));
    CHECK(reflecting.estimate(Reflected{distances}, uniforms) >= 2);
    REQUIRE(distances.size() == 2);
    CHECK(distances[0] == 5);
    CHECK(distances[1] == Approx(2));

    // Where a light does not tell, no sample of several has a distance: it could be that to a light which is hidden.
    const Untold untold{square, origin};
    static_assert(has_distance<decltype(untold.sample({}))>);
    const auto without = [](const AnySample auto& s) {
        static_assert(!has_distance<decltype(s)>);
        return s.value.z;
    };
    const std::vector<Untold> lights{untold, untold};
    const Mixture mixture{choose(0.5, untold), choose(0.5, light)};
    const LightSet set{lights, std::vector{1.0f, 1.0f}};
    const auto each = [&](const auto& estimator) { CHECK(estimator.estimate(without, uniforms) >= 0); };
    each(multi_sample(BalanceHeuristic{}, take(1, untold), take(1, light)));
    each(multi_sample(BalanceHeuristic{}, take(1, bsdf), take(1, untold)));
    each(multi_sample(BalanceHeuristic{}, take(1, set)));
    each(multi_sample(BalanceHeuristic{}, take(1, mixture)));
    static_assert(has_distance<decltype(set.sample_one({}).sample)>);
    CHECK(std::isfinite(set.sample_one({0.2f, 0.5f, 0.5f}).sample.distance));
}

TEST_CASE("an integrand of the point alone asks no light for a distance", "[distance_along]") {
    using namespace lumis;
    // Ends the program when it is asked.
    struct Unasked : AreaLight<Parallelogram<float>> {
        using AreaLight::AreaLight;
        [[nodiscard]] float distance_along(const glm::vec3&) const noexcept { std::abort(); }
    };
    const Unasked light{Parallelogram<float>{{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}}, glm::vec3{0}};
    const std::vector lights{light, light};
    const LightSet set{lights, std::vector{1.0f, 1.0f}};
    const Mixture mixture{choose(0.5, light), choose(0.5, CosineHemisphere<float>{})};
    auto uniforms = irradiance::uniforms<float>(1);
    const auto f = [](const glm::vec3& w) { return w.z; };
    for (int i = 0; i < 100; ++i) {
        CHECK(multi_sample(BalanceHeuristic{}, take(1, set), take(1, light), take(1, mixture)).estimate(f, uniforms) >
              0);
        CHECK(one_sample(PowerHeuristic{}, choose(0.5, set), choose(0.5, mixture)).estimate(f, uniforms) >= 0);
    }
}
