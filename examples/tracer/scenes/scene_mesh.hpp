// A user's own scene: the triangles of an OBJ file, which shine where their material emits, under an environment map if one is
// named, or if nothing else shines.
#pragma once

#include "geometry/mesh.hpp"
#include "lights/environment.hpp"
#include "lights/many_lights.hpp"
#include "renderer.hpp"
#include "scenes/scene_parts.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace tracer {

class MeshScene : public SceneParts<Materials<Diffuse<float>, Coated<float>>,
                                    Lights<ManyLights<lumis::Triangle, lumis::BySolidAngle>, Environment>> {
  public:
    // The room shipped, unless a mesh is named.
    explicit MeshScene(const SceneOptions& options)
        : MeshScene{read_mesh(options.mesh.empty() ? LUMIS_EXAMPLES_DATA "/room.obj" : options.mesh), options} {}

    [[nodiscard]] const Camera& camera() const { return camera_; }
    [[nodiscard]] const Placement& placement() const { return placement_; }
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

  private:
    using Light = Emitter<lumis::Triangle<float>>;

    MeshScene(const Mesh& mesh, const SceneOptions& options) : MeshScene{mesh, lights_of(mesh), options.environment} {
        if (options.mesh.empty()) camera_ = {{1.2f, 1.35f, 5.4f}, {-0.1f, 1, -0.5f}, {0, 1, 0}, 38};
    }

    MeshScene(const Mesh& mesh, const std::vector<Light>& lights, const std::string& environment)
        : SceneParts{LightTable{ManyLights<lumis::Triangle, lumis::BySolidAngle>{lights},
                                Environment{sky(environment, lights.empty())}}},
          camera_{camera_of(mesh)},
          placement_{mesh.placement},
          notes_{mesh.notes} {
        std::vector<Surface> of_material, surfaces;
        for (const MeshMaterial& m : mesh.materials) {
            of_material.push_back(m.alpha > 0 ? materials_.add(Coated<float>{m.albedo, m.alpha, m.index})
                                              : materials_.add(Diffuse<float>{m.albedo}));
        }
        std::size_t light = 0;
        for (const std::size_t material : mesh.material_of) {
            const Surface& surface = of_material[material];
            const bool shines = mesh.materials[material].emission != glm::vec3{0};
            surfaces.push_back(shines ? LightTable::surface<0>(light++, surface) : surface);
        }
        geometry_.add(mesh.triangles, surfaces);
        geometry_.commit();
    }

    [[nodiscard]] static std::vector<Light> lights_of(const Mesh& mesh) {
        std::vector<Light> lights;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const glm::vec3& emission = mesh.materials[mesh.material_of[i]].emission;
            if (emission != glm::vec3{0}) lights.push_back({mesh.triangles[i], emission});
        }
        return lights;
    }

    [[nodiscard]] static Image sky(const std::string& file, bool is_all_there_is) {
        if (file.empty() && !is_all_there_is) return uniform_image(glm::vec3{0});
        return read_image(file.empty() ? LUMIS_EXAMPLES_DATA "/venice_sunset_1k.hdr" : file);
    }

    // Looks from the front, a little from the right and above, from so far away that all of it is seen. y points up.
    [[nodiscard]] static Camera camera_of(const Mesh& mesh) {
        constexpr float field_of_view = 38;
        const glm::vec3 center = 0.5f * (mesh.lower + mesh.upper);
        const float distance = 0.5f * glm::length(mesh.upper - mesh.lower) / std::sin(glm::radians(field_of_view) / 2);
        return {center + distance * glm::normalize(glm::vec3{0.35f, 0.25f, 1}), center, {0, 1, 0}, field_of_view};
    }

    Camera camera_;
    Placement placement_;
    std::vector<std::string> notes_;
};

}  // namespace tracer
