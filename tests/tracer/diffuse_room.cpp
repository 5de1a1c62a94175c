// The least a scene can be: diffuse walls under one light. What its object file contains is looked at, see symbols.cmake.
#include "scene_renderer.hpp"

namespace tracer {

namespace {

class DiffuseRoom {
  public:
    using Material = std::variant<Diffuse>;

    DiffuseRoom() {
        geometry_.add(lumis::Parallelogram{glm::vec3{-5, -1, -5}, glm::vec3{10, 0, 0}, glm::vec3{0, 0, 10}}, {0});
        geometry_.add(light_, {0, glm::vec3{4}});
        geometry_.commit();
    }

    [[nodiscard]] const Geometry& geometry() const { return geometry_; }
    [[nodiscard]] const Material& material(const Surface& /*surface*/) const { return white_; }
    [[nodiscard]] static glm::vec3 background(const glm::vec3& /*w*/) { return glm::vec3{0}; }
    [[nodiscard]] auto lights_at(const Vertex& vertex) const {
        using Strategy = lumis::AreaLight<lumis::Parallelogram<float>>;
        return std::tuple{Light<Strategy>{Strategy{light_, vertex.position}, true}};
    }

  private:
    Material white_ = Diffuse{glm::vec3{0.7f}};
    lumis::Parallelogram<float> light_{{-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}};
    Geometry geometry_;
};

}  // namespace

std::unique_ptr<Renderer> make_diffuse_room(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<DiffuseRoom>>(DiffuseRoom{}, options,
                                                        Camera{{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40});
}

}  // namespace tracer
