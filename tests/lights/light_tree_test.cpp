// Light trees: each light is drawn exactly as often as its probability says.
#include "catch.hpp"
#include "copies.hpp"
#include "exceptions.hpp"
#include "random_points.hpp"
#include <lumis/lights/light_tree.hpp>
#include <lumis/testing/chi_square.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using lumis::LightBounds;
using lumis::LightTree;
using lumis::Sides;

// Triangles, spheres and points of intensities over six decades, one in ten of intensity 0.
template <class T>
std::vector<LightBounds<T>> random_lights(std::size_t count, std::uint64_t seed) {
    RandomPoints random{seed};
    std::vector<LightBounds<T>> lights;
    const auto vertex = [&](const glm::dvec3& center) { return glm::vec<3, T>(center + 0.05 * random.point()); };
    while (lights.size() < count) {
        const glm::dvec3 center = random.point();
        const T radiance = random.number(0, 1) < 0.1 ? T(0) : static_cast<T>(std::pow(10, random.number(-3, 3)));
        const double kind = random.number(0, 1);
        if (kind < 0.6) {
            lights.push_back(light_bounds(lumis::Triangle<T>{vertex(center), vertex(center), vertex(center)}, radiance,
                                          kind < 0.4 ? Sides::One : Sides::Both));
        } else if (kind < 0.8) {
            lights.push_back(light_bounds(lumis::Sphere<T>{vertex(center), 0.03}, radiance));
        } else {
            lights.push_back({vertex(center), vertex(center), radiance});
            lights.back().upper = lights.back().lower;
        }
    }
    return lights;
}

// Lights seen from everywhere: a tree of them draws something by every uniform.
template <class T>
std::vector<LightBounds<T>> points(std::size_t count, double decades) {
    RandomPoints random{count};
    std::vector<LightBounds<T>> lights(count);
    for (auto& light : lights) {
        light.lower = light.upper = glm::vec<3, T>(random.point());
        light.intensity = static_cast<T>(std::pow(10, random.number(-decades, 0)));
    }
    return lights;
}

template <class T>
std::string refusal(const std::vector<LightBounds<T>>& lights) {
    try {
        const LightTree tree{lights};
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

TEST_CASE("a light tree divides all 2^24 uniforms among the lights, as its density says", "[light_tree]") {
    for (const std::size_t count :
         {std::size_t{1}, std::size_t{2}, std::size_t{5}, std::size_t{1000}, std::size_t{30000}}) {
        const LightTree tree{points<float>(count, 6)};
        const auto seen = tree.from(glm::vec3{0.3f, -0.2f, 0.1f});
        const auto drawn = [&](std::uint32_t k) { return seen.sample(glm::vec1{static_cast<float>(k) * 0x1p-24f}); };
        std::vector<int> runs(count);
        std::size_t wrong = 0;
        std::uint32_t k = 0;
        while (k < 1u << 24) {
            const auto first = drawn(k);
            const auto counts = static_cast<std::uint32_t>(first.pdf * 0x1p24f);
            REQUIRE(counts > 0);
            ++runs.at(first.value);
            wrong += drawn(k + counts - 1).value != first.value || seen.pdf(first.value) != first.pdf;
            k += counts;
        }
        CHECK(k == 1u << 24);
        CHECK(wrong == 0);
        CHECK(std::count(runs.begin(), runs.end(), 1) == static_cast<std::ptrdiff_t>(count));
        CHECK(drawn(1u << 24).pdf > 0);
    }
}

TEMPLATE_TEST_CASE("frequencies follow the density of a light tree", "[light_tree]", float, double) {
    using T = TestType;
    const LightTree tree{random_lights<T>(300, 1)};
    RandomPoints random{2};
    for (int view = 0; view < 12; ++view) {
        const auto normal = glm::vec<3, T>(random.direction());
        const auto point = glm::vec<3, T>(1.5 * random.point());
        const auto seen = view % 3 == 0 ? tree.from(point) : tree.from(point, normal);
        constexpr int samples = 20'000;
        std::vector<std::pair<double, double>> counts(tree.size() + 1);  // expected, observed; the last: nothing drawn
        double sum = 0;
        for (std::size_t i = 0; i < tree.size(); ++i) {
            counts[i].first = samples * double{seen.pdf(i)};
            sum += double{seen.pdf(i)};
        }
        REQUIRE(sum <= 1 + 1e-6);
        counts.back().first = samples * std::max(1 - sum, 0.0);
        bool same = true;
        for (int i = 0; i < samples; ++i) {
            const auto drawn = seen.sample(glm::vec<1, T>{static_cast<T>(random.number(0, 1))});
            same = same && drawn.pdf == (drawn.pdf > 0 ? seen.pdf(drawn.value) : T(0));
            ++counts[drawn.pdf > 0 ? drawn.value : tree.size()].second;
        }
        CHECK(same);
        const auto [statistic, terms] = lumis::testing::detail::pearson(counts, 10);
        INFO("view " << view << ": " << statistic << " over " << terms);
        CHECK(statistic <= terms + 5 * std::sqrt(2.0 * terms) + 10);
    }
}

TEST_CASE("two uniforms make a float's tree finer", "[light_tree]") {
    const LightTree tree{points<float>(1000, 12)};
    const auto coarse = tree.from(glm::vec3{0});
    const auto fine = tree.from_finely(glm::vec3{0});
    float sum = 0, least = 1, least_coarse = 1;
    for (std::size_t i = 0; i < tree.size(); ++i) {
        sum += fine.pdf(i);
        least = std::min(least, fine.pdf(i));
        least_coarse = std::min(least_coarse, coarse.pdf(i));
        CHECK(std::abs(fine.pdf(i) - coarse.pdf(i)) <= 0.01f * coarse.pdf(i) + 0x1p-23f);
    }
    CHECK(std::abs(sum - 1) <= 1e-5f);
    CHECK(least_coarse == 0x1p-24f);
    CHECK(least <= 1e-9f);
    const auto last = fine.sample({0x1.fffffep-1f, 0x1.fffffep-1f}), first = fine.sample({0, 0});
    CHECK(last.pdf == fine.pdf(last.value));
    CHECK(first.pdf == fine.pdf(first.value));
    CHECK(first.value != last.value);
}

TEMPLATE_TEST_CASE("lights below the horizon and those that face away are left out", "[light_tree]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    // Panels of a ceiling at z = 3 that light what is below, one of them turned.
    std::vector<LightBounds<T>> panels;
    for (int x = 0; x < 10; ++x) {
        for (int y = 0; y < 10; ++y)
            panels.push_back(
                light_bounds(lumis::Parallelogram<T>{V(x, y, 3), V(0, 0.5, 0), V(0.5, 0, 0)}, 1, Sides::One));
    }
    const LightTree tree{panels};
    CHECK_FALSE(tree.from(V(5, 5, 0), V(0, 0, 1)).empty());
    CHECK(tree.from(V(5, 5, 0), V(0, 0, -1)).empty());
    CHECK(tree.from(V(5, 5, 4)).empty());
    CHECK_FALSE(tree.from(V(5, 5, 4)).sample(glm::vec<1, T>{T(0.5)}).pdf > 0);
    CHECK(tree.from(V(20, 5, 3.01), V(-1, 0, 0)).empty());
    // A wall at x = 5 sees those before it, and half of the column that crosses its plane.
    const auto wall = tree.from(V(5, 5, 1), V(-1, 0, 0));
    for (std::size_t i = 0; i < panels.size(); ++i) CHECK((wall.pdf(i) > 0) == (panels[i].lower.x < T(5)));
}

TEMPLATE_TEST_CASE("a light tree is the same in any unit of length and of intensity", "[light_tree]", float, double) {
    using T = TestType;
    const LightTree tree{random_lights<T>(200, 4)};
    const glm::vec<3, T> point(T(0.2), T(-0.1), T(0.3)), normal(T(0), T(0.6), T(0.8));
    const auto seen = tree.from(point, normal);
    for (const double scale : {1e-15, 1e-6, 1e9, 1e15}) {
        auto lights = random_lights<T>(200, 4);
        for (auto& light : lights) {
            light.lower *= static_cast<T>(scale);
            light.upper *= static_cast<T>(scale);
            light.intensity *= static_cast<T>(1 / scale);
        }
        const LightTree other{lights};
        const auto scaled = other.from(point * static_cast<T>(scale), normal);
        double worst = 0, sum = 0;
        for (std::size_t i = 0; i < tree.size(); ++i) {
            worst = std::max(worst, double{std::abs(scaled.pdf(i) - seen.pdf(i))});
            sum += double{seen.pdf(i)};
        }
        INFO("scale " << scale);
        CHECK(worst <= 1e-3);
        CHECK(sum > 0.5);
    }
}

TEMPLATE_TEST_CASE("degenerate lights and points", "[light_tree]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    constexpr T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    const LightBounds<T> one{V(T(1)), V(T(1)), T(2)};
    const auto with = [&](auto change) {
        std::vector<LightBounds<T>> lights(3, one);
        change(lights[1]);
        return refusal(lights);
    };
    CHECK(with([](auto&) {}) == "accepted");
    CHECK(with([](auto& l) { l.intensity = T(-1); }).find("the intensity of light 1 is -1") != std::string::npos);
    CHECK(with([&](auto& l) { l.intensity = nan; }).find("the intensity of light 1 is nan") != std::string::npos);
    CHECK(with([&](auto& l) { l.intensity = inf; }).find("the intensity of light 1 is inf") != std::string::npos);
    CHECK(with([&](auto& l) { l.upper.y = inf; }).find("a bound of light 1 is inf") != std::string::npos);
    CHECK(with([&](auto& l) { l.lower.z = nan; }).find("a bound of light 1 is nan") != std::string::npos);
    CHECK(with([](auto& l) { l.lower.x = T(2); }).find("the lower bound of light 1 is 2") != std::string::npos);
    CHECK(with([&](auto& l) { l.axis.x = nan; }).find("axis of light 1 is nan") != std::string::npos);
    CHECK(with([](auto& l) { l.cos_cone = T(3); }).find("cos_cone of light 1 is 3") != std::string::npos);

    // None at all, and none that is lit.
    for (const auto& tree :
         {LightTree<T>{}, LightTree<T>{std::vector<LightBounds<T>>{}}, LightTree<T>{std::vector<LightBounds<T>>(3)}}) {
        CHECK(tree.empty());
        CHECK(tree.from(V(T(0))).empty());
        CHECK(tree.from(V(T(0))).sample(glm::vec<1, T>{T(0.5)}).pdf == 0);
        CHECK(tree.from(V(T(0))).pdf(0) == 0);
    }

    // All at one place: as the intensities are, also where they are.
    std::vector<LightBounds<T>> together(100, one);
    together[7].intensity = T(100);
    together[8].intensity = T(0);
    const LightTree tree{together};
    CHECK(tree.levels() <= 8);
    for (const V& point : {V(T(0)), V(T(1)), V(T(1e6))}) {
        const auto seen = tree.from(point);
        CHECK(std::abs(double{seen.pdf(0)} - 2.0 / 296) <= 1e-4 * 2.0 / 296 + 0x1p-23);
        CHECK(std::abs(double{seen.pdf(7)} - 100.0 / 296) <= 1e-4);
        CHECK(seen.pdf(8) == 0);
        CHECK(seen.pdf(100) == 0);
        CHECK(seen.pdf(~std::size_t{}) == 0);
    }
    // Beyond where squares of distances are numbers, and on lights of no extent.
    constexpr T far_out = (std::numeric_limits<T>::max)() / 8;
    const LightTree mixed{random_lights<T>(50, 5)};
    for (const V& point : {V(far_out), V(T(-1e25), T(0), T(0)), V((std::numeric_limits<T>::min)())}) {
        double sum = 0;
        for (std::size_t i = 0; i < 50; ++i) sum += double{mixed.from(point).pdf(i)};
        CHECK(sum >= 0.2);
        CHECK(sum <= 1);
    }
}

TEMPLATE_TEST_CASE("a light tree raises no floating-point exceptions", "[light_tree]", float, double) {
    using T = TestType;
    using V = glm::vec<3, T>;
    const LightTree tree{random_lights<T>(100, 7)}, together{std::vector<LightBounds<T>>(5, {V(T(1)), V(T(1)), T(2)})};
    CHECK(exceptions_raised_by([&] {
              for (const T x : {T(0), T(1), T(-0.3), T(1e9), T(1e-20)}) {
                  for (const auto& one : {tree.view(), together.view()}) {
                      const auto seen = one.from(V(unknown(x)), V(0, 0, unknown(T(1))));
                      for (const T u : {T(0), T(0.4), T(1)}) keep(seen.sample(glm::vec<1, T>{unknown(u)}));
                      for (std::size_t i = 0; i < one.size(); ++i) keep(one.from(V(unknown(x))).pdf(i));
                  }
              }
          }) == 0);
}

TEST_CASE("a light tree is shallow wherever the lights are", "[light_tree]") {
    // Each light is half as far away as the one before: halves by place would leave one light on one side.
    std::vector<LightBounds<double>> lights(600);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        lights[i].lower = lights[i].upper = glm::dvec3(std::ldexp(1.0, 300 - static_cast<int>(i)), 0, 0);
        lights[i].intensity = std::ldexp(1.0, 300 - static_cast<int>(i));
    }
    const LightTree tree{lights};
    CHECK(tree.levels() <= 31);
    CHECK(LightTree{points<float>(20'000, 1)}.levels() <= 12);
    const auto seen = tree.from(glm::dvec3{0});
    double sum = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        CHECK(seen.pdf(i) > 0);
        sum += seen.pdf(i);
    }
    CHECK(std::abs(sum - 1) <= 1e-12);
}

TEST_CASE("a light tree seen from a point in each lane", "[light_tree][lanes]") {
    using Four = lumis::Lanes<float, 4>;
    const LightTree tree{random_lights<float>(100, 8)};
    RandomPoints random{9};
    const auto lanes = [&] { return Four::of_lanes([&](auto) { return static_cast<float>(random.number(0, 1)); }); };
    const glm::vec<3, Four> points{lanes(), lanes(), lanes()}, normals{Four{0}, Four{0}, Four{1}};
    const glm::vec<1, Four> u{lanes()};
    const auto check = [&](const auto& seen, auto alone) {
        const auto drawn = seen.sample(u);
        const Four pdf = seen.pdf(drawn.value);
        for (std::size_t i = 0; i < 4; ++i) {
            const auto one = alone(glm::vec3{points.x[i], points.y[i], points.z[i]}).sample(glm::vec1{u.x[i]});
            CHECK(drawn.value[i] == one.value);
            CHECK(drawn.pdf[i] == one.pdf);
            CHECK((pdf[i] == one.pdf || !(one.pdf > 0)));
            CHECK(seen[i].pdf(one.value) == pdf[i]);
        }
        CHECK(seen.size() == 100);
    };
    check(tree.from(points), [&](const glm::vec3& point) { return tree.from(point); });
    check(tree.from(points, normals), [&](const glm::vec3& point) { return tree.from(point, {0, 0, 1}); });
}

TEST_CASE("a view of a light tree draws the same from copies of its arrays", "[light_tree]") {
    const LightTree tree{random_lights<float>(100, 6)};
    Copies copies;
    const auto view = tree.view(copies);
    static_assert(std::is_trivially_copyable_v<lumis::LightTreeView<float>>);
    static_assert(std::is_trivially_copyable_v<decltype(view.from({}))>);
    CHECK(copies.size() == 2);
    const auto here = tree.from(glm::vec3{0}, {0, 0, 1}), there = view.from(glm::vec3{0}, {0, 0, 1});
    for (std::size_t i = 0; i < tree.size(); ++i) {
        CHECK(here.pdf(i) == there.pdf(i));
        const glm::vec1 u{static_cast<float>(i) / 100};
        CHECK(here.sample(u).value == there.sample(u).value);
    }
}

}  // namespace
