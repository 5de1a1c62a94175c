// Numbers, points and directions for tests of geometry, from a fixed seed.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <random>

// Evenly in [-1, 1]^3, and on the unit sphere.
class RandomPoints {
  public:
    explicit RandomPoints(std::uint64_t seed) : engine_{seed} {}

    double number(double from, double to) { return std::uniform_real_distribution<double>{from, to}(engine_); }
    glm::dvec3 point() { return {number(-1, 1), number(-1, 1), number(-1, 1)}; }
    glm::dvec3 direction() {
        glm::dvec3 p;
        do p = point();
        while (!(glm::dot(p, p) <= 1 && glm::dot(p, p) >= 0.01));
        return glm::normalize(p);
    }

  private:
    std::mt19937_64 engine_;
};
