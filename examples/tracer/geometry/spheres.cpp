#include "geometry/spheres.hpp"

#include "geometry/geometry.hpp"

#include <glm/geometric.hpp>

#include <cstddef>
#include <limits>
#include <type_traits>

namespace tracer {

namespace {

namespace real = lumis::real;

const lumis::Sphere<float>& sphere_of(const void* spheres, unsigned index) {
    return static_cast<const lumis::Sphere<float>*>(spheres)[index];
}

// The first point of a sphere between two distances along a ray of unit direction.
template <lumis::Real R>
struct Root {
    Mask<R> is_met;
    R distance;
    Vector<R> from_center;
};
template <lumis::Real R>
Root<R> first_root(const lumis::Sphere<float>& sphere, const Ray<R>& ray, const R& nearest, const R& farthest) {
    const Vector<R> to_center = Vector<R>(sphere.center) - ray.origin;
    const R along = glm::dot(to_center, ray.direction);
    const Vector<R> across = to_center - along * ray.direction;  // from the ray, at its place nearest to the centre
    const R squared = sphere.radius * sphere.radius - glm::dot(across, across);
    const R half_chord = real::sqrt_or_zero(squared), in = along - half_chord, out = along + half_chord;
    const Mask<R> enters = in > nearest && in < farthest;
    const Mask<R> leaves = out > nearest && out < farthest;
    const R distance = real::select(enters, in, out);
    return {squared > 0.0f && (enters || leaves), distance, distance * ray.direction - to_center};
}

// Embree hands over rays as pointers to structures of so many lanes.
template <lumis::Real R>
Root<R> first_root(const void* spheres, unsigned index, const EmbreeRay<R>& ray) {
    return first_root<R>(sphere_of(spheres, index),
                         {{taken<R>(ray.org_x), taken<R>(ray.org_y), taken<R>(ray.org_z)},
                          {taken<R>(ray.dir_x), taken<R>(ray.dir_y), taken<R>(ray.dir_z)}},
                         taken<R>(ray.tnear), taken<R>(ray.tfar));
}

template <class Field>
auto* entries(Field& field) {
    if constexpr (std::is_array_v<Field>) {
        return &field[0];
    } else {
        return &field;
    }
}

template <lumis::Real R>
void intersect(const RTCIntersectFunctionNArguments* asked) {
    auto& [ray, hit] = *reinterpret_cast<EmbreeRayHit<R>*>(asked->rayhit);
    const Root<R> root = first_root<R>(asked->geometryUserPtr, asked->primID, ray);
    for (std::size_t i = 0; i < lanes<R>; ++i) {
        if (asked->valid[i] == 0 || !lane(root.is_met, i)) continue;
        entries(ray.tfar)[i] = lane(root.distance, i);
        entries(hit.Ng_x)[i] = lane(root.from_center.x, i);
        entries(hit.Ng_y)[i] = lane(root.from_center.y, i);
        entries(hit.Ng_z)[i] = lane(root.from_center.z, i);
        entries(hit.primID)[i] = asked->primID;
        entries(hit.geomID)[i] = asked->geomID;
    }
}

template <lumis::Real R>
void occlude(const RTCOccludedFunctionNArguments* asked) {
    auto& ray = *reinterpret_cast<EmbreeRay<R>*>(asked->ray);
    const Root<R> root = first_root<R>(asked->geometryUserPtr, asked->primID, ray);
    for (std::size_t i = 0; i < lanes<R>; ++i) {
        if (asked->valid[i] == 0 || !lane(root.is_met, i)) continue;
        entries(ray.tfar)[i] = -std::numeric_limits<float>::infinity();
    }
}

// Embree asks for a whole packet, or for a part of it.
void for_width(unsigned width, auto call) {
    switch (width) {
        case 1:
            return call.template operator()<float>();
        case 4:
            return call.template operator()<lumis::Lanes<float, 4>>();
        case 8:
            return call.template operator()<lumis::Lanes<float, 8>>();
        case 16:
            return call.template operator()<lumis::Lanes<float, 16>>();
        default:
            return;  // Embree has no others
    }
}

void bounds(const RTCBoundsFunctionArguments* asked) {
    const auto& [center, radius] = sphere_of(asked->geometryUserPtr, asked->primID);
    RTCBounds& box = *asked->bounds_o;
    box.lower_x = center.x - radius;
    box.lower_y = center.y - radius;
    box.lower_z = center.z - radius;
    box.upper_x = center.x + radius;
    box.upper_y = center.y + radius;
    box.upper_z = center.z + radius;
}

}  // namespace

RTCGeometry new_spheres(RTCDevice device, const std::vector<lumis::Sphere<float>>& spheres) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(spheres.size()));
    // Embree passes the pointer on, and writes nothing through it.
    rtcSetGeometryUserData(geometry, const_cast<lumis::Sphere<float>*>(spheres.data()));
    rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, [](const RTCIntersectFunctionNArguments* asked) {
        for_width(asked->N, [&]<lumis::Real R>() { intersect<R>(asked); });
    });
    rtcSetGeometryOccludedFunction(geometry, [](const RTCOccludedFunctionNArguments* asked) {
        for_width(asked->N, [&]<lumis::Real R>() { occlude<R>(asked); });
    });
    return geometry;
}

}  // namespace tracer
