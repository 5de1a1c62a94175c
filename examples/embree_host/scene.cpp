#include "scene.hpp"

#include "images/image.hpp"

#include <embree3/rtcore.h>
#include <tiny_obj_loader.h>

#include <limits>
#include <stdexcept>

namespace host {

Vec Sky::radiance(const Vec& w) const {
    const float u = 0.5f + std::atan2(w.z, w.x) * std::numbers::inv_pi_v<float> / 2;
    const float v = std::acos(std::clamp(w.y, -1.0f, 1.0f)) * std::numbers::inv_pi_v<float>;
    const int column = std::min(static_cast<int>(u * static_cast<float>(width)), width - 1);
    const int row = std::min(static_cast<int>(v * static_cast<float>(height)), height - 1);
    return texels[static_cast<std::size_t>(row * width + column)];
}

Sky read_sky(const std::string& file) {
    const tracer::Image image = tracer::read_image(file);
    Sky sky{image.width, image.height, {}};
    for (const auto& pixel : image.pixels) sky.texels.push_back({pixel.x, pixel.y, pixel.z});
    return sky;
}

Scene::Scene(const std::string& obj_file, Sky its_sky)
    : sky{std::move(its_sky)},
      device_{rtcNewDevice(nullptr), rtcReleaseDevice},
      embree_{rtcNewScene(device_.get()), rtcReleaseScene} {
    tinyobj::ObjReader reader;
    if (!reader.ParseFromFile(obj_file)) throw std::runtime_error(obj_file + ": " + reader.Error());
    const auto vec = [](const auto* v) { return Vec{v[0], v[1], v[2]}; };
    for (const auto& m : reader.GetMaterials()) {
        materials.push_back({vec(m.diffuse), vec(m.emission), m.roughness, m.ior});
    }
    for (const auto& shape : reader.GetShapes()) {
        const auto corner = [&](std::size_t i) {
            return vec(&reader.GetAttrib().vertices[3 * static_cast<std::size_t>(shape.mesh.indices[i].vertex_index)]);
        };
        for (std::size_t i = 0; i < shape.mesh.material_ids.size(); ++i) {
            const auto material = static_cast<std::size_t>(shape.mesh.material_ids[i]);
            if (material >= materials.size()) throw std::runtime_error(obj_file + ": a face has no material");
            if (materials[material].emits()) lights.push_back(triangles.size());
            triangles.push_back({corner(3 * i), corner(3 * i + 1), corner(3 * i + 2), material, lights.size() - 1});
        }
    }

    const RTCGeometry mesh = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto new_buffer = [&](RTCBufferType type, RTCFormat format, std::size_t size, std::size_t count) {
        return rtcSetNewGeometryBuffer(mesh, type, 0, format, size, count);
    };
    const std::size_t count = triangles.size();
    auto* corners = static_cast<Vec*>(new_buffer(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, sizeof(Vec), 3 * count));
    auto* indices = static_cast<unsigned*>(new_buffer(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 12, count));
    for (unsigned i = 0; const Triangle& triangle : triangles) {
        for (const Vec& corner : {triangle.a, triangle.b, triangle.c}) corners[i] = corner, indices[i] = i, ++i;
    }
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(embree_.get(), mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(embree_.get());
}

// The ray starts a little off the surface that it leaves.
static RTCRay embree_ray(const Vec& origin, const Vec& direction, float distance) {
    const float nearest = 1e-4f * (1 + length(origin));
    return {origin.x, origin.y, origin.z, nearest, direction.x, direction.y, direction.z, 0, distance, ~0u, 0, 0};
}

std::optional<Hit> Scene::closest(const Vec& origin, const Vec& direction) const {
    RTCRayHit query{embree_ray(origin, direction, std::numeric_limits<float>::infinity()), {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(embree_.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const Triangle& triangle = triangles[query.hit.primID];
    const Vec normal = triangle.normal();
    return Hit{query.ray.tfar, origin + query.ray.tfar * direction, dot(normal, direction) < 0 ? normal : -normal,
               &triangle};
}

bool Scene::occluded(const Vec& origin, const Vec& direction, float distance) const {
    RTCRay query = embree_ray(origin, direction, 0.9999f * distance);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(embree_.get(), &context, &query);
    return query.tfar < 0;
}

}  // namespace host
