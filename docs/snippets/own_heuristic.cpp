// A heuristic of one's own.
#include "catch.hpp"
#include "z_test.hpp"
#include <lumis/lumis.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <span>

namespace {

// All weight to the last technique that could have drawn the point: with the light last, what it can draw is its own.
struct LastThatCan {
    template <std::floating_point T, std::size_t N>
    T operator()(std::size_t own, std::span<const T, N> densities) const noexcept {
        std::size_t last = densities.size();
        while (last > 0 && !(densities[last - 1] > 0)) --last;
        return last == own + 1 ? T(1) : T(0);
    }
};

TEST_CASE("a heuristic of one's own") {
    const lumis::Parallelogram square{glm::vec3{-1, -1, 1}, glm::vec3{2, 0, 0}, glm::vec3{0, 2, 0}};
    const lumis::AreaLight light{square, glm::vec3{0}};
    const lumis::CosineHemisphere<float> bsdf;

    const auto direct = multi_sample(LastThatCan{}, lumis::take(1, bsdf), lumis::take(1, light));
    const auto cosine = [](const glm::vec3& w) { return w.z > 0 ? w.z : 0.0f; };  // under a white sky
    const auto law =
        z_test<float>([&](auto& uniforms) { return direct.estimate(cosine, uniforms); }, std::numbers::pi, 1);
    INFO(law.message);
    CHECK(law.passed);
    const std::array<float, 2> densities{0.5f, 0};
    CHECK(LastThatCan{}(0, std::span{densities}) == 1);
}

}  // namespace
