// A diffuse plane at the height 0 under lights of every kind, whose irradiance is known: the radiance of each point is albedo /
// pi times their sum. Each light is as bright as the caller says.
#pragma once

#include "lights/delta_lights.hpp"
#include "lights/environment.hpp"
#include "lights/sunlight.hpp"
#include "scenes/scene_parts.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <numbers>

// Radiance of the sky, of the sun and of a disk; irradiance of a beam; intensity of two points.
struct Brightness {
    glm::vec3 sky, sun, disk, beam;
    std::array<glm::vec3, 2> points;
};

template <class Background>
class LitPlane : public tracer::SceneParts<tracer::Materials<tracer::Diffuse<float>>,
                                           tracer::Lights<tracer::FewLights<tracer::Point, tracer::Delta>, Background,
                                                          tracer::FewLights<tracer::Beam, tracer::Delta>,
                                                          tracer::FewLights<lumis::Disk, lumis::ByArea>>> {
  public:
    explicit LitPlane(const Brightness& of)
        : LitPlane::SceneParts{typename LitPlane::LightTable{{}, background(of), {}, {}}} {
        using namespace tracer;
        this->geometry_.add(lumis::Parallelogram{glm::vec3{-9, 0, -9}, glm::vec3{0, 0, 18}, glm::vec3{18, 0, 0}},
                            this->materials_.add(Diffuse<float>{albedo}));
        this->geometry_.add(disk, this->lights_.template add<3>(disk, of.disk));
        this->lights_.template add<2>(Beam<float>{towards_beam}, of.beam);
        for (std::size_t i = 0; i < points.size(); ++i)
            this->lights_.template add<0>(Point<float>{points[i]}, of.points[i]);
        this->geometry_.commit();
    }

    // The radiance of a point of the plane. Lights without extent are left out if nothing finds them.
    [[nodiscard]] static glm::dvec3 radiance(const glm::dvec3& x, const Brightness& of, bool finds_all) {
        constexpr double pi = std::numbers::pi;
        // A disk parallel to the plane (Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-12) hides the sky.
        const glm::dvec3 to_disk = glm::dvec3{disk.center} - x;
        const double r2 = double{disk.radius} * double{disk.radius}, d2 = glm::dot(to_disk, to_disk);
        const double aside2 = d2 - to_disk.y * to_disk.y;
        const double share = 0.5 * (1 - (d2 - r2) / std::sqrt((d2 + r2) * (d2 + r2) - 4 * aside2 * r2));
        glm::dvec3 sum = pi * ((1 - share) * glm::dvec3{of.sky} + share * glm::dvec3{of.disk});
        sum += pi * std::pow(std::sin(double{half_angle}), 2) * double{towards_sun.y} * glm::dvec3{of.sun};
        if (finds_all) {
            sum += double{towards_beam.y} * glm::dvec3{of.beam};
            for (std::size_t i = 0; i < points.size(); ++i) {
                const glm::dvec3 to_point = glm::dvec3{points[i]} - x;
                sum += to_point.y / std::pow(glm::length(to_point), 3) * glm::dvec3{of.points[i]};
            }
        }
        return glm::dvec3{albedo} / pi * sum;
    }

    // Looks down, and sees nothing but the plane.
    [[nodiscard]] static tracer::Camera camera() { return {{0, 3, 0}, {0, 0, 0}, {0, 0, -1}, 40}; }

  private:
    static Background background(const Brightness& of) {
        const tracer::Sunlight sunlight{lumis::Sun{towards_sun, half_angle}, of.sun};
        if constexpr (std::same_as<Background, tracer::Sunlight>) {
            return sunlight;
        } else {
            return {sunlight, tracer::Environment{tracer::uniform_image(of.sky)}};
        }
    }

    static constexpr float half_angle = 0.8f;
    static constexpr glm::vec3 albedo{0.8f, 0.5f, 0.2f}, towards_sun{0.6f, 0.8f, 0}, towards_beam{0, 0.6f, -0.8f};
    static constexpr std::array<glm::vec3, 2> points{{{0.7f, 1.2f, 0.5f}, {-1.2f, 1.8f, -0.4f}}};
    static constexpr lumis::Disk<float> disk{{-4.5f, 4, 0.5f}, {0, -1, 0}, 1.8f};
};
