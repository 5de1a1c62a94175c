// Subjects of the laws: strategies over the directions of a light.
#pragma once

#include "subject.hpp"
#include "visibility.hpp"
#include <lumis/lumis.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace subjects {

// An elliptical chart about the centre of a flat light, whose half extents are given; and the light's blur.
struct FlatView {
    lumis::testing::DirectionChart chart;
    double blur;  // in units of epsilon
};

inline FlatView view_of(const glm::dvec3& centre, const glm::dvec3& long_half, const glm::dvec3& short_half) {
    const glm::dvec3 axis = glm::normalize(centre);
    const auto across = [&](const glm::dvec3& v) { return (v - glm::dot(v, axis) * axis) / glm::length(centre); };
    const glm::dvec3 tangent = glm::normalize(across(long_half)), bitangent = glm::cross(axis, tangent);
    const glm::dvec2 widths{glm::length(across(long_half)), std::abs(glm::dot(across(short_half), bitangent))};
    const auto chart =
        lumis::testing::lobe_chart(lumis::Frame<double>{tangent, bitangent, axis}, glm::clamp(widths, 1e-6, 1.5));
    return {chart, 20 * (1 / widths.x + 1 / widths.y)};
}

struct TriangleByArea {
    template <class T>
    static auto make() {
        using V = glm::dvec3;
        struct Case {
            const char* label;
            V a, b, c, reference;
            lumis::Sides sides = lumis::Sides::Both;
        };
        const Case cases[] = {
            {"above", {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 0}},
            {"octant", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}},
            {"tilted and far", {10, 3, 20}, {12, 3, 19}, {10, 5, 21}, {1, 2, 3}},
            {"sliver", {-1, 0, 2}, {1, 0, 2}, {1, 0.002, 2}, {0, 0, 0}},
            {"tiny", {0.0001, 0, 1}, {0, 0.0001, 1}, {0, 0, 1}, {0.3, 0.2, -1}},
            {"nearly edge-on", {1, 0, 0.01}, {2, 0.5, 0.01}, {1.5, 1, 0.02}, {0, 0, 0}},
            {"of one side", {0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {0, 0, 0}, lumis::Sides::One},
        };
        std::vector<Subject<lumis::AreaLight<lumis::Triangle<T>>>> result;
        for (const auto& [name, a, b, c, reference, sides] : cases) {
            const lumis::Triangle<T> triangle{glm::vec<3, T>(a), glm::vec<3, T>(b), glm::vec<3, T>(c)};
            const auto [chart, blur] = view_of((a + b + c) / 3.0 - reference, (b - a) / 2.0, (c - a) / 2.0);
            result.push_back({name,
                              {triangle, glm::vec<3, T>(reference), sides},
                              chart,
                              1.0,
                              blur * std::numeric_limits<T>::epsilon()});
            result.back().integrand = meets(triangle, reference);
        }
        return result;
    }
};

struct ParallelogramByArea {
    template <class T>
    static auto make() {
        using V = glm::dvec3;
        struct Case {
            const char* label;
            V corner, edge_u, edge_v;
            lumis::Sides sides = lumis::Sides::Both;
        };
        const Case cases[] = {
            {"square above", {-1, -1, 1}, {2, 0, 0}, {0, 2, 0}},
            {"skew", {1, -1, 2}, {2, 0.5, 1}, {-1, 1, 0.3}},
            {"filling the view", {-1, -1, 0.05}, {2, 0, 0}, {0, 2, 0}},
            {"strip", {-3, 0.5, 1}, {6, 0, 0}, {0, 0.01, 0}},
            {"of one side", {1, -1, 2}, {-1, 1, 0.3}, {2, 0.5, 1}, lumis::Sides::One},
        };
        std::vector<Subject<lumis::AreaLight<lumis::Parallelogram<T>>>> result;
        for (const auto& [name, corner, edge_u, edge_v, sides] : cases) {
            const lumis::Parallelogram<T> shape{glm::vec<3, T>(corner), glm::vec<3, T>(edge_u), glm::vec<3, T>(edge_v)};
            const auto [chart, blur] = view_of(corner + (edge_u + edge_v) / 2.0, edge_u / 2.0, edge_v / 2.0);
            result.push_back({name, {shape, {}, sides}, chart, 1.0, blur * std::numeric_limits<T>::epsilon()});
            result.back().integrand = meets(shape, {});
        }
        return result;
    }
};

struct DiskByArea {
    template <class T>
    static auto make() {
        using V = glm::dvec3;
        struct Case {
            const char* label;
            V center, normal;
            double radius;
            lumis::Sides sides = lumis::Sides::Both;
        };
        const Case cases[] = {
            {"above", {0, 0, 1}, {0, 0, -1}, 1},
            {"tilted and far", {10, 3, 20}, {1, 2, 2}, 2},
            {"filling the view", {0.1, 0, 0.05}, {0, 0, 1}, 1},
            {"tiny", {0.3, 0.2, 1}, {0.2, 0, 1}, 1e-4},
            {"of one side", {0.3, 0.2, 1}, {0.2, 0, -1}, 0.5, lumis::Sides::One},
        };
        std::vector<Subject<lumis::AreaLight<lumis::Disk<T>>>> result;
        for (const auto& [name, center, normal, radius, sides] : cases) {
            const lumis::Frame<double> frame{glm::normalize(normal)};
            const lumis::Disk<T> disk{glm::vec<3, T>(center), glm::vec<3, T>(normal), static_cast<T>(radius)};
            const auto [chart, blur] = view_of(center, radius * frame.tangent(), radius * frame.bitangent());
            result.push_back({name, {disk, {}, sides}, chart, 1.0, blur * std::numeric_limits<T>::epsilon()});
            result.back().integrand = meets(disk, {});
        }
        return result;
    }
};

inline const glm::dvec3 sphere_direction = glm::normalize(glm::dvec3{0.3, -0.5, 0.8});
inline constexpr double half_angles[] = {0.01, 0.1, 1, 10, 45, 80, 89};  // in degrees

template <class T, class Sampling, class Probability>
auto spheres(Probability probability, bool unbounded_at_edge) {
    using S = lumis::AreaLight<lumis::Sphere<T>, Sampling>;
    std::vector<Subject<S>> result;
    for (const double degrees : half_angles) {
        const double half_angle = degrees * std::numbers::pi / 180, distance = 3;
        const lumis::Sphere<T> sphere{glm::vec<3, T>(distance * sphere_direction),
                                      static_cast<T>(distance * std::sin(half_angle))};
        result.push_back({label("half-angle ", degrees),
                          S{sphere, glm::vec<3, T>(T(0))},
                          lumis::testing::lobe_chart(sphere_direction, 1.4 * std::sin(half_angle / 2)),
                          probability(half_angle),
                          20 * std::numeric_limits<T>::epsilon() / half_angle,
                          {.unbounded_at_edge = unbounded_at_edge}});
        result.back().integrand = meets(sphere, {});
    }
    const lumis::Sphere<T> around{glm::vec<3, T>(T(0.5) * glm::vec<3, T>(sphere_direction)), T(1)};
    result.push_back({"from inside", S{around, glm::vec<3, T>(T(0))}, lumis::testing::lobe_chart(sphere_direction, 2)});
    result.back().integrand = lumis::testing::everywhere;
    return result;
}

struct SphereByArea {
    template <class T>
    static auto make() {
        return spheres<T, lumis::ByArea>([](double half_angle) { return (1 - std::sin(half_angle)) / 2; }, true);
    }
};

struct SphereBySolidAngle {
    template <class T>
    static auto make() {
        return spheres<T, lumis::BySolidAngle>([](double) { return 1.0; }, false);
    }
};

struct Sun {
    template <class T>
    static auto make() {
        std::vector<Subject<lumis::Sun<T>>> result;
        for (const double half_angle : {1e-4, 0.00465, 0.3, 2.0}) {
            result.push_back({label("half-angle ", half_angle),
                              {glm::vec<3, T>(sphere_direction), static_cast<T>(half_angle)},
                              lumis::testing::lobe_chart(sphere_direction, 1.4 * std::sin(half_angle / 2)),
                              1.0,
                              20 * std::numeric_limits<T>::epsilon() / half_angle});
            result.back().integrand = [half_angle](const glm::dvec3& w) {
                return std::atan2(glm::length(glm::cross(w, sphere_direction)), glm::dot(w, sphere_direction)) <
                       half_angle;
            };
        }
        return result;
    }
};

struct ImageLight {
    // Three by two texels, one of them dark; the chart is the screen itself.
    template <class T>
    static auto make() {
        static const lumis::PiecewiseConstant2D<T> table{3, 2, std::vector<T>{T(1), T(0), T(7), T(2), T(0.5), T(30)}};
        std::vector<Subject<lumis::ImageLight<T>>> result;
        const auto add = [&](const char* name, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v,
                             lumis::Sides sides) {
            const lumis::Parallelogram<T> shape{glm::vec<3, T>(corner), glm::vec<3, T>(u), glm::vec<3, T>(v)};
            const glm::dvec3 normal = glm::cross(u, v);
            const auto uv = [=](const glm::dvec3& w) -> glm::dvec2 {
                const glm::dvec3 d = glm::dot(corner, normal) / glm::dot(w, normal) * w - corner;
                return glm::dvec2{glm::dot(glm::cross(d, v), normal), glm::dot(glm::cross(u, d), normal)} /
                       glm::dot(normal, normal);
            };
            lumis::testing::DirectionChart chart;
            chart.at = [=](double s, double t) -> lumis::testing::DirectionChart::Place {
                const glm::dvec3 p = corner + t * u + s * v;
                const double distance = glm::length(p);
                return {p / distance, std::abs(glm::dot(p, normal)) / (distance * distance * distance)};
            };
            chart.coordinates = [=](const glm::dvec3& w) -> glm::dvec2 { return {uv(w).y, uv(w).x}; };
            chart.s_edges = {0, 0.5, 1};
            chart.t_edges = {0, 1.0 / 3, 2.0 / 3, 1};
            result.push_back({name, {shape, table, {}, sides}, chart});
            result.back().integrand = [uv, hits = meets(shape, {})](const glm::dvec3& w) {
                return hits(w) && !(uv(w).y < 0.5 && uv(w).x > 1.0 / 3 && uv(w).x < 2.0 / 3);
            };
        };
        add("square above", {-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, lumis::Sides::Both);
        add("skew, of one side", {1, -1, 2}, {-1, 1, 0.3}, {2, 0.5, 1}, lumis::Sides::One);
        return result;
    }
};

// Where a map's luminance is not 0. Compensated, a map leaves to others what is not above its mean.
template <class T>
WhereDirections lit(int width, int height, const std::vector<T>& texels, bool nearest, bool compensated) {
    // The sum of f(dx, dy) times the luminance of the texel and its neighbours.
    const auto around = [=](int x, int y, auto f) {
        double sum = 0;
        for (int dx = -1; dx <= 1; ++dx) {
            for (int dy = -1; dy <= 1; ++dy) {
                const int column = (x + dx + width) % width, row = std::clamp(y + dy, 0, height - 1);
                sum += f(dx, dy) * double{texels[static_cast<std::size_t>(row * width + column)]};
            }
        }
        return sum;
    };
    // A texel's mean, into which the bilinear function mixes 1/8 from either side.
    const auto mean_of_texel = [=](int x, int y) {
        const auto weight = [=](int d) { return nearest ? (d == 0 ? 1.0 : 0.0) : (d == 0 ? 0.75 : 0.125); };
        return around(x, y, [=](int dx, int dy) { return weight(dx) * weight(dy); });
    };
    double mean = 0;
    for (int y = 0; y < height; ++y) {
        const double half = std::numbers::pi / 2 / height,
                     share = std::sin(half * (2 * y + 1)) * std::sin(half) / width;
        for (int x = 0; x < width; ++x) mean += share * mean_of_texel(x, y);
    }
    return [=](const glm::dvec3& w) {
        const double u = (0.5 + std::atan2(w.z, w.x) / (2 * std::numbers::pi)) * width;
        const double v = std::acos(std::clamp(w.y, -1.0, 1.0)) / std::numbers::pi * height;
        const int x = static_cast<int>(std::floor(u)), y = static_cast<int>(std::floor(v));
        if (compensated && texels.size() > 1) return mean_of_texel(x, y) > (1 + 1e-5) * mean;
        const auto tent = [](double d) { return std::max(1 - std::abs(d), 0.0); };
        return around(x, y, [=](int dx, int dy) {
                   if (nearest) return dx == 0 && dy == 0 ? 1.0 : 0.0;
                   return tent(u - (x + dx + 0.5)) * tent(v - (y + dy + 0.5));
               }) > 0;
    };
}

template <bool mis_compensation, template <class> class Map = lumis::EnvironmentMap>
struct EnvironmentMaps {
    template <class T>
    static auto make() {
        std::vector<Subject<Map<T>>> result;
        const auto add = [&](const char* name, int width, int height, const std::vector<T>& texels) {
            for (const auto interpolation : {lumis::Interpolation::Nearest, lumis::Interpolation::Bilinear}) {
                const bool nearest = interpolation == lumis::Interpolation::Nearest;
                result.push_back(
                    {label(name, nearest ? ", nearest" : ", bilinear"),
                     Map<T>{width, height, texels, lumis::EnvironmentOptions{interpolation, mis_compensation}},
                     lumis::testing::latlong_chart(static_cast<std::size_t>(width), static_cast<std::size_t>(height)),
                     1.0,
                     0,
                     {.rounding = 0, .tolerance = 0}});
                result.back().integrand = lit<T>(width, height, texels, nearest, mis_compensation);
            }
        };
        std::mt19937 engine{5};
        std::uniform_real_distribution<double> uniform{0, 1};
        const auto random = [&](std::size_t size) {
            std::vector<T> texels(size);
            for (auto& texel : texels) texel = static_cast<T>(uniform(engine));
            return texels;
        };
        add("1 x 1", 1, 1, {T(3)});
        add("1 x 8", 1, 8, random(8));
        add("8 x 1", 8, 1, random(8));
        add("random", 16, 8, random(128));
        auto texels = random(128);
        texels[5 * 16 + 3] = T(1e6);
        add("hot texel", 16, 8, texels);
        texels = random(128);
        for (std::size_t x = 0; x < 16; ++x) texels[x] = T(1e4);
        add("hot pole row", 16, 8, texels);
        for (std::size_t x = 0; x < 16; ++x) texels[x] = texels[3 * 16 + x] = texels[4 * 16 + x] = T(0);
        add("black rows", 16, 8, texels);
        return result;
    }
};

using EnvironmentMap = EnvironmentMaps<false>;
using CompensatedEnvironmentMap = EnvironmentMaps<true>;
using AliasEnvironmentMap = EnvironmentMaps<false, lumis::AliasEnvironmentMap>;

}  // namespace subjects
