// Many lights and a BSDF combined over pairs of a light and a direction: the estimate is right, and asks one light alone.
#include "catch.hpp"
#include "instrumented.hpp"
#include "z_test.hpp"
#include <lumis/combine/multi_sample.hpp>
#include <lumis/combine/one_sample.hpp>
#include <lumis/combine/resample.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/lights/area_light.hpp>
#include <lumis/lights/area_light_by_solid_angle.hpp>
#include <lumis/lights/light_set.hpp>
#include <lumis/lights/light_tree.hpp>
#include <lumis/lights/selected_light.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <type_traits>
#include <vector>

namespace {

// A lattice of spheres over the origin that do not hide each other, and their irradiance at the normal +z.
template <class T>
struct Scene {
    using V = glm::vec<3, T>;
    static constexpr int side = 21;
    static constexpr double radius = 0.15;

    std::vector<V> centers;
    std::vector<T> radiance;
    double irradiance = 0;
    lumis::LightTree<T> tree;
    mutable int asked = 0;  // how many lights were made

    Scene() {
        std::vector<lumis::LightBounds<T>> bounds;
        for (int i = 0; i < side * side; ++i) {
            const glm::dvec3 center{i % side - side / 2, i / side - side / 2, 5};
            const double emitted = i % 7 == 0 ? 10 : 1, squared = glm::dot(center, center);
            centers.emplace_back(center);
            radiance.push_back(static_cast<T>(emitted));
            bounds.push_back(light_bounds(sphere(bounds.size()), radiance.back()));
            irradiance += emitted * std::numbers::pi * radius * radius / squared * center.z / std::sqrt(squared);
        }
        tree = lumis::LightTree{bounds};
    }

    [[nodiscard]] lumis::Sphere<T> sphere(std::size_t i) const { return {centers[i], radius}; }
    [[nodiscard]] auto light(std::size_t i) const {
        ++asked;
        return lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle>{sphere(i), V(T(0))};
    }
    // The light that a ray meets: that near where it passes the plane of the centres.
    [[nodiscard]] std::size_t met(const V& w) const {
        const T x = std::round(5 * w.x / w.z) + side / 2, y = std::round(5 * w.y / w.z) + side / 2;
        if (!(x >= 0 && x < side && y >= 0 && y < side)) return lumis::no_light;
        const auto i = static_cast<std::size_t>(x) + side * static_cast<std::size_t>(y);
        const V across = glm::cross(w, centers[i]);
        return glm::dot(across, across) < T(radius * radius) ? i : lumis::no_light;
    }
};

TEMPLATE_TEST_CASE("many lights and a BSDF combine over pairs of a light and a direction", "[met_light]", float,
                   double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const Scene<T> scene;
    const auto light = [&](std::size_t i) { return scene.light(i); };
    const lumis::SelectedLight one{lumis::LightSet{light, scene.tree.from(V(T(0)), V(T(0), T(0), T(1)))}};
    const lumis::MetLight met{one, lumis::CosineHemisphere<T>{}, [&](const V& w) { return scene.met(w); }};
    static_assert(std::is_trivially_copyable_v<std::remove_cvref_t<decltype(one)>>);

    const auto reflected = [&](const lumis::ToLight<V>& x) {
        return x.direction.z > 0 && scene.met(x.direction) == x.index ? scene.radiance[x.index] * x.direction.z : T(0);
    };
    const auto check = [&](const auto& estimator, const auto& f) {
        const auto law = z_test<T>([&](auto& u) { return estimator.estimate(f, u); }, scene.irradiance, 3, 10);
        INFO(law.message);
        CHECK(law.passed);
    };
    const auto direct = multi_sample(lumis::PowerHeuristic{}, lumis::take(1, met), lumis::take(1, one));
    check(direct, reflected);
    if constexpr (std::same_as<T, float>) {
        check(one_sample(lumis::BalanceHeuristic{}, lumis::choose(0.2, met), lumis::choose(0.8, one)), reflected);
        check(resample(reflected, lumis::take(4, one), lumis::take(1, met)), reflected);
    }
    // Samples of either have the distance to their light.
    check(direct, [&](const lumis::AnySample auto& s) {
        const T center = glm::length(scene.centers[s.value.index]);
        return std::abs(s.distance - center) <= T(1.01 * Scene<T>::radius) ? reflected(s.value) : T(1e6);
    });

    // One light is asked for each of the two samples, however many there are.
    CountingUniforms<T> uniforms;
    scene.asked = 0;
    for (int i = 0; i < 100; ++i) static_cast<void>(direct.estimate(reflected, uniforms));
    CHECK(scene.asked <= 200);
    CHECK(scene.asked >= 100);
}

TEST_CASE("a direction that meets no light draws nothing", "[met_light]") {
    const Scene<float> scene;
    const auto light = [&](std::size_t i) { return scene.light(i); };
    const lumis::SelectedLight one{lumis::LightSet{light, scene.tree.from(glm::vec3{0})}};
    const lumis::MetLight none{one, lumis::CosineHemisphere<float>{}, [](const glm::vec3&) { return lumis::no_light; }};
    CHECK(none.sample({0.3f, 0.4f}).pdf == 0);
    CHECK(none.pdf({lumis::no_light, glm::vec3{0, 0, 1}}) == 0);
    const lumis::MetLight third{one, lumis::CosineHemisphere<float>{}, [](const glm::vec3&) { return std::size_t{3}; }};
    const auto s = third.sample({0.3f, 0.4f});
    CHECK(s.value.index == 3);
    CHECK(s.pdf == third.pdf(s.value));
    CHECK(std::isinf(one.distance_along({lumis::no_light, s.value.direction})));
    CHECK(std::isinf(one.distance_along({0, {0, 0, -1}})));
    CHECK(std::abs(one.distance_along({220, {0, 0, 1}}) - 4.85f) <= 1e-5f);
}

}  // namespace
