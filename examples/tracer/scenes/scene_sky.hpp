// Spheres of rising roughness under an environment map: a mirror, four rough metals, chalk.
#pragma once

#include "lights/environment.hpp"
#include "scenes/scene_parts.hpp"

#include <string>

namespace tracer {

class Sky : public SceneParts<Materials<Diffuse<float>, Metal<float>, Mirror<float>>, Lights<Environment>> {
  public:
    // The environment map shipped, unless a file is named.
    explicit Sky(const std::string& file)
        : SceneParts{
              LightTable{Environment{read_image(file.empty() ? LUMIS_EXAMPLES_DATA "/venice_sunset_1k.hdr" : file)}}} {
        geometry_.add(lumis::Parallelogram{glm::vec3{-30, 0, -30}, glm::vec3{60, 0, 0}, glm::vec3{0, 0, 60}},
                      materials_.add(Diffuse<float>{glm::vec3{0.5f}}));
        add_ball(materials_.add(Mirror<float>{silver}));
        for (const float alpha : {0.01f, 0.05f, 0.15f, 0.4f}) add_ball(materials_.add(Metal<float>{silver, alpha}));
        add_ball(materials_.add(Diffuse<float>{{0.8f, 0.35f, 0.2f}}));
        geometry_.commit();
    }

    [[nodiscard]] static Camera camera() { return {{0, 3.2f, 16}, {0, 1, 0}, {0, 1, 0}, 24}; }

  private:
    // Six in a row, from left to right.
    void add_ball(const Surface& surface) {
        geometry_.add(lumis::Sphere{glm::vec3{2.2f * static_cast<float>(balls_++) - 5.5f, 1, 0}, 1.0f}, surface);
    }

    int balls_ = 0;
};

}  // namespace tracer
