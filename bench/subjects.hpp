// What the kernels work on: random numbers and directions made beforehand, and the lights and surfaces of one scene.
#pragma once

#include <lumis/lumis.hpp>

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <type_traits>
#include <vector>

// Few enough to stay in the first cache.
inline constexpr std::size_t batch = 1024;

template <class T>
inline constexpr const char* scalar_name = std::is_same_v<T, float> ? "float" : "double";

template <int N, class T>
std::vector<glm::vec<N, T>> random_uniforms() {
    lumis::Uniforms<std::mt19937_64, T> source{std::mt19937_64{1}};
    std::vector<glm::vec<N, T>> uniforms(batch);
    for (auto& u : uniforms) u = source.template next<N>();
    return uniforms;
}

// Off its support a strategy may tell a density of 0 early, so neither kind of direction alone would do.
template <class S>
std::vector<typename S::Point> half_own_half_anywhere(const S& strategy) {
    using T = typename S::Scalar;
    const auto own = random_uniforms<S::dimensions, T>();
    lumis::Uniforms<std::mt19937_64, T> source{std::mt19937_64{2}};
    std::vector<typename S::Point> directions;
    for (const auto& u : own) {
        const auto any = source.template next<3>();
        const auto sample = strategy.sample(u);
        const bool drawn = any.z < T(0.5) && sample.pdf > 0;
        directions.push_back(drawn ? sample.value : lumis::direction_at(2 * any.x, any.y));
    }
    return directions;
}

// Shows as time for each item, in seconds with a prefix: 12n is 12 ns.
inline void count_items(benchmark::State& state, std::size_t items_each) {
    const auto items = state.iterations() * static_cast<std::int64_t>(items_each);
    state.SetItemsProcessed(items);
    state.counters["time_each"] =
        benchmark::Counter(static_cast<double>(items), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

template <class T>
struct Scene {
    using Vector = glm::vec<3, T>;

    Vector origin{0, 0, 0};
    Vector wo = glm::normalize(Vector{1, T(0.5), 1});
    glm::vec<2, T> alpha{T(0.2), T(0.4)};
    lumis::Triangle<T> triangle{{-1, -1, 2}, {1, -1, 2}, {0, 1, 3}};
    lumis::Parallelogram<T> parallelogram{{-1, -1, 2}, {2, 0, 0}, {0, 2, 1}};
    lumis::Sphere<T> sphere{{1, 0, 3}, 1};
};

// A smooth sky with a small sun in it.
template <class T>
std::vector<T> sky(int width, int height) {
    std::vector<T> luminance;
    luminance.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        const double v = (y + 0.5) / height;
        for (int x = 0; x < width; ++x) {
            const bool sun = std::hypot((x + 0.5) / width - 0.3, (v - 0.25) / 2) < 0.003;
            luminance.push_back(static_cast<T>(1.2 - v + (sun ? 5e4 : 0.0)));
        }
    }
    return luminance;
}
