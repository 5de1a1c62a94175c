// Directions and roughnesses that GGX is asked about.
#pragma once

#include "measured.hpp"

#include <cmath>

namespace stability {

template <class T>
[[nodiscard]] lumis::Direction<T> towards(double theta, double phi) {
    return {static_cast<T>(std::sin(theta) * std::cos(phi)), static_cast<T>(std::sin(theta) * std::sin(phi)),
            static_cast<T>(std::cos(theta))};
}

// In the x-z plane, at a cosine to the normal that may be tiny.
template <class T>
[[nodiscard]] lumis::Direction<T> at_cosine(double cosine, double phi = 0.3) {
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    return {static_cast<T>(sine * std::cos(phi)), static_cast<T>(sine * std::sin(phi)), static_cast<T>(cosine)};
}

// Roughness, isotropic and not, down to the least roughness, one axis 0, and far beyond 1.
template <class T, class Visit>
void for_each_alpha(Visit visit) {
    sweep(1e-6, 1, 6, [&](double alpha) {
        visit(glm::vec<2, T>{glm::dvec2{alpha, alpha}});
        visit(glm::vec<2, T>{glm::dvec2{alpha, std::sqrt(alpha)}});
    });
    for (const glm::dvec2 alpha : {glm::dvec2{0, 0}, {0, 0.5}, {1, 0}, {1e4, 1e4}, {1e-4, 1e4}}) {
        visit(glm::vec<2, T>{alpha});
    }
}

// Straight up, slanted, and grazing to 1e-6.
template <class Visit>
void for_each_cosine(Visit visit) {
    visit(1.0);
    sweep(1e-6, 0.999, 6, visit);
}

}  // namespace stability
