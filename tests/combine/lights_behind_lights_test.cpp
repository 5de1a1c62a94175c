// Lights that hide one another. The integrand traces one shadow ray to `distance` and adds the radiance of the light that is
// nearest there; that must be right whatever is combined, whichever technique drew the direction.
#include "catch.hpp"
#include "irradiance.hpp"
#include <lumis/lumis.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace {

// A horizontal rectangle [x0, x1] x [y0, y1] above the origin, whose normal is +z.
struct Rectangle {
    double height, x0, x1, y0, y1, radiance;

    [[nodiscard]] bool meets(const glm::dvec3& w) const {
        const glm::dvec3 hit = height / w.z * w;
        return w.z > 0 && hit.x >= x0 && hit.x <= x1 && hit.y >= y0 && hit.y <= y1;
    }
    [[nodiscard]] double distance(const glm::dvec3& w) const { return height / w.z; }

    // Irradiance at the origin of a rectangle of radiance 1 (Lambert 1760): half the sum over the edges of the angle
    // that an edge subtends times the z of the unit normal to its plane through the origin.
    [[nodiscard]] double irradiance() const {
        const std::array<glm::dvec3, 4> v{{{x0, y0, height}, {x1, y0, height}, {x1, y1, height}, {x0, y1, height}}};
        double sum = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::dvec3 a = v[i], b = v[(i + 1) % 4], normal = glm::cross(a, b);
            sum += std::atan2(glm::length(normal), glm::dot(a, b)) * normal.z / glm::length(normal);
        }
        return sum / 2;
    }

    // What this one hides of a higher one: its shadow in that plane, cut to it.
    [[nodiscard]] Rectangle shadow_on(const Rectangle& far) const {
        const double scale = far.height / height;
        return {far.height,
                std::max(far.x0, scale * x0),
                std::min(far.x1, scale * x1),
                std::max(far.y0, scale * y0),
                std::min(far.y1, scale * y1),
                far.radiance};
    }

    template <class T>
    [[nodiscard]] lumis::Parallelogram<T> shape() const {
        const auto f = [](double x) { return static_cast<T>(x); };
        return {{f(x0), f(y0), f(height)}, {f(x1 - x0), T(0), T(0)}, {T(0), f(y1 - y0), T(0)}};
    }
};

struct Scene {
    Rectangle near, far;

    [[nodiscard]] double irradiance() const {
        return near.radiance * near.irradiance() + far.radiance * (far.irradiance() - near.shadow_on(far).irradiance());
    }

    // The radiance of the light `distance` away along w, unless something stands before it.
    [[nodiscard]] double radiance(const glm::dvec3& w, double distance) const {
        const bool meets_near = near.meets(w), meets_far = far.meets(w);
        constexpr double before = 1 - 1e-4;
        if (meets_near && near.distance(w) < before * distance) return 0;
        if (meets_far && far.distance(w) < before * distance) return 0;
        const auto at_distance = [&](const Rectangle& light) {
            return std::abs(distance / light.distance(w) - 1) <= 1e-4;
        };
        return meets_near && at_distance(near) ? near.radiance : meets_far && at_distance(far) ? far.radiance : 0;
    }
};

// A square wholly before a larger one, of one radiance; then one that stands out at a side, darker and brighter than what
// it hides.
const std::array<Scene, 3> scenes{{{{1, -1, 1, -1, 1, 1}, {1.5, -2, 2, -2, 2, 1}},
                                   {{1, -0.2, 1.4, -0.6, 0.9, 0.25}, {2, -1.5, 1.2, -2, 1.1, 3}},
                                   {{0.8, -1, 0.3, -0.5, 0.5, 5}, {1.7, -1, 2, -0.3, 2, 0.5}}}};

// Every way to combine the two lights, alone and with a BSDF's strategy. check(name, estimator).
template <class T>
void for_each_combination(const Scene& scene, const auto& check) {
    using namespace lumis;
    using ByArea = AreaLight<Parallelogram<T>>;
    using ByAngle = AreaLight<Parallelogram<T>, BySolidAngle>;
    const glm::vec<3, T> origin{T(0)};
    const ByArea near{scene.near.shape<T>(), origin}, far{scene.far.shape<T>(), origin};
    const ByAngle near_angle{scene.near.shape<T>(), origin}, far_angle{scene.far.shape<T>(), origin};
    const CosineHemisphere<T> bsdf;
    const BalanceHeuristic balance;
    const PowerHeuristic power;
    const std::vector<ByAngle> lights{near_angle, far_angle};
    const LightSet set{lights, std::vector<T>{1, 2}};
    const Mixture mixture{choose(0.6, near), choose(0.4, far_angle)};

    check("light set", multi_sample(balance, take(1, set)));
    check("mixture of lights", multi_sample(balance, take(1, mixture)));
    check("two techniques", multi_sample(power, take(2, near), take(1, far_angle)));
    check("one of two techniques", one_sample(balance, choose(0.5, near_angle), choose(0.5, far)));
    check("BSDF and light set", multi_sample(power, take(1, bsdf), take(1, set)));
    check("BSDF and mixture", one_sample(balance, choose(0.4, bsdf), choose(0.6, mixture)));
    check("BSDF and two lights", multi_sample(balance, take(1, bsdf), take(1, near), take(1, far_angle)));
    check("one of BSDF and two lights",
          one_sample(power, choose(0.2, bsdf), choose(0.3, near), choose(0.5, far_angle)));
    check("mixture of BSDF and lights",
          multi_sample(balance, take(1, Mixture{choose(0.2, bsdf), choose(0.4, near_angle), choose(0.4, far)})));
    check("BSDF, lights that are left out", multi_sample(balance, take(1, bsdf), take(0, near), take(0, far)));
}

}  // namespace

TEMPLATE_TEST_CASE("a shadow ray to `distance` finds what lights behind lights send", "[lights_behind_lights]", float,
                   double) {
    using T = TestType;
    for (const Scene& scene : scenes) {
        const auto integrand = [&](const lumis::AnySample auto& s) {
            const glm::dvec3 w = glm::normalize(glm::dvec3{s.value});
            return static_cast<T>(scene.radiance(w, double{s.distance}) * std::max(w.z, 0.0));
        };
        for_each_combination<T>(scene, [&](const std::string& name, const auto& estimator) {
            irradiance::check_unbiased<T>(
                name, [&](auto& uniforms) { return estimator.estimate(integrand, uniforms); }, scene.irradiance());
        });
    }
}
