// A Cornell box: one rectangular light, a diffuse box and a glossy one.
#pragma once

#include "camera.hpp"
#include "direct_light.hpp"
#include "materials.hpp"

#include <glm/trigonometric.hpp>

#include <cstddef>
#include <span>
#include <tuple>
#include <variant>
#include <vector>

namespace tracer {

class Cornell {
  public:
    using Material = std::variant<Diffuse, Coated>;

    Cornell() {
        const std::size_t white = add(Diffuse{glm::vec3{0.73f}});
        const std::size_t red = add(Diffuse{{0.63f, 0.06f, 0.05f}});
        const std::size_t green = add(Diffuse{{0.14f, 0.45f, 0.09f}});
        const std::size_t glossy = add(Coated{{0.1f, 0.2f, 0.45f}, 0.1f, 1.6f});

        const glm::vec3 x{2, 0, 0}, y{0, 2, 0}, z{0, 0, 2}, corner{-1};
        geometry_.add(lumis::Parallelogram{corner, x, z}, {white});      // floor
        geometry_.add(lumis::Parallelogram{corner + y, x, z}, {white});  // ceiling
        geometry_.add(lumis::Parallelogram{corner, x, y}, {white});      // back
        geometry_.add(lumis::Parallelogram{corner, y, z}, {red});        // left
        geometry_.add(lumis::Parallelogram{corner + x, y, z}, {green});  // right
        add_box({-0.36f, -1, -0.32f}, {0.6f, 1.2f, 0.6f}, 18, glossy);
        add_box({0.36f, -1, 0.34f}, {0.6f, 0.6f, 0.6f}, -17, white);
        geometry_.add(light_, {white, glm::vec3{18, 14, 8}});
        geometry_.commit();
    }

    [[nodiscard]] static Camera camera() { return {{0, 0, 3.9f}, {0, 0, 0}, {0, 1, 0}, 39}; }
    [[nodiscard]] const Geometry& geometry() const { return geometry_; }
    [[nodiscard]] std::span<const Material> materials() const { return materials_; }
    [[nodiscard]] const Material& material(const Surface& surface) const { return materials_[surface.material]; }
    [[nodiscard]] static glm::vec3 background(const glm::vec3& /*w*/) { return glm::vec3{0}; }

    [[nodiscard]] auto lights_at(const Vertex& vertex) const {
        const auto height = [&](const glm::vec3& v) { return glm::dot(v, vertex.frame.normal()); };
        const float highest_corner = height(light_.corner - vertex.position) + std::max(height(light_.edge_u), 0.0f) +
                                     std::max(height(light_.edge_v), 0.0f);
        using Strategy = lumis::AreaLight<lumis::Parallelogram<float>>;
        return std::tuple{Light<Strategy>{Strategy{light_, vertex.position}, highest_corner > 0}};
    }

  private:
    std::size_t add(const Material& material) {
        materials_.push_back(material);
        return materials_.size() - 1;
    }

    // A box that stands on the middle of its base, turned about the vertical.
    void add_box(const glm::vec3& base, const glm::vec3& size, float degrees, std::size_t material) {
        const float c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
        const glm::vec3 x{size.x * c, 0, -size.x * s}, y{0, size.y, 0}, z{size.z * s, 0, size.z * c};
        const glm::vec3 corner = base - 0.5f * (x + z);
        geometry_.add(lumis::Parallelogram{corner + y, x, z}, {material});
        for (const auto& [from, along] : {std::pair{corner, x}, {corner + z, x}, {corner, z}, {corner + x, z}}) {
            geometry_.add(lumis::Parallelogram{from, along, y}, {material});
        }
    }

    lumis::Parallelogram<float> light_{{-0.25f, 0.9f, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f}};
    Geometry geometry_;
    std::vector<Material> materials_;
};

}  // namespace tracer
