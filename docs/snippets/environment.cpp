// The guide's skies: turned about the vertical, and of another convention than latitude and longitude about +y.
#include "catch.hpp"
#include <lumis/lumis.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace {

using glm::vec2, glm::vec3;

constexpr int width = 64, height = 32;

// One texel shines.
std::vector<float> one_texel(int x, int y) {
    std::vector<float> luminance(std::size_t{width} * height);
    luminance[static_cast<std::size_t>(y * width + x)] = 1;
    return luminance;
}
bool is_in_texel(const vec2& uv, int x, int y) {
    return static_cast<int>(uv.x * width) == x && static_cast<int>(uv.y * height) == y;
}

TEST_CASE("a sky") {
    const std::vector<float> luminance = one_texel(40, 5);
    const lumis::EnvironmentMap sky{width, height, luminance, {lumis::Interpolation::Bilinear}};
    CHECK(sky.sample({0.5f, 0.5f}).pdf > 0);
}

TEST_CASE("a sample's point of the map") {
    const lumis::EnvironmentMap sky{width, height, one_texel(40, 5)};
    const auto texel_at = [](const vec2& uv) { return is_in_texel(uv, 40, 5) ? 1.0f : 0.0f; };
    const vec2 u{0.2f, 0.7f};

    const auto drawn = sky.sample_uv(u);
    const float radiance = texel_at(drawn.uv);

    CHECK(radiance == 1);
}

TEST_CASE("a turned sky") {
    const lumis::EnvironmentMap sky{width, height, one_texel(40, 5)};
    const float angle = 1;

    const float c = std::cos(angle), s = std::sin(angle);
    const lumis::Frame turned{vec3{c, 0, -s}, vec3{0, 1, 0}, vec3{s, 0, c}};  // where the map's x, y and z point
    const auto light = in_frame(turned, sky);

    for (const float u : {0.0f, 0.3f, 0.9f}) {
        const vec3 wi = light.sample({u, 1 - u}).value;
        const vec2 uv = lumis::latlong_from_direction(turned.to_local(wi));  // of the radiance
        CHECK(is_in_texel(uv, 40, 5));
    }
}

// The host's images have +z above and turn clockwise, seen from there.
vec2 host_uv(const vec3& w) {
    constexpr float pi = std::numbers::pi_v<float>;
    return {0.5f - std::atan2(w.y, w.x) / (2 * pi), std::acos(w.z) / pi};
}

TEST_CASE("a sky of the host's own convention") {
    const lumis::EnvironmentMap sky{width, height, one_texel(40, 5)};

    const lumis::Frame z_up{vec3{1, 0, 0}, vec3{0, 0, 1}, vec3{0, -1, 0}};
    const auto light = in_frame(z_up, sky);
    const lumis::Frame mirrored{vec3{1, 0, 0}, vec3{0, 0, 1}, vec3{0, 1, 0}};  // if they turn the other way

    for (const float u : {0.1f, 0.3f, 0.9f}) {
        CHECK(is_in_texel(host_uv(light.sample({u, 1 - u}).value), 40, 5));
        const vec3 w = in_frame(mirrored, sky).sample({u, 1 - u}).value;
        CHECK(is_in_texel(host_uv({w.x, -w.y, w.z}), 40, 5));
    }
}

}  // namespace
