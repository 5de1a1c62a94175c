// Maps in the conventions of other programs, turned and mirrored: a host that looks its radiance up by its own formula finds
// there what the map samples. And the points (u, v) that samples are drawn at.
#include "catch.hpp"
#include <lumis/core/lanes.hpp>
#include <lumis/lumis.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t width = 24, height = 12;

std::vector<double> random_texels() {
    std::mt19937_64 engine{7};
    std::uniform_real_distribution<double> uniform{0.1, 1};
    std::vector<double> texels(width * height);
    for (double& texel : texels) texel = uniform(engine);
    return texels;
}

// The radiance's integral over the sphere.
double flux_of(const std::vector<double>& texels) {
    double sum = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const double top = pi * static_cast<double>(i / width) / height, bottom = top + pi / height;
        sum += texels[i] * 2 * pi / width * (std::cos(top) - std::cos(bottom));
    }
    return sum;
}

// How a program finds the place on the image of a direction, in full turns and with v from the top row, by its own documents.
struct Convention {
    std::string name;
    std::function<glm::dvec2(const glm::dvec3&)> uv;
    glm::dvec3 x, y, z;  // where the map's axes point
    bool is_mirrored;
};

const std::vector<Convention>& conventions() {
    static const double c = std::cos(0.7), s = std::sin(0.7);
    static const std::vector<Convention> all{
        {"Lumis",
         [](const glm::dvec3& w) {
             return glm::dvec2{0.5 + std::atan2(w.z, w.x) / (2 * pi), std::acos(w.y) / pi};
         },
         {1, 0, 0},
         {0, 1, 0},
         {0, 0, 1},
         false},
        {"OpenEXR, UsdLux",
         [](const glm::dvec3& w) {
             return glm::dvec2{0.5 - std::atan2(w.x, w.z) / (2 * pi), std::acos(w.y) / pi};
         },
         {0, 0, 1},
         {0, 1, 0},
         {-1, 0, 0},
         false},
        {"Cycles",
         [](const glm::dvec3& w) {
             return glm::dvec2{0.5 - std::atan2(w.y, w.x) / (2 * pi), std::acos(w.z) / pi};
         },
         {1, 0, 0},
         {0, 0, 1},
         {0, -1, 0},
         false},
        {"pbrt-v3",
         [](const glm::dvec3& w) {
             const double phi = std::atan2(w.y, w.x);
             return glm::dvec2{(phi < 0 ? phi + 2 * pi : phi) / (2 * pi), std::acos(w.z) / pi};
         },
         {-1, 0, 0},
         {0, 0, 1},
         {0, -1, 0},
         true},
        {"turned by 0.7 about +y",
         [](const glm::dvec3& w) {
             const double u = 0.5 + (std::atan2(w.z, w.x) + 0.7) / (2 * pi);
             return glm::dvec2{u - std::floor(u), std::acos(w.y) / pi};
         },
         {c, 0, -s},
         {0, 1, 0},
         {s, 0, c},
         false},
        {"mirrored",
         [](const glm::dvec3& w) {
             return glm::dvec2{0.5 - std::atan2(w.z, w.x) / (2 * pi), std::acos(w.y) / pi};
         },
         {1, 0, 0},
         {0, 1, 0},
         {0, 0, -1},
         true}};
    return all;
}

}  // namespace

// Radiance over density is the flux, wherever a sample falls: nothing else is if one axis is turned or mirrored.
TEMPLATE_PRODUCT_TEST_CASE("a map in a frame is the map of the convention that the frame stands for",
                           "[environment_map]", (lumis::EnvironmentMap, lumis::AliasEnvironmentMap), (float, double)) {
    using T = typename TestType::Scalar;
    const auto texels = random_texels();
    const TestType map{width, height, texels};
    const double flux = flux_of(texels);
    for (const Convention& convention : conventions()) {
        INFO(convention.name);
        CHECK((glm::dot(glm::cross(convention.x, convention.y), convention.z) < 0) == convention.is_mirrored);
        const auto looked_up = [&](const glm::vec<3, T>& w) {
            const auto uv = convention.uv(glm::dvec3(w));
            return texels[std::min(static_cast<std::size_t>(uv.y * height), height - 1) * width +
                          std::min(static_cast<std::size_t>(uv.x * width), width - 1)];
        };
        const lumis::Frame<T> frame{glm::vec<3, T>(convention.x), glm::vec<3, T>(convention.y),
                                    glm::vec<3, T>(convention.z)};
        const auto light = in_frame(frame, map);
        lumis::Uniforms<std::mt19937_64, T> uniforms{std::mt19937_64{3}};
        std::size_t wrong = 0;
        for (int i = 0; i < 2000; ++i) {
            const auto sample = light.sample(uniforms.template next<2>());
            wrong += !(std::abs(looked_up(sample.value) / double{sample.pdf} - flux) <= 1e-3 * flux);
            const auto any = lumis::UniformSphere<T>{}.sample(uniforms.template next<2>()).value;
            // A point within rounding of a texel's edge may belong to either.
            const auto uv = convention.uv(glm::dvec3(any)) * glm::dvec2(width, height);
            const auto from_edge = glm::abs(uv - glm::round(uv));
            if (std::min(from_edge.x, from_edge.y) < 1e-4) continue;
            wrong += !(std::abs(looked_up(any) - double{light.pdf(any)} * flux) <= 1e-3 * flux);
        }
        CHECK(wrong == 0);
    }
}

// The vector sum of the light, a twentieth of the whole, against the closed form: along the equator a texel adds the integral
// of sin^2(theta) over its row times that of (cos(phi), sin(phi)) over its column.
TEST_CASE("light on a surface is estimated the same by the frame and by direct look-up", "[environment_map]") {
    const auto texels = random_texels();
    const lumis::EnvironmentMap<double> map{width, height, texels};
    glm::dvec3 sum{0};
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const double a = pi * static_cast<double>(i / width) / height, b = a + pi / height;
        const double left = 2 * pi * (static_cast<double>(i % width) / width - 0.5), right = left + 2 * pi / width;
        const double ring = (b - a) / 2 - (std::sin(2 * b) - std::sin(2 * a)) / 4;
        const double up = (std::sin(b) * std::sin(b) - std::sin(a) * std::sin(a)) / 2 * (right - left);
        sum += texels[i] *
               glm::dvec3{ring * (std::sin(right) - std::sin(left)), up, ring * (std::cos(left) - std::cos(right))};
    }
    for (const Convention& convention : conventions()) {
        INFO(convention.name);
        const auto light = in_frame(lumis::Frame<double>{convention.x, convention.y, convention.z}, map);
        const glm::dvec3 expected = sum.x * convention.x + sum.y * convention.y + sum.z * convention.z;
        glm::dvec3 estimate{0};
        constexpr int side = 256;
        for (int i = 0; i < side * side; ++i) {
            const auto sample = light.sample({(i % side + 0.5) / side, (i / side + 0.5) / side});
            const auto uv = convention.uv(sample.value);
            const auto column = std::min(static_cast<std::size_t>(uv.x * width), width - 1);
            const auto row = std::min(static_cast<std::size_t>(uv.y * height), height - 1);
            estimate += texels[row * width + column] / sample.pdf * sample.value / double{side * side};
        }
        CHECK(glm::length(estimate - expected) <= 3e-4 * flux_of(texels));
    }
}

TEMPLATE_PRODUCT_TEST_CASE("samples know the point of the map that they were drawn at", "[environment_map]",
                           (lumis::EnvironmentMap, lumis::AliasEnvironmentMap), (float, double)) {
    using T = typename TestType::Scalar;
    using Four = lumis::Lanes<T, 4>;
    constexpr std::size_t columns = 1000, rows = 501;
    std::vector<T> texels(columns * rows);
    std::mt19937_64 engine{5};
    for (T& texel : texels) texel = static_cast<T>(engine() % 1000);
    const TestType map{columns, rows, texels};
    const double tolerance = 4 * double{std::numeric_limits<T>::epsilon()};
    std::size_t wrong = 0;
    lumis::Uniforms<std::mt19937_64, T> uniforms{engine};
    for (int i = 0; i < 20'000; ++i) {
        auto u = uniforms.template next<2>();
        if (i % 4 == 0) u.y = u.y * T(1e-4);      // rows at one pole
        if (i % 4 == 1) u.y = 1 - u.y * T(1e-4);  // and at the other
        const auto with = map.sample_uv(u);
        const auto without = map.sample(u);
        wrong += with.value != without.value || with.pdf != without.pdf || with.distance != without.distance;
        wrong += map.pdf_at(with.uv) != with.pdf;
        const auto looked_up = lumis::latlong_from_direction(with.value);
        wrong += !(std::abs(double{looked_up.y} - double{with.uv.y}) <= tolerance * 2);
        const double turns = double{looked_up.x} - double{with.uv.x};
        wrong += !(std::abs(turns - std::round(turns)) * std::sin(pi * double{looked_up.y}) <= tolerance * 2);
        const auto lanes = map.sample_uv(glm::vec<2, Four>{Four{u.x}, Four{u.y}});
        wrong += !(std::abs(lanes.uv.y[1] - with.uv.y) <= static_cast<T>(tolerance)) || lanes.pdf[3] != with.pdf;
    }
    CHECK(wrong == 0);
    const auto nothing = TestType{}.sample_uv({T(0.3), T(0.4)});
    CHECK(nothing.pdf == 0);
    CHECK((nothing.uv.x >= 0 && nothing.uv.x <= 1 && nothing.uv.y >= 0 && nothing.uv.y <= 1));
}
