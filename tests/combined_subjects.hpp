// Subjects of the laws: tables over [0, 1], [0, 1]^2 and indices, and what is combined from many strategies.
#pragma once

#include "subject.hpp"
#include <lumis/lumis.hpp>

#include <cstddef>
#include <random>
#include <type_traits>
#include <utility>
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

struct PiecewiseConstant1D {
    template <class T>
    static auto make() {
        std::vector<Subject<lumis::PiecewiseConstant1D<T>>> result;
        for (const auto& [name, values] : weights<T>()) {
            result.push_back({name, lumis::PiecewiseConstant1D{values}, lumis::testing::interval_chart(values.size())});
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
        const auto light = [](const glm::dvec3& corner, const glm::dvec3& edge_u, const glm::dvec3& edge_v) {
            return Light{lumis::Parallelogram<T>{V(corner), V(edge_u), V(edge_v)}, V(T(0))};
        };
        const std::vector<Light> lights{
            light({-1, -1, 1}, {1.5, 0, 0}, {0, 1.5, 0}), light({-2, -2, -1}, {4, 0, 0}, {0, 4, 0}),
            light({0, 0, 2}, {2, 0, 0}, {0.5, 2, 0}), light({1, -1, -0.5}, {0, 2, 0}, {0, 0, 1})};
        const std::vector<T> weights{T(1), T(0), T(2), T(0.5)};
        using S = decltype(lumis::LightSet{std::vector<Light>{}, std::vector<T>{}});
        std::vector<Subject<S>> result;
        result.push_back({"", lumis::LightSet{std::vector<Light>{lights}, std::vector<T>{weights}},
                          lumis::testing::sphere_chart(), 1.0, 3e-5});
        return result;
    }
};

// One part of probability 0; one time in ten nothing is drawn.
struct Mixture {
    template <class T>
    static auto make() {
        using V = glm::vec<3, T>;
        const lumis::AreaLight triangle{lumis::Triangle<T>{V(0, 0, 1), V(1, 0, 1), V(0, 1, 1)}, V(T(0))};
        const lumis::AreaLight<lumis::Sphere<T>, lumis::BySolidAngle> sphere{
            lumis::Sphere<T>{V(T(1.5), T(0.5), T(0.5)), T(1)}, V(T(0))};
        const lumis::Mixture mixture{lumis::choose(0.5, triangle), lumis::choose(0, lumis::CosineHemisphere<T>{}),
                                     lumis::choose(0.4, sphere)};
        std::vector<Subject<std::remove_const_t<decltype(mixture)>>> result;
        result.push_back({"", mixture, lumis::testing::sphere_chart(), 0.9, 1e-5});
        return result;
    }
};

}  // namespace subjects
