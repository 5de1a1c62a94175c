// Views of environment maps, and what is composed of them: trivially copyable, and the same as with the map itself.
#include "catch.hpp"
#include "copies.hpp"
#include <lumis/lumis.hpp>

#include <cstddef>
#include <optional>
#include <random>
#include <span>
#include <type_traits>
#include <vector>

namespace {

template <class T>
std::vector<T> uneven(std::size_t size) {
    std::mt19937 engine{11};
    std::vector<T> result(size);
    for (T& x : result) x = static_cast<T>(engine() % 1000) * static_cast<T>(engine() % 7);
    return result;
}

template <class Map>
void check_views() {
    using T = typename Map::Scalar;
    std::optional<Map> map{std::in_place, 64, 32, uneven<T>(64 * 32)};
    Copies copies;
    const auto here = map->view(), elsewhere = map->view(copies);
    CHECK(copies.size() == (lumis::InvertibleStrategy<Map> ? 5 : 4));
    STATIC_REQUIRE(std::is_trivially_copyable_v<decltype(map->view())>);
    lumis::Uniforms<std::mt19937, T> uniforms{std::mt19937{5}};
    std::vector<lumis::Direction<T>> directions;
    std::vector<T> densities;
    for (int i = 0; i < 1000; ++i) {
        const auto u = uniforms.template next<2>();
        const auto expected = map->sample(u), sample = here.sample(u);
        CHECK(expected.value == sample.value);
        CHECK(expected.pdf == sample.pdf);
        CHECK(expected.distance == sample.distance);
        directions.push_back(lumis::UniformSphere<T>{}.sample(uniforms.template next<2>()).value);
        densities.push_back(map->pdf(directions.back()));
        if constexpr (lumis::InvertibleStrategy<Map>) CHECK(map->invert(sample.value) == here.invert(sample.value));
        CHECK(elsewhere.sample(u).value == expected.value);
    }
    map.reset();
    for (std::size_t i = 0; i < directions.size(); ++i) CHECK(elsewhere.pdf(directions[i]) == densities[i]);
    CHECK(elsewhere.width() == 64);
    CHECK_FALSE(elsewhere.empty());
}

}  // namespace

TEST_CASE("views draw and evaluate as their maps do", "[environment_map]") {
    check_views<lumis::EnvironmentMap<float>>();
    check_views<lumis::EnvironmentMap<double>>();
    check_views<lumis::AliasEnvironmentMap<float>>();
    check_views<lumis::AliasEnvironmentMap<double>>();
}

TEST_CASE("what is composed of views is trivially copyable, and estimates the same", "[environment_map]") {
    using namespace lumis;
    const EnvironmentMap sky{64, 32, uneven<float>(64 * 32)};
    const AliasTable powers{std::vector<float>{1, 2}};
    const Frame frame{glm::vec3{0, 0.6f, 0.8f}};
    const std::vector lights{AreaLight{Sphere<float>{{0, 0, 2}, 1}, glm::vec3{0}},
                             AreaLight{Sphere<float>{{3, 0, 2}, 1}, glm::vec3{0}}};
    const auto bsdf = in_frame(frame, GgxReflection<float>{glm::vec3{0, 0.6f, 0.8f}, glm::vec2{0.3f}});
    const auto estimators = [&](const auto& map, const auto& table, const auto& all_lights) {
        const LightSet set{all_lights, table};
        const Mixture mixture{choose(0.5, map), choose(0.5, bsdf)};
        return std::tuple{multi_sample(PowerHeuristic{}, take(2, mixture), take(1, set)),
                          one_sample(BalanceHeuristic{}, choose(0.5, in_frame(frame, map)), choose(0.5, bsdf)),
                          multi_sample(BalanceHeuristic{}, take(1, map), take(1, bsdf))};
    };
    const auto of_views = estimators(sky.view(), powers.view(), std::span{lights});
    const auto of_tables = estimators(sky, powers, lights);
    const auto check = [](const auto& views, const auto& tables) {
        STATIC_REQUIRE(std::is_trivially_copyable_v<std::remove_cvref_t<decltype(views)>>);
        Uniforms a{std::mt19937{3}}, b{std::mt19937{3}};
        const auto f = [](const glm::vec3& w) { return w.z + 2; };
        for (int i = 0; i < 100; ++i) CHECK(views.estimate(f, a) == tables.estimate(f, b));
    };
    check(std::get<0>(of_views), std::get<0>(of_tables));
    check(std::get<1>(of_views), std::get<1>(of_tables));
    check(std::get<2>(of_views), std::get<2>(of_tables));
}

TEST_CASE("a map in float takes luminance in double", "[environment_map]") {
    const auto doubles = uneven<double>(8 * 4);
    const auto floats = uneven<float>(8 * 4);
    const lumis::EnvironmentMap<float> map{8, 4, doubles, {lumis::Interpolation::Bilinear}};
    const lumis::EnvironmentMap same{8, 4, floats, {lumis::Interpolation::Bilinear}};
    const lumis::AliasEnvironmentMap<float> alias{8, 4, doubles};
    CHECK(map.sample({0.3f, 0.6f}).value == same.sample({0.3f, 0.6f}).value);
    CHECK(map.pdf({0, 0, 1}) == same.pdf({0, 0, 1}));
    CHECK(alias.pdf({0, 0, 1}) == lumis::AliasEnvironmentMap{8, 4, floats}.pdf({0, 0, 1}));
}
