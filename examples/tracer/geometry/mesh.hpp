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

struct Mesh {
    std::vector<lumis::Triangle<float>> triangles;
    std::vector<std::size_t> material_of;  // of each triangle
    std::vector<MeshMaterial> materials;   // last of all, that of faces without any
};

// Faces of more corners are cut into triangles; textures and vertex normals are left out. Throws FileError with the reason if the
// file cannot be read, holds no face, or a number that is none (infinite or NaN; a negative colour).
[[nodiscard]] Mesh read_mesh(const std::string& path);

}  // namespace tracer
