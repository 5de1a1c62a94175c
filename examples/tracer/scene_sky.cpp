// Spheres of rising roughness under an environment map: a mirror, four rough metals, chalk.
#include "environment.hpp"
#include "materials.hpp"
#include "scene_renderer.hpp"
#include "scenes.hpp"

namespace tracer {

namespace {

class Sky {
  public:
    using Material = std::variant<Diffuse, Metal, Mirror>;

    explicit Sky(const Image& map)
        : environment_{map},
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

    [[nodiscard]] const Geometry& geometry() const { return geometry_; }
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

}  // namespace

std::unique_ptr<Renderer> make_sky(const SceneOptions& options) {
    const std::string file =
        options.environment.empty() ? LUMIS_EXAMPLES_DATA "/venice_sunset_1k.hdr" : options.environment;
    return std::make_unique<SceneRenderer<Sky>>(Sky{read_image(file)}, options,
                                                Camera{{0, 3.2f, 16}, {0, 1, 0}, {0, 1, 0}, 24});
}

}  // namespace tracer
