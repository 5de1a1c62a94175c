// Lights that are hard to serve: two of unlike power, and one seen almost edge-on.
#include "irradiance.hpp"
#include <lumis/combine/mixture.hpp>

#include <array>

namespace {

using namespace convergence;
using glm::dvec3;

// The strong one is far and the weak one near, so that both matter alike, which their power alone does not tell.
Problem two_lights() {
    const lumis::Sphere<double> strong{dvec3{6, 0, 8}, 0.1}, weak{dvec3{-0.18, 0, 0.24}, 0.1};
    constexpr double radiance = 1000;
    const lumis::AreaLight<lumis::Sphere<double>, lumis::BySolidAngle> to_strong{strong, dvec3{0}},
        to_weak{weak, dvec3{0}};
    const auto f = [=](const dvec3& w) {
        if (!(w.z > 0)) return 0.0;
        return (to_strong.pdf(w) > 0 ? radiance : to_weak.pdf(w) > 0 ? 1.0 : 0.0) * w.z;
    };
    // Above the horizon a sphere gives pi (radius / distance)^2 times the cosine at its centre, here 0.8 for both.
    const double answer = std::numbers::pi * 0.8 * (radiance * 0.01 * 0.01 + 1.0 / 9);
    const Technique first{"strong light", to_strong, false}, second{"weak light", to_weak, false};
    const double by_power = radiance / (radiance + 1);
    Problem problem{
        "lights", "Two lights, one of a thousand times the power",
        "The strong light is far and the weak one near: they matter alike, which their power does not tell. "
        "Each light's technique sees that light alone.",
        Answer{answer}};
    return problem
        .compare(f, Partition{[to_weak](const dvec3& w) { return to_weak.pdf(w) > 0 ? 1 : 0; }}, first, second)
        .alone(f, Technique{"cosine", lumis::CosineHemisphere<double>{}})
        .alone(f, Technique{"chosen by power",
                            lumis::Mixture{lumis::choose(by_power, to_strong), lumis::choose(1 - by_power, to_weak)}});
}
const Registered two{"two-lights", two_lights};

// A parallelogram whose plane passes the origin at a hundredth of its distance.
Problem edge_on() {
    const dvec3 corner{2, -1, 1}, across{0, 2, 0}, away{2, 0, 1.02};
    const std::array corners{corner, corner + across, corner + across + away, corner + away};
    return irradiance(
        "lights", "A light almost edge-on",
        "A rectangle seen at a slant of half a degree: a sliver, of whose points the near ones count most.",
        lumis::Parallelogram{corner, across, away}, irradiance_of_polygon(corners));
}
const Registered edge{"edge-on", edge_on};

}  // namespace
