// A parallelogram that emits an image: irradiance as the sum over its texels by Lambert's formula, which texel is where, dark
// texels and dark images.
#include "assertions.hpp"
#include "catch.hpp"
#include "irradiance.hpp"
#include "polygons.hpp"
#include <lumis/lights/image_light.hpp>
#include <lumis/lumis.hpp>
#include <lumis/testing/stability.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

namespace laws = lumis::testing;
using polygons::V;

// 3 x 2 texels, no two alike, one dark; on a skew screen.
constexpr int width = 3, height = 2;
template <class T>
const std::vector<T> luminance{T(1), T(0), T(7), T(2), T(0.5), T(30)};
template <class T>
const lumis::Parallelogram<T> screen{{T(1), T(-1), T(0.3)}, {T(0.2), T(2), T(0.1)}, {T(0.3), T(0.1), T(1.5)}};

template <class T>
T texel_at(const glm::vec<2, T>& uv) {
    const int x = std::min(static_cast<int>(uv.x * width), width - 1);
    const int y = std::min(static_cast<int>(uv.y * height), height - 1);
    return luminance<T>[static_cast<std::size_t>(y * width + x)];
}

template <class T>
double irradiance_of_texels() {
    const V corner{screen<T>.corner}, u = V{screen<T>.edge_u} / 3.0L, v = V{screen<T>.edge_v} / 2.0L;
    double sum = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const V p = corner + static_cast<polygons::L>(x) * u + static_cast<polygons::L>(y) * v;
            sum += double{luminance<T>[static_cast<std::size_t>(y * width + x)]} *
                   polygons::irradiance({p, p + u, p + u + v, p + v});
        }
    }
    return sum;
}

}  // namespace

TEMPLATE_TEST_CASE("irradiance from an image is that of its texels", "[image_light]", float, double) {
    using T = TestType;
    const lumis::PiecewiseConstant2D table{width, height, luminance<T>};
    const lumis::ImageLight light{screen<T>, table, glm::vec<3, T>{}};
    const auto radiance_times_cosine = [](const lumis::AnySample auto& s) {
        return texel_at(s.surface.uv) * std::max(s.value.z, T(0));
    };
    const auto alone = lumis::multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, light));
    irradiance::check_unbiased<T>(
        "alone", [&](auto& uniforms) { return alone.estimate(radiance_times_cosine, uniforms); },
        irradiance_of_texels<T>());
    const auto both = lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, lumis::CosineHemisphere<T>{}),
                                          lumis::take(1, light));
    const auto where_it_is_met = [&](const lumis::Direction<T>& w) {
        const auto hit = light.hit_along(w);
        return hit.distance < std::numeric_limits<T>::infinity() ? texel_at(hit.surface.uv) * std::max(w.z, T(0))
                                                                 : T(0);
    };
    irradiance::check_unbiased<T>(
        "beside the BSDF", [&](auto& uniforms) { return both.estimate(where_it_is_met, uniforms); },
        irradiance_of_texels<T>());
}

// Column and row of each texel: seen from far away, a texel's share of the samples is its luminance's.
TEMPLATE_TEST_CASE("texels lie where the convention says, and dark ones are not drawn", "[image_light]", float,
                   double) {
    using T = TestType;
    const lumis::PiecewiseConstant2D table{width, height, luminance<T>};
    const glm::vec<3, T> from{T(0.4), T(-0.2), T(-0.1)};
    const lumis::ImageLight light{screen<T>, table.view(), from};
    std::vector<int> drawn(luminance<T>.size());
    constexpr int n = 90;
    for (int i = 0; i < n * n; ++i) {
        const glm::vec<2, T> u{(T(i % n) + T(0.5)) / n, (T(i / n) + T(0.5)) / n};
        const auto s = light.sample(u);
        REQUIRE(s.pdf > 0);
        const glm::dvec3 position = glm::dvec3{from} + double{s.distance} * glm::dvec3{s.value};
        REQUIRE(glm::length(position - glm::dvec3{s.surface.position}) <= 1e-5);
        // Cramer's rule, from the position alone.
        const glm::dvec3 eu{screen<T>.edge_u}, ev{screen<T>.edge_v}, d = position - glm::dvec3{screen<T>.corner};
        const glm::dvec3 normal = glm::cross(eu, ev);
        const double across = glm::dot(normal, normal);
        const int x = static_cast<int>(glm::dot(glm::cross(d, ev), normal) / across * width);
        const int y = static_cast<int>(glm::dot(glm::cross(eu, d), normal) / across * height);
        ++drawn.at(static_cast<std::size_t>(y * width + x));
        const T from_hit = light.pdf_from_hit(s.distance, glm::dot(s.value, s.surface.normal), s.surface.uv);
        REQUIRE(std::abs(from_hit / s.pdf - 1) <= 32 * std::numeric_limits<T>::epsilon());
    }
    const double sum = 40.5;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        INFO("texel " << i);
        CHECK(std::abs(drawn[i] / double{n * n} - double{luminance<T>[i]} / sum) <= 0.01);
    }
    CHECK(drawn[1] == 0);
    const auto middle_of = [&](double u, double v) {
        const glm::dvec3 p = glm::dvec3{screen<T>.corner} + u * glm::dvec3{screen<T>.edge_u} +
                             v * glm::dvec3{screen<T>.edge_v} - glm::dvec3{from};
        return lumis::Direction<T>(glm::normalize(p));
    };
    CHECK(light.pdf(middle_of(0.5, 0.25)) == 0);
    CHECK(light.pdf(middle_of(0.5, 0.75)) > 0);
}

// A host that interpolates sees light where a texel itself is dark.
TEMPLATE_TEST_CASE("bilinear means cover what is looked up bilinearly", "[image_light]", float, double) {
    using T = TestType;
    const std::vector<T> means = lumis::bilinear_means(width, height, luminance<T>);
    // Its mean over each quarter of a texel by the midpoint, where it is exact.
    const auto texel = [](int x, int y) {
        return double{
            luminance<T>[static_cast<std::size_t>(std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1))]};
    };
    const auto looked_up = [&](double x, double y) {
        const double left = std::floor(x - 0.5), top = std::floor(y - 0.5), s = x - 0.5 - left, t = y - 0.5 - top;
        const int i = static_cast<int>(left), k = static_cast<int>(top);
        return (1 - t) * ((1 - s) * texel(i, k) + s * texel(i + 1, k)) +
               t * ((1 - s) * texel(i, k + 1) + s * texel(i + 1, k + 1));
    };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            double mean = 0;
            for (const double a : {0.25, 0.75}) {
                for (const double b : {0.25, 0.75}) mean += looked_up(x + a, y + b) / 4;
            }
            const double got = means[static_cast<std::size_t>(y * width + x)];
            CHECK(std::abs(got / mean - 1) <= 4 * double{std::numeric_limits<T>::epsilon()});
        }
    }
    CHECK(means[1] > 0);
    CHECK_THROWS_AS(lumis::bilinear_means(2, 1, std::vector<T>{T(1), T(-1)}), std::invalid_argument);
    CHECK(lumis::bilinear_means(1, 1, std::vector<T>{T(3)}) == std::vector<T>{T(3)});
}

TEMPLATE_TEST_CASE("images without light, and screens that are not seen", "[image_light]", float, double) {
    using T = TestType;
    const lumis::PiecewiseConstant2D table{width, height, luminance<T>};
    const lumis::PiecewiseConstant2D dark{2, 2, std::vector<T>(4)};
    const lumis::PiecewiseConstant2D<T> none;
    const glm::vec<3, T> here{};
    const auto nothing = [](const char* name, const auto& light) {
        const auto law = laws::draws_nothing(light);
        INFO(name << ": " << law.message);
        CHECK(law.passed);
    };
    nothing("dark", lumis::ImageLight{screen<T>, dark, here});
    nothing("no texels", lumis::ImageLight{screen<T>, none, here});
    nothing("of one side, from behind", lumis::ImageLight{screen<T>, table, here, lumis::Sides::One});
    const lumis::Parallelogram<T> level{{T(0), T(0), T(1)}, {T(1), T(0), T(0)}, {T(0), T(1), T(0)}};
    nothing("edge-on", lumis::ImageLight{level, table, glm::vec<3, T>{T(3), T(4), T(1)}});
    nothing("no area", lumis::ImageLight{{screen<T>.corner, screen<T>.edge_u, screen<T>.edge_u}, table, here});
    CHECK(laws::stays_finite(lumis::ImageLight{screen<T>, table, here}).passed);
}
