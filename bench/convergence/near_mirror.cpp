#include "near_mirror.hpp"

#include <lumis/core/frame.hpp>
#include <lumis/core/spherical.hpp>
#include <lumis/microfacets/ggx.hpp>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace convergence {

namespace {

using boost::math::quadrature::gauss_kronrod;

constexpr double turn = 2 * std::numbers::pi;

}  // namespace

// The lobe is anything from a ten-thousandth to ten times as wide as the cone: the versine is integrated on a
// logarithmic scale, the azimuth by the trapezoid rule, which converges exponentially for a periodic integrand.
Answer reflected_cone(double alpha, double solid_angle) {
    const lumis::Ggx<double> ggx{glm::dvec2{alpha}};
    const lumis::Frame<double> frame{mirrored<double>()};
    constexpr int steps = 256;
    const auto ring = [&](double log_versine) {
        const double versine = std::exp(log_versine);
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            const glm::dvec3 wi = frame.to_world(lumis::direction_at(versine, i / double{steps}));
            sum += ggx.brdf(viewer<double>(), wi) * wi.z;
        }
        return sum * versine * turn / steps;
    };
    // Within a versine of 1e-16 lies a part of 1e-16 / alpha^2, which is left out.
    constexpr double smallest = 1e-16;
    double error = 0;
    const double value =
        gauss_kronrod<double, 31>::integrate(ring, std::log(smallest), std::log(solid_angle / turn), 15, 1e-10, &error);
    return {value, error + ring(std::log(smallest)), "quadrature"};
}

// Over microfacet normals, drawn as the classical sampling of D draws them (Walter et al. 2007, eqs. 35 and 36): the
// mean of G2 (wo . h) / (cos_o cos_h), where the light is above the horizon. Written out, apart from the library.
Answer reflected_hemisphere(double alpha) {
    const glm::dvec3 wo = viewer<double>();
    const auto lambda = [&](double cos_theta) {
        const double tan2 = (1 - cos_theta * cos_theta) / (cos_theta * cos_theta);
        return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
    };
    const auto worth = [&](double u, double v) {
        const double cos_h = std::sqrt((1 - u) / (1 + (alpha * alpha - 1) * u)), sin_h = std::sqrt(1 - cos_h * cos_h);
        const glm::dvec3 h{sin_h * std::cos(turn * v), sin_h * std::sin(turn * v), cos_h};
        const double cos_d = glm::dot(wo, h), cos_i = 2 * cos_d * h.z - wo.z;
        if (!(cos_d > 0 && cos_i > 0)) return 0.0;
        return cos_d / (wo.z * cos_h * (1 + lambda(wo.z) + lambda(std::min(cos_i, 1.0))));
    };
    double error = 0;
    // Both halves of the azimuth are alike.
    const double value = gauss_kronrod<double, 31>::integrate(
        [&](double u) {
            return gauss_kronrod<double, 31>::integrate([&](double v) { return 2 * worth(u, v); }, 0, 0.5, 8, 1e-10);
        },
        0, 1, 10, 1e-9, &error);
    return {value, error, "quadrature"};
}

}  // namespace convergence
