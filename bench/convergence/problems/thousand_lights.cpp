// A thousand lights of which a point sees some: selected by power alone, by a light tree, exactly, and by what resampling knows of
// them besides.
#include "problem.hpp"
#include <lumis/combine/resample.hpp>
#include <lumis/lights/area_light.hpp>
#include <lumis/lights/area_light_by_solid_angle.hpp>
#include <lumis/lights/light_set.hpp>
#include <lumis/lights/light_tree.hpp>
#include <lumis/lights/selected_light.hpp>
#include <lumis/tables/alias_table.hpp>
#include <lumis/tables/discrete_table.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace convergence;
using glm::dvec3;

// A ball as the origin sees it.
struct Cap {
    dvec3 axis;
    double angle, cosine = std::cos(angle);

    [[nodiscard]] double angle_to(const dvec3& w) const { return std::acos(std::clamp(glm::dot(axis, w), -1.0, 1.0)); }
    [[nodiscard]] bool meets(const dvec3& w) const { return glm::dot(axis, w) > cosine; }
};

// The point to be lit is the origin, its normal +z. Balls in front of the lights hide each of them as a whole or not at all, so
// that the answer is a sum.
struct Scene {
    static constexpr std::size_t lights = 1000, occluders = 800;

    std::vector<lumis::Sphere<double>> balls;
    std::vector<double> radiance;
    std::vector<Cap> hidden;
    double irradiance = 0;
    lumis::AliasTable<double> by_power;
    lumis::LightTree<double> tree;

    Scene() {
        std::mt19937_64 engine{11};
        lumis::Uniforms<std::mt19937_64&, double> uniforms{engine};
        while (hidden.size() < occluders) hidden.push_back({upward(uniforms), 0.02 + 0.04 * uniforms.next<1>().x});
        std::vector<double> powers;
        std::vector<lumis::LightBounds<double>> bounds;
        while (balls.size() < lights) {
            // Distances from 2 to 20, and radiances over three decades.
            const auto u = uniforms.next<3>();
            const double distance = 2 * std::pow(10.0, u.x), emitted = std::pow(10.0, 3 * u.y),
                         radius = 0.01 + 0.04 * u.z;
            const Cap seen{upward(uniforms), std::asin(radius / distance)};
            const bool is_above = seen.axis.z > radius / distance;
            const bool is_cut = std::ranges::any_of(hidden, [&](const Cap& cap) {
                return std::abs(cap.angle_to(seen.axis) - cap.angle) <= 1.01 * seen.angle;
            });
            if (!is_above || is_cut) continue;
            balls.push_back({distance * seen.axis, radius});
            radiance.push_back(emitted);
            powers.push_back(emitted * radius * radius);
            bounds.push_back(light_bounds(balls.back(), emitted));
            if (!is_occluded(seen.axis))
                irradiance += emitted * std::numbers::pi * std::pow(radius / distance, 2) * seen.axis.z;
        }
        by_power = lumis::AliasTable<double>{powers};
        tree = lumis::LightTree{bounds};
    }

    // Takes half a microsecond, as a shadow ray through a large scene does.
    [[nodiscard]] bool is_occluded(const dvec3& w) const {
        bool met = false;
        for (const Cap& cap : hidden) met |= cap.meets(w);
        return met;
    }

  private:
    static dvec3 upward(auto& uniforms) {
        const auto u = uniforms.template next<2>();
        return lumis::direction_at(1 - u.x, u.y);
    }
};

// Radiance from a light at a direction, without shadows: what resampling is told.
[[nodiscard]] auto unoccluded(const Scene& scene) {
    return [&scene](const lumis::ToLight<dvec3>& x) { return scene.radiance[x.index] * std::max(x.direction.z, 0.0); };
}

[[nodiscard]] auto reflected(const Scene& scene) {
    return [&scene](const lumis::ToLight<dvec3>& x) {
        const double unshadowed = unoccluded(scene)(x);
        return unshadowed > 0 && !scene.is_occluded(x.direction) ? unshadowed : 0.0;
    };
}

// A light, selected by a table, and a direction to it.
[[nodiscard]] auto selected(const Scene& scene, const auto& table) {
    const auto light = [&scene](std::size_t i) {
        return lumis::AreaLight<lumis::Sphere<double>, lumis::BySolidAngle>{scene.balls[i], dvec3{0}};
    };
    return lumis::SelectedLight{lumis::LightSet{light, table}};
}

// Probabilities are what each light gives without shadows, as for a host that looks at all lights at each point.
[[nodiscard]] lumis::DiscreteTable<double> exact_table(const Scene& scene) {
    std::vector<double> given;
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
        const auto& [center, radius] = scene.balls[i];
        const double squared = glm::dot(center, center);
        given.push_back(scene.radiance[i] * radius * radius * center.z / (squared * std::sqrt(squared)));
    }
    return lumis::DiscreteTable<double>{given};
}

Problem thousand_lights() {
    const auto scene = std::make_shared<const Scene>();
    Problem problem{"lights", "A thousand lights",
                    "Small balls of radiances over three decades, at distances from 2 to 20, four in ten of them "
                    "hidden. A light is "
                    "selected by its power, by a light tree, exactly by looking at all, or by resampling lights in "
                    "proportion to what they would give without shadows; always one shadow is asked for.",
                    Answer{scene->irradiance}};
    const auto run = [scene](const auto& make_estimator) {
        return [=](std::span<double> sums, std::int64_t count, RandomNumbers& uniforms) {
            const auto f = reflected(*scene);
            for (double& sum : sums) {
                sum = 0;
                for (std::int64_t i = 0; i < count; ++i) sum += make_estimator(*scene, f, uniforms);
            }
        };
    };
    const auto alone = [](const auto& one, const auto& f, RandomNumbers& uniforms) {
        return multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, one)).estimate(f, uniforms);
    };
    problem.compete("by power", true, Recipe{"alone"}, run([=](const Scene& s, const auto& f, RandomNumbers& uniforms) {
                        return alone(selected(s, s.by_power), f, uniforms);
                    }));
    problem.compete("by tree", true, Recipe{"alone"}, run([=](const Scene& s, const auto& f, RandomNumbers& uniforms) {
                        return alone(selected(s, s.tree.from(dvec3{0}, dvec3{0, 0, 1})), f, uniforms);
                    }));
    problem.compete("exact", true, Recipe{"alone"}, run([=](const Scene& s, const auto& f, RandomNumbers& uniforms) {
                        const lumis::DiscreteTable<double> table = exact_table(s);
                        return alone(selected(s, table), f, uniforms);
                    }));
    for (const int candidates : {1, 2, 4, 8, 16, 32}) {
        problem.compete(
            "resampled " + std::to_string(candidates), true, Recipe{"resampled"},
            run([=](const Scene& s, const auto& f, RandomNumbers& uniforms) {
                return resample(unoccluded(s), lumis::take(candidates, selected(s, s.by_power))).estimate(f, uniforms);
            }));
    }
    problem.compete("tree, resampled 2", true, Recipe{"resampled"},
                    run([=](const Scene& s, const auto& f, RandomNumbers& uniforms) {
                        const auto one = selected(s, s.tree.from(dvec3{0}, dvec3{0, 0, 1}));
                        return resample(unoccluded(s), lumis::take(2, one)).estimate(f, uniforms);
                    }));
    return problem;
}
const Registered thousand{"thousand-lights", thousand_lights};

}  // namespace
