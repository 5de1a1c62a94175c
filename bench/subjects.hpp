// What the kernels work on: random numbers and directions made beforehand, and the lights and surfaces of one scene.
#pragma once

#include "kernel.hpp"
#include <lumis/lumis.hpp>

#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <type_traits>
#include <vector>

template <class T>
inline constexpr const char* scalar_name = std::is_same_v<T, float> ? "float" : "double";

// How many passes' worth of different numbers there are. A table that outgrows the caches must not be asked for the same
// thousand of its entries over and over.
inline constexpr std::size_t few = 1, many = 1024;

template <class T>
[[nodiscard]] std::span<const T> part(const std::vector<T>& v, std::size_t pass) {
    const std::size_t passes = v.size() / batch;
    return {v.data() + pass % passes * batch, batch};
}

// Each component in an array of its own.
template <class T>
struct Uniforms {
    std::vector<T> x, y;

    explicit Uniforms(std::size_t passes, unsigned seed = 1) : x(passes * batch), y(passes * batch) {
        lumis::Uniforms<std::mt19937_64, T> source{std::mt19937_64{seed}};
        for (std::size_t i = 0; i < x.size(); ++i) {
            const auto u = source.template next<2>();
            x[i] = u.x, y[i] = u.y;
        }
    }
};

// A host's sampler whose numbers are there already.
template <class T>
struct Prepared {
    const std::vector<T>& numbers;
    std::size_t position = 0;

    template <int N>
    glm::vec<N, T> next() {
        glm::vec<N, T> u;
        for (int i = 0; i < N; ++i) u[i] = numbers[position++ % batch];
        return u;
    }
};

template <class T>
struct Directions {
    std::vector<T> x, y, z;

    void add(const lumis::Direction<T>& w) { x.push_back(w.x), y.push_back(w.y), z.push_back(w.z); }
};

// Where a pass writes to.
template <class T>
struct Results {
    std::vector<T> x = std::vector<T>(batch), y = x, z = x, pdf = x, weight = x;
};

// Off its support a strategy may tell a density of 0 early, so neither kind of direction alone would do.
template <class S>
[[nodiscard]] auto half_own_half_anywhere(const S& strategy, std::size_t passes) {
    using T = typename S::Scalar;
    const Uniforms<T> own{passes, 1}, any{passes, 2}, coin{passes, 3};
    Directions<T> directions;
    for (std::size_t i = 0; i < own.x.size(); ++i) {
        const auto sample = strategy.sample({own.x[i], own.y[i]});
        const bool drawn = coin.x[i] < T(0.5) && sample.pdf > 0;
        directions.add(drawn ? sample.value : lumis::direction_at(2 * any.x[i], any.y[i]));
    }
    return directions;
}

template <class T>
struct Scene {
    using Vector = glm::vec<3, T>;

    Vector origin{0, 0, 0};
    Vector wo = glm::normalize(Vector{1, T(0.5), 1});
    glm::vec<2, T> alpha{T(0.2), T(0.4)};
    lumis::Triangle<T> triangle{{-1, -1, 2}, {1, -1, 2}, {0, 1, 3}};
    lumis::Parallelogram<T> rectangle{{-1, -1, 2}, {2, 0, 0}, {0, 2, 1}};
    lumis::Disk<T> disk{{1, 0, 2}, {0, T(0.6), T(-0.8)}, 1};
    lumis::Sphere<T> sphere{{1, 0, 3}, 1};
};

// A smooth sky with a small sun in it, which gives about as much light as the rest.
template <class T>
[[nodiscard]] std::vector<T> sky(int width, int height) {
    std::vector<T> luminance;
    luminance.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        const double v = (y + 0.5) / height;
        for (int x = 0; x < width; ++x) {
            const bool sun = std::hypot((x + 0.5) / width - 0.3, (v - 0.25) / 2) < 0.003;
            luminance.push_back(static_cast<T>(1.2 - v + (sun ? 1e4 : 0.0)));
        }
    }
    return luminance;
}
