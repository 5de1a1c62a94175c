// The least a scene can be: diffuse walls under one light. What its object file contains is looked at, see symbols.cmake.
#include "scene_renderer.hpp"

namespace tracer {

namespace {

class DiffuseRoom {
  public:
    using MaterialTable = Materials<Diffuse<float>>;
    using LightTable = Lights<FewLights<lumis::Parallelogram, lumis::ByArea>>;

    DiffuseRoom() {
        geometry_.add(lumis::Parallelogram{glm::vec3{-5, -1, -5}, glm::vec3{10, 0, 0}, glm::vec3{0, 0, 10}},
                      materials_.add(Diffuse<float>{glm::vec3{0.7f}}));
        const lumis::Parallelogram<float> light{{-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}};
        geometry_.add(light, lights_.add<0>(light, glm::vec3{4}));
        geometry_.commit();
    }

    [[nodiscard]] const Geometry& geometry() const { return geometry_; }
    [[nodiscard]] const MaterialTable& materials() const { return materials_; }
    [[nodiscard]] const LightTable& lights() const { return lights_; }

  private:
    Geometry geometry_;
    MaterialTable materials_;
    LightTable lights_;
};

}  // namespace

std::unique_ptr<Renderer> make_diffuse_room(const SceneOptions& options) {
    return std::make_unique<SceneRenderer<DiffuseRoom>>(DiffuseRoom{}, options,
                                                        Camera{{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40});
}

}  // namespace tracer
