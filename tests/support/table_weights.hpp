// Weights that tables are tested with.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

template <class T>
std::vector<T> random_weights(std::size_t size, double decades) {
    std::mt19937_64 engine{size};
    std::uniform_real_distribution<double> exponent{-decades, 0};
    std::vector<T> weights(size);
    for (auto& weight : weights) weight = static_cast<T>(std::pow(10, exponent(engine)));
    return weights;
}

// Weights of every class, zero ones first, last and in between.
template <class T>
std::vector<std::vector<T>> weight_classes() {
    std::vector<std::vector<T>> result{
        {T(1)},
        {T(0), T(3), T(0)},
        {T(1), T(1e-8), T(1)},
        {T(1), T(2), T(3), T(4), T(0), T(0), T(0)},
        std::vector<T>(7, T(0.1)),
        {std::numeric_limits<T>::max(), std::numeric_limits<T>::denorm_min(), T(1)},
        {std::numeric_limits<T>::max(), std::numeric_limits<T>::denorm_min(), std::numeric_limits<T>::max()},
        {std::numeric_limits<T>::max(), std::numeric_limits<T>::max()},
        {std::numeric_limits<T>::denorm_min(), T(0), std::numeric_limits<T>::denorm_min()},
        random_weights<T>(1000, 10)};
    for (std::size_t i = 0; i < 1000; i += 3) result.back()[i] = T(0);
    return result;
}
