// The guide's table of what solid angle buys: the variance of one sample's irradiance over its square.
#include "catch.hpp"
#include <lumis/lumis.hpp>

#include <random>

namespace {

template <class Light>
double relative_variance(const Light& light) {
    lumis::Uniforms uniforms{std::mt19937{1}};
    lumis::RunningMoments<float> irradiance;
    for (int i = 0; i < 1'000'000; ++i) {
        const auto sample = light.sample(uniforms.next<2>());
        irradiance.add(sample.pdf > 0 && sample.value.z > 0 ? sample.value.z / sample.pdf : 0.0f);
    }
    return irradiance.variance() / (irradiance.mean() * irradiance.mean());
}

TEST_CASE("what solid angle buys") {
    struct Row {
        float distance;
        double square_by_area, square_by_solid_angle, sphere_by_area, sphere_by_solid_angle;
    };
    for (const auto& [distance, square_by_area, square_by_solid_angle, sphere_by_area, sphere_by_solid_angle] :
         {Row{0.1f, 42, 0.23, 180, 0.057}, Row{1, 0.25, 0.015, 7, 0.0017}, Row{10, 7e-5, 4.4e-6, 2.1, 1.4e-6}}) {
        using lumis::AreaLight, lumis::BySolidAngle;
        const lumis::Parallelogram<float> square{{-1, -1, distance}, {2, 0, 0}, {0, 2, 0}};
        const lumis::Sphere<float> sphere{{0, 0, distance + 1}, 1};
        const glm::vec3 position{0};
        const auto near = [](double variance) { return Approx(variance).epsilon(0.08); };
        CHECK(relative_variance(AreaLight{square, position}) == near(square_by_area));
        CHECK(relative_variance(AreaLight<lumis::Parallelogram<float>, BySolidAngle>{square, position}) ==
              near(square_by_solid_angle));
        CHECK(relative_variance(AreaLight{sphere, position}) == near(sphere_by_area));
        CHECK(relative_variance(AreaLight<lumis::Sphere<float>, BySolidAngle>{sphere, position}) ==
              near(sphere_by_solid_angle));
    }

    const lumis::Parallelogram<float> wall{{1, -1, 0}, {0, 2, 0}, {0, 0, 2}};
    CHECK(relative_variance(lumis::AreaLight{wall, glm::vec3{0}}) == Approx(0.23).epsilon(0.05));
    CHECK(relative_variance(lumis::AreaLight<lumis::Parallelogram<float>, lumis::BySolidAngle>{wall, glm::vec3{0}}) ==
          Approx(0.33).epsilon(0.05));
}

}  // namespace
