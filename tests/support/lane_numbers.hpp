// What subjects of lane_subjects.hpp are made of.
#pragma once

#include <lumis/core/sample.hpp>

#include <glm/geometric.hpp>

#include <limits>
#include <random>

namespace subjects {

template <class T>
lumis::Direction<T> random_unit(std::mt19937& engine) {
    std::normal_distribution<double> normal;
    return lumis::Direction<T>(glm::normalize(glm::dvec3{normal(engine), normal(engine), normal(engine)}));
}

template <class T>
inline constexpr T not_a_number = std::numeric_limits<T>::quiet_NaN();

}  // namespace subjects
