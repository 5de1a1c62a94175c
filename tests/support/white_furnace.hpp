// What a GGX surface with Fresnel reflectance 1 reflects of a white sky (single scattering), by the textbook's formulas in
// double and quadrature over its normals, without the library.
#pragma once

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <numbers>

namespace white_furnace {

// Heitz 2014, eq. 86, anisotropic.
inline double lambda(const glm::dvec3& w, const glm::dvec2& alpha) {
    const double x = alpha.x * w.x / w.z, y = alpha.y * w.y / w.z;
    return (-1 + std::sqrt(1 + x * x + y * y)) / 2;
}

// The directional albedo. With wi = reflect(wo, wm) the integrand D G2 / (4 wo.z) dwi is G2 (wo.wm) / (wo.z wm.z) times
// D wm.z dwm, and that last product is dr^2 dphi / (2 pi) in the disk that GGX stretches by alpha.
inline double albedo(const glm::dvec3& wo, const glm::dvec2& alpha) {
    using boost::math::quadrature::gauss_kronrod;
    constexpr double pi = std::numbers::pi;
    const auto reflected = [&](double r2, double phi) {
        const double r = std::sqrt(r2);
        const glm::dvec3 wm =
            glm::normalize(glm::dvec3{alpha.x * r * std::cos(phi), alpha.y * r * std::sin(phi), std::sqrt(1 - r2)});
        const glm::dvec3 wi = 2 * glm::dot(wo, wm) * wm - wo;
        if (!(wi.z > 0 && wm.z > 0)) return 0.0;
        return glm::dot(wo, wm) / (wo.z * wm.z) / (1 + lambda(wo, alpha) + lambda(wi, alpha));
    };
    const auto over_r2 = [&](double phi) {
        return gauss_kronrod<double, 31>::integrate([&](double r2) { return reflected(r2, phi); }, 0, 1, 6, 1e-7);
    };
    // In pieces, so that no symmetry of the integrand can hide from the nodes.
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
        sum += gauss_kronrod<double, 31>::integrate(over_r2, i * pi / 2, (i + 1) * pi / 2, 4, 1e-7);
    }
    return sum / (2 * pi);
}

}  // namespace white_furnace
