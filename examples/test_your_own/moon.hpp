#pragma once
#include <lumis/core/sample.hpp>
#include <lumis/core/strategy.hpp>

#include <cmath>
#include <numbers>

// Minnaert's moon (1941): f = albedo (k + 1) / (2 pi) (cos_o cos_i)^(k - 1), with wi drawn in proportion to cos_i^k.
struct Moon {
    static constexpr float pi = std::numbers::pi_v<float>;
    using Scalar = float;
    using Point = glm::vec3;
    using Measure = lumis::measure::SolidAngle;
    static constexpr int dimensions = 2;
    struct Drawn {
        glm::vec3 value;
        float pdf, weight;
    };
    glm::vec3 wo;
    float albedo, k;

    float f(const glm::vec3& out, const glm::vec3& in) const noexcept {
        return out.z > 0 && in.z > 0 ? albedo * (k + 1) / (2 * pi) * std::pow(out.z * in.z, k - 1) : 0.0f;
    }
    float pdf(const glm::vec3& wi) const noexcept {
        return wi.z > 0 ? lumis::density_or_zero((k + 1) / (2 * pi) * std::pow(wi.z, k)) : 0.0f;
    }
    Drawn sample(glm::vec2 u) const noexcept {
        const float z = std::pow(u.x, 1 / (k + 1)), r = std::sqrt(1 - z * z);
        const glm::vec3 wi{r * std::cos(2 * pi * u.y), r * std::sin(2 * pi * u.y), z};
        return {wi, pdf(wi), z > 0 ? albedo * std::pow(wo.z, k - 1) : 0.0f};
    }
};
