// What every scene consists of; its constructor fills it in.
#pragma once

#include "geometry/geometry.hpp"
#include "lights/lights.hpp"
#include "materials/material_table.hpp"
#include "materials/materials.hpp"
#include "paths/camera.hpp"

#include <utility>

namespace tracer {

template <class Materials, class Lights>
class SceneParts {
  public:
    using MaterialTable = Materials;
    using LightTable = Lights;

    [[nodiscard]] const Geometry& geometry() const { return geometry_; }
    [[nodiscard]] const MaterialTable& materials() const { return materials_; }
    [[nodiscard]] const LightTable& lights() const { return lights_; }

  protected:
    SceneParts() = default;
    explicit SceneParts(Lights lights) : lights_{std::move(lights)} {}

    Geometry geometry_;
    MaterialTable materials_;
    LightTable lights_;
};

}  // namespace tracer
