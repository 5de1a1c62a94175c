#include "assertions.hpp"
#include "catch.hpp"
#include <lumis/core/frame.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using lumis::Direction;
using lumis::Frame;

namespace {

// All over the sphere, along the axes of either sign of zero, and closer and closer to both poles and to the equator.
template <class T>
std::vector<Direction<T>> normals() {
    std::vector<Direction<T>> result;
    for (const T zero : {T(0), -T(0)}) {
        for (const T one : {T(1), T(-1)}) {
            result.insert(result.end(), {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}});
        }
    }
    for (int exponent = 1; exponent <= 160; ++exponent) {
        const T tiny = std::ldexp(T(1), -exponent);
        for (const T z : {T(1), T(-1)}) {
            result.push_back(glm::normalize(Direction<T>{tiny, 0, z}));
            result.push_back(glm::normalize(Direction<T>{-tiny, tiny / 3, z}));
            result.push_back(glm::normalize(Direction<T>{T(0.6), T(-0.8), z * tiny}));
        }
    }
    std::mt19937 engine{1};
    std::normal_distribution<T> normal;
    for (int i = 0; i < 10'000; ++i) {
        result.push_back(glm::normalize(Direction<T>{normal(engine), normal(engine), normal(engine)}));
    }
    return result;
}

}  // namespace

TEMPLATE_TEST_CASE("a frame is orthonormal and right-handed about any normal", "[frame]", float, double) {
    using T = TestType;
    const T tolerance = 4 * std::numeric_limits<T>::epsilon();
    for (const auto& normal : normals<T>()) {
        const Frame<T> frame{normal};
        INFO("normal " << normal.x << ", " << normal.y << ", " << normal.z);
        REQUIRE(frame.normal() == normal);
        REQUIRE(std::abs(glm::length(frame.tangent()) - 1) <= tolerance);
        REQUIRE(std::abs(glm::length(frame.bitangent()) - 1) <= tolerance);
        REQUIRE(std::abs(glm::dot(frame.tangent(), frame.bitangent())) <= tolerance);
        REQUIRE(std::abs(glm::dot(frame.tangent(), normal)) <= tolerance);
        REQUIRE(std::abs(glm::dot(frame.bitangent(), normal)) <= tolerance);
        REQUIRE(glm::length(glm::cross(frame.tangent(), frame.bitangent()) - normal) <= tolerance);
    }
}

TEMPLATE_TEST_CASE("to the world and back", "[frame]", float, double) {
    using T = TestType;
    const T tolerance = 8 * std::numeric_limits<T>::epsilon();
    std::mt19937 engine{2};
    std::normal_distribution<T> random;
    for (const auto& normal : normals<T>()) {
        const Frame<T> frame{normal};
        const auto w = glm::normalize(Direction<T>{random(engine), random(engine), random(engine)});
        REQUIRE(glm::length(frame.to_local(frame.to_world(w)) - w) <= tolerance);
        REQUIRE(glm::length(frame.to_world(frame.to_local(w)) - w) <= tolerance);
        REQUIRE(std::abs(glm::length(frame.to_world(w)) - 1) <= tolerance);
        REQUIRE(glm::length(frame.to_world({0, 0, 1}) - normal) <= tolerance);
        REQUIRE(glm::length(frame.to_local(normal) - Direction<T>{0, 0, 1}) <= tolerance);
    }
}

TEST_CASE("a frame takes three vectors as they are", "[frame]") {
    constexpr Frame<float> frame{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
    static_assert(frame.to_world({1, 2, 3}) == Direction<float>{3, 1, 2});
    CHECK(frame.to_local({3, 1, 2}) == Direction<float>{1, 2, 3});
    CHECK(frame.tangent() == Direction<float>{0, 1, 0});
    CHECK(frame.bitangent() == Direction<float>{0, 0, 1});
}
