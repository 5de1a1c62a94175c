// GGX under light from all around, at five roughnesses, and a near-mirror plate under a small light.
#include "near_mirror.hpp"
#include <lumis/directions/cosine_hemisphere.hpp>
#include <lumis/lights/area_light_by_solid_angle.hpp>
#include <lumis/microfacets/ggx_reflection.hpp>

#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace {

using namespace convergence;

lumis::GgxReflection<double> reflection(double alpha) {
    return {viewer<double>(), glm::dvec2{alpha}};
}

Problem furnace(double alpha, const std::string& text) {
    const lumis::GgxReflection<double> bsdf = reflection(alpha);
    const auto f = [ggx = bsdf.ggx()](const glm::dvec3& wi) {
        return wi.z > 0 ? ggx.brdf(viewer<double>(), wi) * wi.z : 0.0;
    };
    constexpr double mu = 0.8;  // the viewer's cosine
    const Answer answer = alpha == 1 ? Answer{1 - mu * std::log(1 + 1 / mu)} : reflected_hemisphere(alpha);
    Problem problem{"furnace", "GGX furnace, roughness " + text,
                    "A rough mirror in a white world: what it reflects at an angle of 37 degrees.", answer};
    return problem.compare(f, Technique{"bsdf", bsdf}, Technique{"cosine", lumis::CosineHemisphere<double>{}});
}

struct Furnaces {
    Furnaces() {
        using Named = std::pair<double, std::string>;
        for (const auto& [alpha, text] : std::array{Named{0.05, "0.05"}, Named{0.1, "0.1"}, Named{0.25, "0.25"},
                                                    Named{0.5, "0.5"}, Named{1, "1"}}) {
            Registered{"furnace-" + text.substr(0, 1) + text.substr(std::min<std::size_t>(text.size(), 2)),
                       [alpha = alpha, text = text] { return furnace(alpha, text); }};
        }
    }
};
const Furnaces furnaces;

// The light lies in the mirrored direction, and is smaller than the lobe: most of what the BSDF draws misses it, and what
// the light draws does not follow the lobe.
Problem near_mirror() {
    constexpr double alpha = 0.01, radius = 0.002;
    const lumis::GgxReflection<double> bsdf = reflection(alpha);
    const lumis::AreaLight<lumis::Sphere<double>, lumis::BySolidAngle> light{{mirrored<double>(), radius},
                                                                             glm::dvec3{0}};
    const auto f = [ggx = bsdf.ggx(), light](const glm::dvec3& wi) {
        return wi.z > 0 && light.pdf(wi) > 0 ? ggx.brdf(viewer<double>(), wi) * wi.z : 0.0;
    };
    Problem problem{"near-mirror", "A near-mirror under a small light",
                    "GGX of roughness 0.01 reflects a sphere of an eighth of a degree.",
                    reflected_cone(alpha, light.solid_angle())};
    const Partition by_light{[light](const glm::dvec3& wi) { return light.pdf(wi) > 0 ? 1 : 0; }};
    return problem.compare(f, by_light, Technique{"bsdf", bsdf}, Technique{"light", light});
}
const Registered plate{"near-mirror", near_mirror};

}  // namespace
