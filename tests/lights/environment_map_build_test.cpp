// How environment maps are built: on a host's threads the same as in order, both kinds of rows with the same densities,
// in the memory that is promised.
#include "catch.hpp"
#include "table_weights.hpp"
#include <lumis/core/lanes.hpp>
#include <lumis/lights/environment_map.hpp>
#include <lumis/tables/piecewise_constant.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

// Four threads that take indices as they come, and from the end.
constexpr auto on_threads = [](std::size_t n, auto f) {
    std::atomic<std::size_t> taken{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([&] {
            for (std::size_t k = taken++; k < n; k = taken++) f(n - 1 - k);
        });
    }
    for (auto& thread : threads) thread.join();
};

template <class T>
std::vector<T> texels_of(std::size_t size) {
    auto texels = random_weights<T>(size, 4);
    for (std::size_t i = 0; i < size; i += 7) texels[i] = T(0);
    return texels;
}

// Whether they draw the same by every one of many uniforms, which tells all densities and positions too.
template <class Table>
bool same(const Table& a, const Table& b) {
    using T = typename Table::Scalar;
    std::mt19937_64 engine{1};
    for (int i = 0; i < 200'000; ++i) {
        const glm::vec<2, T> u{static_cast<T>(engine() >> 11) * static_cast<T>(0x1p-53),
                               static_cast<T>(engine() >> 11) * static_cast<T>(0x1p-53)};
        const auto x = a.sample(u), y = b.sample(u);
        if (!(x.value == y.value && x.pdf == y.pdf)) return false;
    }
    return true;
}

}  // namespace

TEMPLATE_PRODUCT_TEST_CASE("a map built on threads is the one built in order", "[environment_map]",
                           (lumis::EnvironmentMap, lumis::AliasEnvironmentMap), (float, double)) {
    using T = typename TestType::Scalar;
    constexpr std::size_t width = 200, height = 111;
    const auto texels = texels_of<T>(width * height);
    for (const auto interpolation : {lumis::Interpolation::Nearest, lumis::Interpolation::Bilinear}) {
        for (const bool compensation : {false, true}) {
            const lumis::EnvironmentOptions options{interpolation, compensation};
            CHECK(same(TestType{width, height, texels, options}, TestType{width, height, texels, options, on_threads}));
        }
    }
    CHECK(same(lumis::PiecewiseConstant2D{width, height, texels},
               lumis::PiecewiseConstant2D{width, height, texels, on_threads}));
}

TEMPLATE_PRODUCT_TEST_CASE("on threads too, of several bad texels the first is named", "[environment_map]",
                           (lumis::EnvironmentMap, lumis::AliasEnvironmentMap), (float, double)) {
    using T = typename TestType::Scalar;
    std::vector<T> texels(64 * 32, T(1));
    texels[700] = T(-3);
    texels[701] = texels[1500] = std::numeric_limits<T>::quiet_NaN();
    const auto make = [&] { return TestType{64, 32, texels, lumis::EnvironmentOptions{}, on_threads}; };
    CHECK_THROWS_AS(make(), std::invalid_argument);
    CHECK_THROWS_WITH(make(), Catch::Matchers::Contains("weight 700 is -3"));
}

TEMPLATE_TEST_CASE("guided and alias maps have the same densities", "[environment_map]", float, double) {
    using T = TestType;
    constexpr std::size_t width = 100, height = 50;
    const auto texels = texels_of<T>(width * height);
    const lumis::EnvironmentMap<T> guided{width, height, texels};
    const lumis::AliasEnvironmentMap<T> alias{width, height, texels};
    std::size_t different = 0, disagreeing = 0;
    std::mt19937_64 engine{2};
    for (int i = 0; i < 100'000; ++i) {
        const glm::vec<2, T> u{static_cast<T>(engine() >> 11) * static_cast<T>(0x1p-53),
                               static_cast<T>(engine() >> 11) * static_cast<T>(0x1p-53)};
        different += guided.pdf_at(u) != alias.pdf_at(u);
        const auto drawn = alias.sample(u);
        disagreeing += !(drawn.pdf > 0 && drawn.pdf == guided.pdf(drawn.value));
    }
    CHECK(different == 0);
    CHECK(disagreeing == 0);
}

TEMPLATE_PRODUCT_TEST_CASE("in lanes a point of the map has the density that it has alone", "[environment_map]",
                           (lumis::EnvironmentMap, lumis::AliasEnvironmentMap), (float, double)) {
    using T = typename TestType::Scalar;
    using Eight = lumis::Lanes<T, 8>;
    const TestType map{33, 17, texels_of<T>(33 * 17)};
    const T nan = std::numeric_limits<T>::quiet_NaN(), below_one = 1 - std::numeric_limits<T>::epsilon() / 2;
    const std::array<T, 8> numbers{T(0), T(1), below_one, T(0.3), T(-0.1), nan, T(7), T(0.5)};
    for (std::size_t shift = 0; shift < 8; ++shift) {
        const auto x = Eight::of_lanes([&](auto i) { return numbers[i]; });
        const auto y = Eight::of_lanes([&](auto i) { return numbers[(i + shift) % 8]; });
        const Eight together = map.pdf_at(glm::vec<2, Eight>{x, y});
        for (std::size_t i = 0; i < 8; ++i) CHECK(together[i] == map.pdf_at(glm::vec<2, T>{x[i], y[i]}));
    }
}

TEST_CASE("only a map whose rows are monotone can be inverted", "[environment_map]") {
    STATIC_REQUIRE(lumis::InvertibleStrategy<lumis::EnvironmentMap<float>>);
    STATIC_REQUIRE(lumis::Strategy<lumis::AliasEnvironmentMap<float>>);
    STATIC_REQUIRE_FALSE(lumis::InvertibleStrategy<lumis::AliasEnvironmentMap<float>>);
}

TEMPLATE_TEST_CASE("a map keeps no more memory than it says", "[environment_map]", float, double) {
    using T = TestType;
    for (const std::size_t width : {1u, 64u, 2048u, 70'000u}) {
        for (const std::size_t height : {1u, 3u, 32u}) {
            const std::vector<T> texels(width * height, T(1));
            const std::size_t wide_rows = sizeof(T) / sizeof(float);  // the rows' own numbers are of type T
            INFO(width << " x " << height);
            CHECK(lumis::EnvironmentMap<T>(width, height, texels).memory_bytes() <=
                  (6 * width + 12 + 16 * wide_rows) * height + 6);
            CHECK(lumis::AliasEnvironmentMap<T>(width, height, texels).memory_bytes() <=
                  (8 * width + 6 + 16 * wide_rows) * height + 6);
        }
    }
}
