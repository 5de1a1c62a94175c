#include "geometry.hpp"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <limits>
#include <span>

namespace tracer {

namespace {

template <class T>
std::span<T> new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
    return {static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count)), count};
}

void attach(RTCScene scene, RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

}  // namespace

Geometry::Geometry()
    : device_{rtcNewDevice(nullptr), rtcReleaseDevice}, scene_{rtcNewScene(device_.get()), rtcReleaseScene} {}

void Geometry::add(const lumis::Parallelogram<float>& shape, const Surface& surface) {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_QUAD);
    const auto vertices = new_buffer<glm::vec3>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 4);
    const auto far_corner = shape.corner + shape.edge_u + shape.edge_v;
    vertices[0] = shape.corner;
    vertices[1] = shape.corner + shape.edge_u;
    vertices[2] = far_corner;
    vertices[3] = shape.corner + shape.edge_v;
    new_buffer<std::array<unsigned, 4>>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT4, 1)[0] = {0, 1, 2, 3};
    attach(scene_.get(), geometry);
    surfaces_.push_back(surface);
}

void Geometry::add(const lumis::Sphere<float>& shape, const Surface& surface) {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
    new_buffer<glm::vec4>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 1)[0] = {shape.center, shape.radius};
    attach(scene_.get(), geometry);
    surfaces_.push_back(surface);
}

void Geometry::commit() {
    rtcCommitScene(scene_.get());
}

std::optional<Hit> Geometry::closest(const glm::vec3& origin, const glm::vec3& direction) const {
    // A ray leaves a surface: what it meets nearer than its origin's own rounding is that surface.
    const glm::vec3 extent = glm::abs(origin);
    const float nearest = 1e-4f * glm::max(1.0f, glm::max(extent.x, glm::max(extent.y, extent.z)));

    RTCRayHit query{};
    query.ray.org_x = origin.x;
    query.ray.org_y = origin.y;
    query.ray.org_z = origin.z;
    query.ray.dir_x = direction.x;
    query.ray.dir_y = direction.y;
    query.ray.dir_z = direction.z;
    query.ray.tnear = nearest;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene_.get(), &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_.get(), &context, &query);
#endif
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{origin + query.ray.tfar * direction,
               glm::normalize(glm::vec3{query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z}), &surfaces_[query.hit.geomID]};
}

}  // namespace tracer
