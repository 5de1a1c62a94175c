#include "catch.hpp"
#include "combined_subjects.hpp"
#include "z_test.hpp"
#include <lumis/lumis.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <variant>
#include <vector>

using glm::vec3;
using lumis::choose;
using lumis::take;

namespace {

using Ball = lumis::AreaLight<lumis::Sphere<float>, lumis::BySolidAngle>;
using Square = lumis::AreaLight<lumis::Parallelogram<float>>;
using Cosine = lumis::CosineHemisphere<float>;
using Lobes = lumis::Mixture<Cosine, lumis::UniformHemisphere<float>>;
using AnyLight = lumis::VariantStrategy<std::variant<Ball, Square>>;
using Anything = lumis::VariantStrategy<std::variant<Cosine, Ball, Lobes>>;

const Ball ball{{{0, 0, 3}, 1}, vec3{0}};
const Square square{{{-1, -1, 1}, {2, 0, 0}, {0, 2, 0}}, vec3{0}};
const Lobes lobes{choose(0.5, Cosine{}), choose(0.5, lumis::UniformHemisphere<float>{})};
constexpr float infinity = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("a variant of strategies draws what the one in it draws", "[variant_strategy]") {
    STATIC_REQUIRE(lumis::LightStrategy<AnyLight>);
    STATIC_REQUIRE(lumis::Strategy<Anything>);
    STATIC_REQUIRE(AnyLight::dimensions == 2);
    STATIC_REQUIRE(Anything::dimensions == 3);
    STATIC_REQUIRE(std::is_trivially_copyable_v<Anything>);
    STATIC_REQUIRE(std::is_same_v<decltype(lumis::VariantStrategy{std::variant<Cosine, Ball>{}}.variant()),
                                  const std::variant<Cosine, Ball>&>);
    STATIC_REQUIRE_FALSE(lumis::LightStrategy<lumis::VariantStrategy<std::variant<Cosine, Lobes>>>);

    for (const float x : {0.0f, 0.3f, 0.9f}) {
        const auto of_ball = AnyLight{ball}.sample({x, 0.4f});
        const auto alone = ball.sample({x, 0.4f});
        CHECK(of_ball.value == alone.value);
        CHECK(of_ball.pdf == alone.pdf);
        CHECK(of_ball.distance == alone.distance);
        CHECK(AnyLight{square}.sample({x, 0.4f}).distance == square.sample({x, 0.4f}).distance);
        CHECK(AnyLight{square}.sample_point({x, 0.4f}).pdf == square.sample({x, 0.4f}).pdf);
        // The alternative that takes fewer numbers takes the first ones.
        CHECK(Anything{Cosine{}}.sample({x, 0.4f, 0.7f}).value == Cosine{}.sample({x, 0.4f}).value);
        CHECK(Anything{lobes}.sample({x, 0.4f, 0.7f}).value == lobes.sample({x, 0.4f, 0.7f}).value);
        CHECK(Anything{lobes}.sample({x, 0.4f, 0.7f}).distance == infinity);
    }
    const vec3 w = glm::normalize(vec3{0.1f, 0.1f, 1});
    CHECK(AnyLight{ball}.pdf(w) == ball.pdf(w));
    CHECK(AnyLight{square}.pdf(w) == square.pdf(w));
    CHECK(AnyLight{square}.distance_along(w) == square.distance_along(w));
    CHECK(Anything{Cosine{}}.distance_along(w) == infinity);
}

TEST_CASE("a variant tells the surface of a light that does", "[variant_strategy]") {
    using Textured = lumis::SurfaceLight<lumis::Parallelogram<float>>;
    using Either = lumis::VariantStrategy<std::variant<Textured, Ball>>;
    STATIC_REQUIRE(lumis::SurfaceStrategy<Either>);
    const Textured textured{{{-1, -1, 1}, {2, 0, 0}, {0, 2, 0}}, vec3{0}};
    const auto sample = Either{textured}.sample({0.25f, 0.75f}), alone = textured.sample({0.25f, 0.75f});
    CHECK(sample.surface.uv == alone.surface.uv);
    CHECK(sample.surface.position == alone.surface.position);
    const vec3 w = glm::normalize(vec3{0.1f, 0.2f, 1});
    CHECK(Either{textured}.hit_along(w).surface.uv == textured.hit_along(w).surface.uv);
    CHECK(Either{ball}.hit_along(w).distance == ball.distance_along(w));
    CHECK(Either{ball}.sample({0.25f, 0.75f}).surface.uv == glm::vec2{0});
}

// The irradiance of a square (Lambert) and of a sphere that half the sky hides nothing of; see the guide's snippet.
TEST_CASE("variants combine: in sets, in mixtures, in frames, in estimators", "[variant_strategy]") {
    const Ball aside{{{2, 0, 0}, 1}, vec3{0}};
    constexpr double of_square = 1.740839502734, of_ball = 0.0905860737;
    const lumis::LightSet set{std::vector{AnyLight{square}, AnyLight{aside}}, std::vector<float>{2, 1}};
    const lumis::Mixture mixture{choose(0.5, AnyLight{square}), choose(0.5, AnyLight{aside})};
    const lumis::Frame upside_down{vec3{1, 0, 0}, vec3{0, -1, 0}, vec3{0, 0, -1}};
    const auto turned = lumis::in_frame(upside_down, set);

    const auto check = [](const auto& lights, float side, std::uint64_t seed) {
        const auto direct =
            lumis::multi_sample(lumis::PowerHeuristic{}, take(1, lights),
                                take(1, Anything{lumis::VariantStrategy{std::variant<Cosine, Ball, Lobes>{lobes}}}));
        const auto irradiance = [&](const lumis::AnySample auto& s) {
            const float cosine = side * s.value.z;
            return std::isinf(s.distance) || cosine <= 0 ? 0.0f : cosine;
        };
        const auto law =
            z_test<float>([&](auto& u) { return direct.estimate(irradiance, u); }, of_square + of_ball, seed, 3);
        INFO(law.message);
        CHECK(law.passed);
    };
    check(set, 1, 1);
    check(mixture, 1, 2);
    check(turned, -1, 3);
}
