#include "assertions.hpp"
#include "catch.hpp"
#include "instrumented.hpp"
#include "z_test.hpp"
#include <lumis/combine/multi_sample.hpp>
#include <lumis/combine/resample.hpp>
#include <lumis/core/lanes.hpp>
#include <lumis/lights/area_light.hpp>
#include <lumis/lights/area_light_by_solid_angle.hpp>
#include <lumis/lights/light_set.hpp>
#include <lumis/lights/selected_light.hpp>
#include <lumis/lights/surface_light.hpp>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>
#include <vector>

namespace {

using lumis::SelectedLight;

template <class T>
using Light = lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle>;

// Spheres of which the second hides a part of the third, and one of weight 0.
template <class T>
auto spheres() {
    using V = glm::vec<3, T>;
    const auto light = [](const V& center, T radius) { return Light<T>{lumis::Sphere<T>{center, radius}, V(T(0))}; };
    return std::vector{light(V(2, 0, 2), T(0.5)), light(V(0, 1, 2), T(0.3)), light(V(0, 2, 4), T(1)),
                       light(V(-2, 0, 2), T(0.5))};
}
template <class T>
constexpr std::array<T, 4> powers{T(1), T(2), T(4), T(0)};

TEMPLATE_TEST_CASE("a light is selected by its weight, and tells its own density", "[selected_light]", float, double) {
    using T = TestType;
    const lumis::LightSet set{spheres<T>(), std::vector<T>{powers<T>.begin(), powers<T>.end()}};
    const SelectedLight one{set};
    static_assert(lumis::Strategy<decltype(one)>);
    static_assert(std::same_as<decltype(one.sample({})), lumis::LightSample<lumis::ToLight<glm::vec<3, T>>, T>>);
    CountingUniforms<T> uniforms;
    std::array<int, 4> selected{};
    for (int i = 0; i < 7000; ++i) {
        const auto u = uniforms.template next<3>();
        const auto s = one.sample(u);
        const auto same = set.sample_one(u);
        REQUIRE(s.value.index == same.index);
        REQUIRE(s.value.direction == same.sample.value);
        REQUIRE(s.distance == same.sample.distance);
        REQUIRE(std::abs(one.pdf(s.value) / s.pdf - 1) <= T(1e-5));
        ++selected[s.value.index];
    }
    CHECK(std::abs(selected[0] - 1000) <= 150);
    CHECK(std::abs(selected[1] - 2000) <= 190);
    CHECK(selected[3] == 0);
    CHECK(one.pdf({0, glm::vec<3, T>(0, 0, 1)}) == 0);
    CHECK(one.pdf({4, glm::vec<3, T>(0, 0, 1)}) == 0);
    CHECK(one.pdf({lumis::no_light, glm::vec<3, T>(0, 0, 1)}) == 0);
}

// Every light is an integral of its own: what hides it is the integrand's business, here nothing.
TEMPLATE_TEST_CASE("the irradiance of selected lights is the sum of all", "[selected_light]", float, double) {
    using T = TestType;
    const auto lights = spheres<T>();
    const lumis::AliasTable<T> table{std::vector<T>{powers<T>.begin(), powers<T>.end()}};
    const SelectedLight one{lumis::LightSet{[&](std::size_t i) { return lights[i]; }, table}};
    static_assert(std::is_trivially_copyable_v<std::remove_cvref_t<decltype(one)>>);
    const auto cosine = [](const lumis::AnySample auto& s) { return s.value.index < 3 ? s.value.direction.z : T(0); };
    const auto sphere = [](double radius, const glm::dvec3& c) {
        return std::numbers::pi * radius * radius / glm::dot(c, c) * glm::normalize(c).z;
    };
    const double answer = sphere(0.5, {2, 0, 2}) + sphere(0.3, {0, 1, 2}) + sphere(1, {0, 2, 4});
    const auto check = [&](const auto& estimator) {
        const auto law = z_test<T>([&](auto& u) { return estimator.estimate(cosine, u); }, answer, 7, 6);
        INFO(law.message);
        CHECK(law.passed);
    };
    check(multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, one)));
    // A target that makes candidates of all lights alike, and one that takes the point alone.
    const auto target = [&](const lumis::AnySample auto& s) { return 1 / s.pdf; };
    check(resample(target, lumis::take(8, one)));
    check(resample([](const lumis::ToLight<glm::vec<3, T>>& x) { return x.direction.z; }, lumis::take(2, one)));
}

TEST_CASE("a selected light tells its surface, and is drawn in lanes", "[selected_light]") {
    const lumis::Triangle<float> near{{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}}, far{{-1, -1, 4}, {1, -1, 4}, {0, 1, 4}};
    const lumis::LightSet set{
        std::vector{lumis::SurfaceLight{near, glm::vec3{0}}, lumis::SurfaceLight{far, glm::vec3{0}}},
        std::vector<float>{1, 1}};
    const SelectedLight one{set};
    CountingUniforms<float> uniforms;
    for (int i = 0; i < 20; ++i) {
        const auto s = one.sample(uniforms.next<3>());
        CHECK(std::abs(s.surface.position.z - (s.value.index == 0 ? 2.0f : 4.0f)) <= 1e-5f);
        CHECK(glm::distance(s.surface.position, s.distance * s.value.direction) <= 1e-5f);
    }

    using Four = lumis::Lanes<float, 4>;
    glm::vec<3, Four> u;
    for (int k = 0; k < 3; ++k) u[k] = Four::of_lanes([&](auto) { return uniforms.next<1>().x; });
    const auto lanes = lumis::detail::sample_in<Four>(one, u);
    for (std::size_t i = 0; i < 4; ++i) {
        const auto alone = one.sample({u.x[i], u.y[i], u.z[i]});
        CHECK(lanes.value[i].index == alone.value.index);
        CHECK(lanes.pdf[i] == alone.pdf);
        CHECK(lanes.distance[i] == alone.distance);
    }
}

}  // namespace
