#include "geometry/geometry.hpp"

#include "geometry/embree.hpp"
#include "geometry/spheres.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

namespace tracer {

namespace {

template <class T>
std::span<T> new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
    return {static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count)), count};
}

// A ray leaves a surface: what it meets nearer than its origin's own rounding is that surface.
template <lumis::Real R>
R nearest(const Vector<R>& o) {
    namespace real = lumis::real;
    return 1e-4f * real::greater(real::greater(real::abs(o.x), real::abs(o.y)), real::greater(real::abs(o.z), R(1.0f)));
}

template <lumis::Real R>
void fill(EmbreeRay<R>& to, const Ray<R>& ray, const R& farthest) {
    const Vector<R>& o = ray.origin;
    put(o.x, to.org_x);
    put(o.y, to.org_y);
    put(o.z, to.org_z);
    put(nearest(o), to.tnear);
    put(ray.direction.x, to.dir_x);
    put(ray.direction.y, to.dir_y);
    put(ray.direction.z, to.dir_z);
    put(R(0.0f), to.time);
    put(farthest, to.tfar);
    std::memset(&to.mask, 0xff, sizeof to.mask);
    std::memset(&to.flags, 0, sizeof to.flags);
}

}  // namespace

Geometry::Geometry()
    : device_{rtcNewDevice(nullptr), rtcReleaseDevice}, scene_{rtcNewScene(device_.get()), rtcReleaseScene} {}

void Geometry::add(std::span<const lumis::Parallelogram<float>> shapes, std::span<const Surface> surfaces) {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_QUAD);
    const auto vertices = new_buffer<glm::vec3>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 4 * shapes.size());
    const auto indices = new_buffer<glm::uvec4>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT4, shapes.size());
    for (std::uint32_t i = 0, at = 0; const auto& [corner, edge_u, edge_v] : shapes) {
        indices[i++] = glm::uvec4{at, at + 1, at + 2, at + 3};
        for (const glm::vec3& edge : {glm::vec3{0}, edge_u, edge_u + edge_v, edge_v}) vertices[at++] = corner + edge;
    }
    attach(geometry, surfaces);
}

void Geometry::add(std::span<const lumis::Triangle<float>> shapes, std::span<const Surface> surfaces) {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto vertices = new_buffer<glm::vec3>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3 * shapes.size());
    const auto indices = new_buffer<glm::uvec3>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, shapes.size());
    for (std::uint32_t i = 0, at = 0; const auto& [a, b, c] : shapes) {
        indices[i++] = glm::uvec3{at, at + 1, at + 2};
        for (const glm::vec3& corner : {a, b, c}) vertices[at++] = corner;
    }
    attach(geometry, surfaces);
}

void Geometry::add(std::span<const lumis::Disk<float>> shapes, std::span<const Surface> surfaces) {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
    const auto disks = new_buffer<glm::vec4>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, shapes.size());
    const auto normals = new_buffer<glm::vec3>(geometry, RTC_BUFFER_TYPE_NORMAL, RTC_FORMAT_FLOAT3, shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        disks[i] = {shapes[i].center, shapes[i].radius};
        normals[i] = shapes[i].normal;
    }
    attach(geometry, surfaces);
}

void Geometry::add(std::span<const lumis::Sphere<float>> shapes, std::span<const Surface> surfaces) {
    const auto& kept =
        spheres_.emplace_back(std::make_shared<const std::vector<lumis::Sphere<float>>>(shapes.begin(), shapes.end()));
    attach(new_spheres(device_.get(), *kept), surfaces);
}

void Geometry::attach(RTCGeometryTy* geometry, std::span<const Surface> surfaces) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);  // numbered from 0
    rtcReleaseGeometry(geometry);
    first_surface_.push_back(static_cast<std::uint32_t>(surfaces_.size()));
    surfaces_.insert(surfaces_.end(), surfaces.begin(), surfaces.end());
}

void Geometry::commit() {
    rtcCommitScene(scene_.get());
}

template <lumis::Real R>
Hit<R> Geometry::closest(const Ray<R>& ray, const Mask<R>& asked, Rays rays) const {
    EmbreeRayHit<R> query;
    fill(query.ray, ray, R(std::numeric_limits<float>::infinity()));
    std::memset(&query.hit.geomID, 0xff, sizeof query.hit.geomID);  // RTC_INVALID_GEOMETRY_ID
    std::memset(&query.hit.Ng_x, 0, 3 * sizeof(R));
    ask<R>(scene_.get(), asked, rays == Rays::Alike, query);

    Hit<R> hit;
    const auto geometry = taken<Indices<R>>(query.hit.geomID), shape = taken<Indices<R>>(query.hit.primID);
    hit.is_met = !are<R>(geometry, RTC_INVALID_GEOMETRY_ID);
    for (std::size_t i = 0; i < lanes<R>; ++i) {
        hit.surface[i] = lane(hit.is_met, i) ? first_surface_[geometry[i]] + shape[i] : 0;
    }
    hit.distance = lumis::real::select(hit.is_met, taken<R>(query.ray.tfar), R(0.0f));
    hit.position = ray.origin + hit.distance * ray.direction;
    const Vector<R> normal{taken<R>(query.hit.Ng_x), taken<R>(query.hit.Ng_y), taken<R>(query.hit.Ng_z)};
    const R length = lumis::real::length(normal);
    const R inverse = 1.0f / lumis::real::divisor_where(length > 0.0f, length);
    // Zeros are positive: a frame that stands on the normal depends on their sign, and kernels for one ray and for many differ.
    hit.normal = lumis::real::select(hit.is_met, normal * inverse + R(0.0f), Vector<R>{R(0.0f)});
    return hit;
}

template <lumis::Real R>
Mask<R> Geometry::is_occluded(const Ray<R>& ray, const R& distance, const Mask<R>& asked) const {
    EmbreeRay<R> query;
    fill(query, ray, R(distance * (1 - 1e-4f)));
    ask<R>(scene_.get(), asked, false, query);
    const Mask<R> is_met = taken<R>(query.tfar) < 0.0f;  // Embree's sign for yes
    return asked && (is_met || distance <= nearest(ray.origin));
}

template Hit<float> Geometry::closest(const Ray<float>&, const Mask<float>&, Rays) const;
template Hit<Packet> Geometry::closest(const Ray<Packet>&, const Mask<Packet>&, Rays) const;
template Mask<float> Geometry::is_occluded(const Ray<float>&, const float&, const Mask<float>&) const;
template Mask<Packet> Geometry::is_occluded(const Ray<Packet>&, const Packet&, const Mask<Packet>&) const;

}  // namespace tracer
