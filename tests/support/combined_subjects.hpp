// Subjects of the laws: tables over [0, 1], [0, 1]^2 and indices, and what is combined from many strategies.
#pragma once

#include "light_subjects.hpp"
#include "subject.hpp"
#include "visibility.hpp"
#include <lumis/lumis.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace subjects {

// Weights of tables: even, one, some of them 0, ten decades, and random ones.
template <class T>
std::vector<std::pair<const char*, std::vector<T>>> weights() {
    std::mt19937 engine{7};
    std::uniform_real_distribution<double> uniform{0, 1};
    std::vector<T> random(60);
    for (auto& weight : random) weight = static_cast<T>(uniform(engine));
    return {{"even", {T(1), T(1), T(1), T(1)}},
            {"one", {T(3)}},
            {"zeros", {T(0), T(2), T(0), T(0), T(1), T(0)}},
            {"ten decades", {T(1), T(1e-8), T(1), T(1e2), T(1e-4), T(0.25)}},
            {"random", random}};
}

// The one of n equal cells of [0, 1] that holds x.
inline std::size_t cell(double x, std::size_t n) {
    return std::min(static_cast<std::size_t>(x * static_cast<double>(n)), n - 1);
}

struct PiecewiseConstant1D {
    template <class T>
    static auto make() {
        std::vector<Subject<lumis::PiecewiseConstant1D<T>>> result;
        for (const auto& [name, values] : weights<T>()) {
            result.push_back({name, lumis::PiecewiseConstant1D{values}, lumis::testing::interval_chart(values.size())});
            result.back().integrand = [values = values](double x) { return values[cell(x, values.size())] > 0; };
        }
        return result;
    }
};

struct PiecewiseConstant2D {
    template <class T>
    static auto make() {
        std::vector<Subject<lumis::PiecewiseConstant2D<T>>> result;
        for (const auto& [name, values] : weights<T>()) {
            const std::size_t height = values.size() % 2 == 0 ? 2 : 1, width = values.size() / height;
            result.push_back(
                {name, lumis::PiecewiseConstant2D{width, height, values}, lumis::testing::square_chart(width, height)});
            result.back().integrand = [=, values = values](const glm::dvec2& x) {
                return values[cell(x.y, height) * width + cell(x.x, width)] > 0;
            };
        }
        return result;
    }
};

struct AliasTable {
    template <class T>
    static auto make() {
        std::vector<Subject<lumis::AliasTable<T>>> result;
        for (const auto& [name, values] : weights<T>()) {
            result.push_back({name, lumis::AliasTable{values}, lumis::testing::index_chart(values.size())});
            result.back().integrand = [values = values](std::size_t i) { return values[i] > 0; };
        }
        return result;
    }
};

// Lights of different weights that overlap, one of weight 0.
struct LightSet {
    template <class T>
    static auto make() {
        using Light = lumis::AreaLight<lumis::Parallelogram<T>, lumis::BySolidAngle>;
        using V = glm::vec<3, T>;
        const auto shape = [](const glm::dvec3& corner, const glm::dvec3& edge_u, const glm::dvec3& edge_v) {
            return lumis::Parallelogram<T>{V(corner), V(edge_u), V(edge_v)};
        };
        const std::array shapes{shape({-1, -1, 1}, {1.5, 0, 0}, {0, 1.5, 0}), shape({-2, -2, -1}, {4, 0, 0}, {0, 4, 0}),
                                shape({0, 0, 2}, {2, 0, 0}, {0.5, 2, 0}), shape({1, -1, -0.5}, {0, 2, 0}, {0, 0, 1})};
        std::vector<Light> lights;
        for (const auto& s : shapes) lights.push_back(Light{s, V(T(0))});
        const std::vector<T> weights{T(1), T(0), T(2), T(0.5)};
        using S = decltype(lumis::LightSet{std::vector<Light>{}, std::vector<T>{}});
        std::vector<Subject<S>> result;
        result.push_back({"", lumis::LightSet{std::vector<Light>{lights}, std::vector<T>{weights}},
                          lumis::testing::sphere_chart(), 1.0, 3e-5});
        result.back().integrand = [=](const glm::dvec3& w) {
            return meets(shapes[0], {})(w) || meets(shapes[2], {})(w) || meets(shapes[3], {})(w);
        };
        return result;
    }
};

// One part of probability 0; one time in ten nothing is drawn.
struct Mixture {
    template <class T>
    static auto make() {
        using V = glm::vec<3, T>;
        const lumis::Triangle<T> three_corners{V(0, 0, 1), V(1, 0, 1), V(0, 1, 1)};
        const lumis::Sphere<T> ball{V(T(1.5), T(0.5), T(0.5)), T(1)};
        const lumis::AreaLight triangle{three_corners, V(T(0))};
        const lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle> sphere{ball, V(T(0))};
        const lumis::Mixture mixture{lumis::choose(0.5, triangle), lumis::choose(0, lumis::CosineHemisphere<T>{}),
                                     lumis::choose(0.4, sphere)};
        std::vector<Subject<std::remove_const_t<decltype(mixture)>>> result;
        result.push_back({"", mixture, lumis::testing::sphere_chart(), 0.9, 1e-5});
        result.back().integrand = [=](const glm::dvec3& w) {
            return meets(three_corners, {})(w) || meets(ball, {})(w);
        };
        return result;
    }
};

// Each alternative in turn, of different dimensions: a light, and a mixture that draws nothing one time in ten.
struct VariantStrategy {
    template <class T>
    static auto make() {
        const auto light = SphereBySolidAngle::make<T>().front();
        const auto mixture = Mixture::make<T>().front();
        using S = lumis::VariantStrategy<std::variant<std::remove_cvref_t<decltype(light.strategy)>,
                                                      std::remove_cvref_t<decltype(mixture.strategy)>>>;
        std::vector<Subject<S>> result;
        const auto add = [&](const char* name, const auto& one) {
            result.push_back({name, S{one.strategy}, one.chart, one.probability, one.blur, one.agreement});
            result.back().integrand = one.integrand;
        };
        add("a light", light);
        add("a mixture", mixture);
        return result;
    }
};

}  // namespace subjects
