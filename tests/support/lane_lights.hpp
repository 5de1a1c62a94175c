// Subjects of lane_subjects.hpp: lights, seen from a point.
#pragma once

#include "lane_numbers.hpp"
#include <lumis/lumis.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace subjects {

// A light: the numbers of its shape, and the reference point. Coordinates are near 1; shapes are met in front of, behind and
// inside them.
template <class MakeOf, std::size_t K>
struct Light {
    static constexpr std::size_t parameters = K;
    template <class R>
    static auto make(const std::array<R, K>& p) {
        return MakeOf{}(p);
    }
    template <class T>
    static std::array<T, K> random(std::mt19937& engine) {
        std::normal_distribution<double> normal;
        std::array<T, K> result;
        for (T& x : result) x = static_cast<T>(normal(engine));
        return result;
    }
    // Nothing but zeros, which has no area and is seen from itself; a number that is none, each; and numbers out of range.
    template <class T>
    static std::vector<std::array<T, K>> degenerate() {
        std::vector<std::array<T, K>> result{{}};
        std::mt19937 engine{3};
        for (std::size_t k = 0; k < K; ++k) {
            for (const T x : {not_a_number<T>, std::numeric_limits<T>::infinity(), T(0),
                              (std::numeric_limits<T>::max)(), (std::numeric_limits<T>::min)()}) {
                result.push_back(random<T>(engine));
                result.back()[k] = x;
            }
        }
        for (const auto& more : MakeOf::template degenerate<T>()) result.push_back(more);
        return result;
    }
};

template <class R, std::size_t K>
glm::vec<3, R> vector_at(const std::array<R, K>& p, std::size_t first) {
    return {p[first], p[first + 1], p[first + 2]};
}

struct MakeTriangle {
    template <class R>
    auto operator()(const std::array<R, 12>& p) const {
        return lumis::AreaLight{lumis::Triangle{vector_at(p, 0), vector_at(p, 3), vector_at(p, 6)}, vector_at(p, 9)};
    }
    // Edge-on, at a vertex, a line, a sliver, close by.
    template <class T>
    static std::vector<std::array<T, 12>> degenerate() {
        return {{1, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0},
                {1, 0, 0, 0, 1, 0, -1, 0, 0, 1, 0, 0},
                {1, 0, 1, 2, 0, 2, 3, 0, 3, 0, 0, 0},
                {1, 0, 1, 2, 0, 1, 1, T(1e-5), 1, 0, 0, 0},
                {1, 0, 0, 0, 1, 0, -1, -1, 0, 0, 0, T(1e-4)}};
    }
};
struct MakeParallelogram {
    template <class R>
    auto operator()(const std::array<R, 12>& p) const {
        return lumis::AreaLight{lumis::Parallelogram{vector_at(p, 0), vector_at(p, 3), vector_at(p, 6)},
                                vector_at(p, 9)};
    }
    template <class T>
    static std::vector<std::array<T, 12>> degenerate() {
        return {{-1, -1, 0, 2, 0, 0, 0, 2, 0, 0, 0, 0},
                {-1, -1, 0, 2, 0, 0, 0, 2, 0, -1, -1, 0},
                {-1, -1, 1, 2, 0, 0, 1, 0, 0, 0, 0, 0},
                {-1, -1, T(1e-4), 2, 0, 0, 0, 2, 0, 0, 0, 0}};
    }
};
struct MakeDisk {
    template <class R>
    auto operator()(const std::array<R, 10>& p) const {
        return lumis::AreaLight{lumis::Disk{vector_at(p, 0), vector_at(p, 3), p[9]}, vector_at(p, 6)};
    }
    // Edge-on, seen from the centre, without a radius, close by.
    template <class T>
    static std::vector<std::array<T, 10>> degenerate() {
        return {{1, 0, 0, 0, 0, 1, 0, 0, 0, 1},
                {0, 0, 0, 0, 0, 1, 0, 0, 0, 1},
                {0, 0, 1, 0, 0, 1, 0, 0, 0, -1},
                {0, 0, T(1e-4), 0, 0, 1, 0, 0, 0, 1}};
    }
};
template <class Sampling>
struct MakeSphere {
    template <class R>
    auto operator()(const std::array<R, 7>& p) const {
        return lumis::AreaLight<lumis::Sphere<R>, Sampling>{{vector_at(p, 0), lumis::real::abs(p[6])}, vector_at(p, 3)};
    }
    // Inside, at the centre, on the surface and just above it; of no radius.
    template <class T>
    static std::vector<std::array<T, 7>> degenerate() {
        return {{0, 0, 0, T(0.3), 0, 0, 1},
                {0, 0, 0, 0, 0, 0, 1},
                {0, 0, 0, 1, 0, 0, 1},
                {0, 0, 0, T(1.0001), 0, 0, 1},
                {0, 0, 2, 0, 0, 0, 0}};
    }
};

struct MakePointLight {
    template <class R>
    auto operator()(const std::array<R, 6>& p) const {
        return lumis::PointLight{vector_at(p, 0), vector_at(p, 3)};
    }
    template <class T>
    static std::vector<std::array<T, 6>> degenerate() {
        return {{1, 2, 3, 1, 2, 3}};
    }
};

}  // namespace subjects
