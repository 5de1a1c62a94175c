// The renderer's scene: the triangles of an OBJ file, which Embree finds, under a sky.
#pragma once

#include "material.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace host {

struct Triangle {
    Vec a, b, c;
    std::size_t material;
    std::size_t light;  // its place in Scene::lights, if it emits

    [[nodiscard]] Vec normal() const { return normalized(cross(b - a, c - a)); }
    [[nodiscard]] float area() const { return length(cross(b - a, c - a)) / 2; }
};

struct Hit {
    float distance;
    Vec position, normal;  // the geometric normal, on the ray's side
    const Triangle* triangle;
};

// Radiance from infinitely far away. Row 0 is at +y: v = acos(y) / pi, u = 1/2 + atan2(z, x) / (2 pi); nearest texel.
struct Sky {
    int width = 1, height = 1;
    std::vector<Vec> texels{Vec{}};  // row by row

    [[nodiscard]] Vec radiance(const Vec& w) const;
};
[[nodiscard]] Sky read_sky(const std::string& file);  // .hdr, .exr or .png

struct Scene {
    // Emission is Ke of the materials, the coat is Pr and Ni. Throws std::runtime_error for a file that cannot be read.
    Scene(const std::string& obj_file, Sky its_sky);

    [[nodiscard]] std::optional<Hit> closest(const Vec& origin, const Vec& direction) const;
    [[nodiscard]] bool occluded(const Vec& origin, const Vec& direction, float distance) const;
    [[nodiscard]] const Material& material(const Triangle& triangle) const { return materials[triangle.material]; }
    [[nodiscard]] const Triangle& light(std::size_t i) const { return triangles[lights[i]]; }

    Sky sky;
    std::vector<Material> materials;
    std::vector<Triangle> triangles;
    std::vector<std::size_t> lights;  // the triangles that emit, alike to both sides

  private:
    std::shared_ptr<RTCDeviceTy> device_;
    std::shared_ptr<RTCSceneTy> embree_;
};

}  // namespace host
