#include "geometry.hpp"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

namespace tracer {

namespace {

template <class T>
std::span<T> new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
    return {static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count)), count};
}

// Embree's rays, alone or eight at once: a field is a number, or an array of eight.
template <lumis::Real R>
constexpr bool is_single = std::is_same_v<R, float>;
template <lumis::Real R>
using EmbreeRay = std::conditional_t<is_single<R>, RTCRay, RTCRay8>;
template <lumis::Real R>
using EmbreeRayHit = std::conditional_t<is_single<R>, RTCRayHit, RTCRayHit8>;

void put(const auto& x, auto& field) {
    static_assert(sizeof x == sizeof field);
    std::memcpy(&field, &x, sizeof x);
}
template <class X>
X taken(const auto& field) {
    static_assert(sizeof(X) == sizeof field);
    X x;
    std::memcpy(static_cast<void*>(&x), &field, sizeof x);
    return x;
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

// What Embree asks and is told of each lane.
template <lumis::Real R>
std::array<int, lanes<R>> valid(const Mask<R>& asked) {
    std::array<int, lanes<R>> result;
    for (std::size_t i = 0; i < lanes<R>; ++i) result[i] = lane(asked, i) ? -1 : 0;
    return result;
}

void intersect(RTCScene scene, RTCRayHit& query, const std::array<int, 1>& asked) {
    if (asked[0] == 0) return;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
#endif
}
void intersect(RTCScene scene, RTCRayHit8& query, const std::array<int, 8>& asked) {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect8(asked.data(), scene, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect8(asked.data(), scene, &context, &query);
#endif
}
void occlude(RTCScene scene, RTCRay& ray, const std::array<int, 1>& asked) {
    if (asked[0] == 0) return;
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(scene, &ray, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
}
void occlude(RTCScene scene, RTCRay8& ray, const std::array<int, 8>& asked) {
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded8(asked.data(), scene, &ray, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded8(asked.data(), scene, &context, &ray);
#endif
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

void Geometry::add(std::span<const lumis::Sphere<float>> shapes, std::span<const Surface> surfaces) {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
    const auto vertices = new_buffer<glm::vec4>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) vertices[i] = {shapes[i].center, shapes[i].radius};
    attach(geometry, surfaces);
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
Hit<R> Geometry::closest(const Ray<R>& ray, const Mask<R>& asked) const {
    alignas(32) const auto lanes_asked = valid<R>(asked);
    EmbreeRayHit<R> query;
    fill(query.ray, ray, R(std::numeric_limits<float>::infinity()));
    std::memset(&query.hit.geomID, 0xff, sizeof query.hit.geomID);  // RTC_INVALID_GEOMETRY_ID
    std::memset(&query.hit.Ng_x, 0, 3 * sizeof(R));
    intersect(scene_.get(), query, lanes_asked);

    Hit<R> hit;
    const auto geometry = taken<Indices<R>>(query.hit.geomID), shape = taken<Indices<R>>(query.hit.primID);
    hit.is_met = mask_of<R>([&](auto i) { return geometry[i] != RTC_INVALID_GEOMETRY_ID; });
    for (std::size_t i = 0; i < lanes<R>; ++i) {
        hit.surface[i] = lane(hit.is_met, i) ? first_surface_[geometry[i]] + shape[i] : 0;
    }
    hit.distance = lumis::real::select(hit.is_met, taken<R>(query.ray.tfar), R(0.0f));
    hit.position = ray.origin + hit.distance * ray.direction;
    const Vector<R> normal{taken<R>(query.hit.Ng_x), taken<R>(query.hit.Ng_y), taken<R>(query.hit.Ng_z)};
    const R length = lumis::real::length(normal);
    const R inverse = 1.0f / lumis::real::divisor_where(length > 0.0f, length);
    hit.normal = lumis::real::select(hit.is_met, normal * inverse, Vector<R>{R(0.0f)});
    return hit;
}

template <lumis::Real R>
Mask<R> Geometry::is_occluded(const Ray<R>& ray, const R& distance, const Mask<R>& asked) const {
    alignas(32) const auto lanes_asked = valid<R>(asked);
    EmbreeRay<R> query;
    fill(query, ray, R(distance * (1 - 1e-4f)));
    occlude(scene_.get(), query, lanes_asked);
    const Mask<R> is_met = taken<R>(query.tfar) < 0.0f;  // Embree's sign for yes
    return asked && (is_met || distance <= nearest(ray.origin));
}

template Hit<float> Geometry::closest(const Ray<float>&, const Mask<float>&) const;
template Hit<Packet> Geometry::closest(const Ray<Packet>&, const Mask<Packet>&) const;
template Mask<float> Geometry::is_occluded(const Ray<float>&, const float&, const Mask<float>&) const;
template Mask<Packet> Geometry::is_occluded(const Ray<Packet>&, const Packet&, const Mask<Packet>&) const;

}  // namespace tracer
