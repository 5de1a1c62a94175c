// Subjects of the laws: rough dielectrics, seen from both sides. Their chart's geometry is Snell's law in double, written
// down anew.
#pragma once

#include "scattering_subjects.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace subjects {

// A boundary, and wo on either side: n_o is the index on wo's side and n_i the other.
struct Refracting {
    glm::dvec3 wo;
    double n_o, n_i;

    Refracting(const glm::dvec3& from, double eta) : wo{from}, n_o{from.z > 0 ? 1 : eta}, n_i{from.z > 0 ? eta : 1} {}

    // A normal on wo's side bends wo to this; 0 if it reflects all.
    [[nodiscard]] glm::dvec3 refracted(const glm::dvec3& wm) const {
        const double cosine = glm::dot(wo, wm), ratio = n_o / n_i;
        const double square = 1 - ratio * ratio * (1 - cosine * cosine);
        if (!(cosine > 0 && square > 0)) return glm::dvec3{0};
        return (ratio * cosine - std::sqrt(square)) * wm - ratio * wo;
    }

    // The normal that bends wo to wi.
    [[nodiscard]] glm::dvec3 normal(const glm::dvec3& wi) const {
        return glm::normalize((n_o * wo + n_i * wi) * (n_i > n_o ? -1.0 : 1.0));
    }
};

// A chart of normals (above, +z) as one of all directions: those that the normals mirror on wo's side in the half s < 1/2,
// those that they refract in the other.
inline lumis::testing::DirectionChart scattered_chart(const glm::dvec3& wo, double eta,
                                                      const lumis::testing::DirectionChart& normals) {
    using lumis::testing::DirectionChart;
    const Refracting boundary{wo, eta};
    const double side = wo.z > 0 ? 1 : -1;
    DirectionChart chart = normals;
    chart.s_edges = {0, 0.5, 1};
    chart.at = [=, at = normals.at](double s, double t) -> DirectionChart::Place {
        const bool mirrors = s < 0.5;
        auto [wm, measure] = at(mirrors ? 2 * s : 2 * s - 1, t);
        wm *= side;
        const double cosine = glm::dot(wo, wm);
        const glm::dvec3 wi = mirrors ? 2 * cosine * wm - wo : boundary.refracted(wm);
        if (!(cosine > 0 && (mirrors ? 1 : -1) * side * wi.z > 0)) return {-wo, 0};
        if (mirrors) return {wi, 2 * 4 * cosine * measure};
        // Snell's law differentiated: across the plane of incidence and in it the angle to the normal's axis changes by
        // (n_o cos_o - n_i cos_i) / n_i and by this over cos_i.
        const double cos_i = -glm::dot(wi, wm), bend = (boundary.n_o * cosine - boundary.n_i * cos_i) / boundary.n_i;
        return {wi, 2 * measure * bend * bend / cos_i};
    };
    chart.coordinates = [=, coordinates = normals.coordinates](const glm::dvec3& w) {
        const glm::dvec3 wi = glm::normalize(w);
        const bool mirrors = wi.z * side > 0;
        const auto place = coordinates(side * (mirrors ? glm::normalize(wo + wi) : boundary.normal(wi)));
        return glm::dvec2{(place.x + (mirrors ? 0 : 1)) / 2, place.y};
    };
    return chart;
}

struct GgxDielectric {
    struct Case {
        double cosine;  // of wo; negative from below
        double azimuth;
        glm::dvec2 alpha;
        double eta;
    };
    // Glass and denser, hardly a boundary, water seen from either side, the critical angle (0.745 for glass), grazing.
    static inline const std::vector<Case> cases{
        {1, 0, {0.1, 0.1}, 1.5},       {0.7, 0.4, {0.4, 0.05}, 1.5},   {-0.7, 0.4, {0.3, 0.3}, 1.5},
        {-0.75, 1, {0.05, 0.05}, 1.5}, {0.3, 2, {0.5, 0.5}, 1 / 1.5},  {-0.05, 2, {0.3, 0.3}, 1 / 1.5},
        {0.6, 0, {0.2, 0.2}, 1.01},    {-0.6, 1, {0.5, 0.5}, 1.01},    {0.4, -1, {1, 1}, 2.4},
        {-0.95, 0, {0.5, 0.1}, 2.4},   {0.8, 0.4, {1e-3, 1e-3}, 1.33}, {0.01, 0, {0.2, 0.2}, 1.5},
    };

    template <class T>
    static auto make() {
        std::vector<Subject<lumis::GgxDielectric<T>>> result;
        for (const auto& [cosine, azimuth, alpha, eta] : cases) {
            const glm::dvec3 wo = direction(cosine, azimuth);
            result.push_back({label("wo ", wo, ", alpha ", alpha, ", eta ", eta),
                              {glm::vec<3, T>(wo), glm::vec<2, T>(alpha), static_cast<T>(eta)},
                              scattered_chart(wo, eta, normals_chart(alpha)),
                              std::nullopt});
            const Refracting boundary{wo, eta};
            const double side = wo.z > 0 ? 1 : -1;
            // Next to the critical angle the refracted ray turns as a square root does, and magnifies what is rounded.
            if (fused && boundary.n_o > boundary.n_i) result.back().batch_distance = 1024;
            result.back().integrand = [=](const glm::dvec3& wi) {
                if (wi.z * side > 0) return true;
                const glm::dvec3 wm = boundary.normal(wi);
                return wm.z * side > 0 && glm::dot(boundary.refracted(wm), wi) > 0.5;
            };
        }
        return result;
    }
};

}  // namespace subjects
