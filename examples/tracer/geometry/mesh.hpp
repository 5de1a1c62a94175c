// Triangles and their materials from a Wavefront OBJ file and the MTL files that it names.
#pragma once

#include <lumis/lights/shapes.hpp>

#include <glm/vec3.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace tracer {

// Kd: albedo of the base. Ke: emitted radiance. A coat of GGX roughness alpha and refractive index Ni, if Pr (the roughness)
// says so, or else Ks and Ns (the exponent of a Phong lobe).
struct MeshMaterial {
    glm::vec3 albedo{0.7f}, emission{0};
    float alpha = 0;  // 0: there is no coat
    float index = 1.5f;
};

// The place of a file's points in the scene. Rays leave a surface by a share of its distance from the origin, or of 1: a small
// mesh is enlarged, and one far from the origin is moved there.
struct Placement {
    glm::vec3 center{0};
    float scale = 1;

    [[nodiscard]] glm::vec3 operator()(const glm::vec3& point) const { return scale * (point - center); }
};

struct Mesh {
    std::vector<lumis::Triangle<float>> triangles;  // placed, and none is degenerate
    std::vector<std::size_t> material_of;           // of each triangle
    std::vector<MeshMaterial> materials;            // last of all, that of faces without any
    Placement placement;
    glm::vec3 lower, upper;          // the box of the triangles
    std::vector<std::string> notes;  // what the file asks for and does not get
};

// Faces of more corners are cut into triangles; textures, transparency and vertex normals are left out. Throws FileError with the
// reason if the file cannot be read, holds no face, or a number that is none (infinite or NaN; a negative colour).
[[nodiscard]] Mesh read_mesh(const std::string& path);

}  // namespace tracer
