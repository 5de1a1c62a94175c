#include "geometry/mesh.hpp"

#include "images/image.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
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

// No area is left of it. Products of floats neither overflow nor vanish in double.
bool is_degenerate(const lumis::Triangle<float>& triangle) {
    const glm::dvec3 a{triangle.a}, b{triangle.b}, c{triangle.c};
    return glm::cross(b - a, c - a) == glm::dvec3{0};
}

MeshMaterial material_of(const tinyobj::material_t& m, const std::string& path) {
    const auto vec = [](const auto& v) { return glm::vec3{v[0], v[1], v[2]}; };
    MeshMaterial material{vec(m.diffuse), vec(m.emission)};
    if (!is_color(material.albedo) || !is_color(material.emission)) {
        throw FileError(path + ": a colour of the material " + m.name + " is negative or no number");
    }
    if (!m.diffuse_texname.empty() && material.albedo == glm::vec3{0}) material.albedo = MeshMaterial{}.albedo;
    material.albedo = glm::min(material.albedo, 1.0f);
    const glm::vec3 gloss = vec(m.specular);
    if (m.roughness > 0) {
        material.alpha = m.roughness;
    } else if (std::max({gloss.x, gloss.y, gloss.z}) > 0 && m.shininess > 0) {
        material.alpha = std::sqrt(2 / (m.shininess + 2));  // Walter et al. 2007, section 5.2
    }
    material.alpha = std::min(material.alpha, 1.0f);
    if (m.ior > 1) material.index = std::min(m.ior, 100.0f);
    return material;
}

Placement placement_of(const glm::vec3& lower, const glm::vec3& upper) {
    const auto largest = [](const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
    const glm::vec3 center = 0.5f * lower + 0.5f * upper;
    const double half = 0.5 * largest(glm::dvec3{upper} - glm::dvec3{lower});
    const int exponent = std::ilogb(half);
    return {largest(center) > 2 * half ? center : glm::vec3{0},
            std::ldexp(1.0f, std::min(std::clamp(exponent, 0, 20) - exponent, 127))};
}

std::vector<std::string> notes_on(const tinyobj::ObjReader& reader) {
    std::vector<std::string> notes;
    const std::string& warning = reader.Warning();
    if (!warning.empty()) notes.push_back(warning.substr(0, warning.find('\n')));
    const auto note = [&](const char* text, auto is_asked) {
        if (std::ranges::any_of(reader.GetMaterials(), is_asked)) notes.emplace_back(text);
    };
    note("textures are left out", [](const auto& m) { return !m.diffuse_texname.empty(); });
    note("what is transparent (d, Tr) is shown opaque", [](const auto& m) { return m.dissolve < 1; });
    note("what is metallic (Pm) is shown coated", [](const auto& m) { return m.metallic > 0; });
    return notes;
}

}  // namespace

Mesh read_mesh(const std::string& path) {
    tinyobj::ObjReader reader;
    if (!reader.ParseFromFile(path)) {
        const std::string why = reader.Error();
        throw FileError("cannot read " + path + (why.empty() ? "" : ": " + why.substr(0, why.find('\n'))));
    }
    Mesh mesh;
    mesh.notes = notes_on(reader);
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
            const lumis::Triangle<float> triangle{corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)};
            if (is_degenerate(triangle)) continue;
            mesh.triangles.push_back(triangle);
            const auto material = static_cast<std::size_t>(shape.mesh.material_ids[i]);  // -1: none
            mesh.material_of.push_back(std::min(material, mesh.materials.size() - 1));
        }
    }
    if (mesh.triangles.empty()) throw FileError(path + ": there is no face in it");
    mesh.lower = mesh.upper = mesh.triangles.front().a;
    for (const auto& [a, b, c] : mesh.triangles) {
        mesh.lower = glm::min(mesh.lower, glm::min(a, glm::min(b, c)));
        mesh.upper = glm::max(mesh.upper, glm::max(a, glm::max(b, c)));
    }
    const Placement& placed = mesh.placement = placement_of(mesh.lower, mesh.upper);
    for (glm::vec3* end : {&mesh.lower, &mesh.upper}) *end = placed(*end);
    for (auto& [a, b, c] : mesh.triangles) a = placed(a), b = placed(b), c = placed(c);
    return mesh;
}

}  // namespace tracer
