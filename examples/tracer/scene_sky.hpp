// Spheres of rising roughness under an environment map: a mirror, four rough metals, chalk.
#pragma once

#include "camera.hpp"
#include "direct_light.hpp"
#include "environment.hpp"
#include "materials.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

namespace tracer {

class Sky {
  public:
    using Material = std::variant<Diffuse, Metal, Mirror>;

    // The environment map shipped, unless a file is named.
    explicit Sky(const std::string& file)
        : environment_{read_image(file.empty() ? LUMIS_EXAMPLES_DATA "/venice_sunset_1k.hdr" : file)},
          materials_{Diffuse{glm::vec3{0.5f}},
                     Mirror{{0.95f, 0.93f, 0.88f}},
                     Metal{{0.95f, 0.93f, 0.88f}, 0.01f},
                     Metal{{0.95f, 0.93f, 0.88f}, 0.05f},
                     Metal{{0.95f, 0.93f, 0.88f}, 0.15f},
                     Metal{{0.95f, 0.93f, 0.88f}, 0.4f},
                     Diffuse{{0.8f, 0.35f, 0.2f}}} {
        geometry_.add(lumis::Parallelogram{glm::vec3{-30, 0, -30}, glm::vec3{60, 0, 0}, glm::vec3{0, 0, 60}}, {0});
        for (std::size_t i = 1; i < materials_.size(); ++i) {
            geometry_.add(lumis::Sphere{glm::vec3{2.2f * (static_cast<float>(i) - 3.5f), 1, 0}, 1.0f}, {i});
        }
        geometry_.commit();
    }

    [[nodiscard]] static Camera camera() { return {{0, 3.2f, 16}, {0, 1, 0}, {0, 1, 0}, 24}; }
    [[nodiscard]] const Geometry& geometry() const { return geometry_; }
    [[nodiscard]] std::span<const Material> materials() const { return materials_; }
    [[nodiscard]] const Material& material(const Surface& surface) const { return materials_[surface.material]; }
    [[nodiscard]] glm::vec3 background(const glm::vec3& w) const { return environment_.radiance(w); }
    [[nodiscard]] auto lights_at(const Vertex& /*vertex*/) const {
        const auto& strategy = environment_.strategy();
        return std::tuple{Light<decltype(strategy)>{strategy, !strategy.empty()}};
    }

  private:
    Environment environment_;
    Geometry geometry_;
    std::vector<Material> materials_;
};

}  // namespace tracer
