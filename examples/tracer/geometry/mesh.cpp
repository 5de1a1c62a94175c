#include "geometry/mesh.hpp"

#include "images/image.hpp"

#include <glm/common.hpp>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>

namespace tracer {

namespace {

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_color(const glm::vec3& v) {
    return is_finite(v) && v.x >= 0 && v.y >= 0 && v.z >= 0;
}

MeshMaterial material_of(const tinyobj::material_t& m, const std::string& path) {
    const auto vec = [](const auto& v) { return glm::vec3{v[0], v[1], v[2]}; };
    MeshMaterial material{vec(m.diffuse), vec(m.emission)};
    if (!is_color(material.albedo) || !is_color(material.emission)) {
        throw FileError(path + ": a colour of the material " + m.name + " is negative or no number");
    }
    material.albedo = glm::min(material.albedo, 1.0f);
    const glm::vec3 gloss = vec(m.specular);
    if (m.roughness > 0) {
        material.alpha = m.roughness;
    } else if (std::max({gloss.x, gloss.y, gloss.z}) > 0 && m.shininess > 0) {
        material.alpha = std::sqrt(2 / (m.shininess + 2));  // Walter et al. 2007, section 5.2
    }
    material.alpha = std::min(material.alpha, 1.0f);
    if (m.ior > 1) material.index = m.ior;
    return material;
}

}  // namespace

Mesh read_mesh(const std::string& path) {
    tinyobj::ObjReader reader;
    if (!reader.ParseFromFile(path)) {
        const std::string why = reader.Error();
        throw FileError("cannot read " + path + (why.empty() ? "" : ": " + why.substr(0, why.find('\n'))));
    }
    Mesh mesh;
    for (const tinyobj::material_t& material : reader.GetMaterials()) {
        mesh.materials.push_back(material_of(material, path));
    }
    mesh.materials.emplace_back();
    const auto& vertices = reader.GetAttrib().vertices;
    for (const tinyobj::shape_t& shape : reader.GetShapes()) {
        const auto corner = [&](std::size_t i) {
            const auto at = 3 * static_cast<std::size_t>(shape.mesh.indices[i].vertex_index);
            if (at + 2 >= vertices.size()) throw FileError(path + ": a face has a corner that is none of its vertices");
            const glm::vec3 v{vertices[at], vertices[at + 1], vertices[at + 2]};
            if (!is_finite(v)) throw FileError(path + ": a vertex is infinite or no number");
            return v;
        };
        for (std::size_t i = 0; i < shape.mesh.material_ids.size(); ++i) {
            mesh.triangles.push_back({corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)});
            const auto material = static_cast<std::size_t>(shape.mesh.material_ids[i]);  // -1: none
            mesh.material_of.push_back(std::min(material, mesh.materials.size() - 1));
        }
    }
    if (mesh.triangles.empty()) throw FileError(path + ": there is no face in it");
    return mesh;
}

}  // namespace tracer
