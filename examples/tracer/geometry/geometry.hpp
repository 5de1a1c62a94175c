// What rays meet: Embree holds the shapes, this keeps what Embree does not know, the surface that each shape wears.
#pragma once

#include "paths/packet.hpp"
#include <lumis/lights/shapes.hpp>

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct RTCDeviceTy;
struct RTCGeometryTy;
struct RTCSceneTy;

namespace tracer {

// What covers a shape: a material, a light, or both. Indices are those of the scene's tables.
struct Surface {
    static constexpr std::uint32_t none = ~std::uint32_t{};

    std::uint32_t kind = none;   // of material, none: all light is absorbed
    std::uint32_t material{};    // of this kind
    std::uint32_t group = none;  // of lights, none: it does not shine
    std::uint32_t light{};       // of this group
};

// Rays of unit direction, one in each lane.
template <lumis::Real R>
struct Ray {
    Vector<R> origin, direction;
};

template <lumis::Real R>
struct Hit {
    Mask<R> is_met;  // in other lanes, all else is 0
    R distance;
    Vector<R> position;
    Vector<R> normal;    // unit, the geometric one of the shape's own side
    Indices<R> surface;  // what Geometry::surface takes
};

// Rays of a packet that go nearly the same way, as a pixel's do, take less time if that is said.
enum class Rays { Any, Alike };

class Geometry {
  public:
    Geometry();

    // Shapes of one kind, and the surface of each.
    void add(std::span<const lumis::Parallelogram<float>> shapes, std::span<const Surface> surfaces);
    void add(std::span<const lumis::Triangle<float>> shapes, std::span<const Surface> surfaces);
    void add(std::span<const lumis::Disk<float>> shapes, std::span<const Surface> surfaces);
    void add(std::span<const lumis::Sphere<float>> shapes, std::span<const Surface> surfaces);
    template <class Shape>
    void add(const Shape& shape, const Surface& surface) {
        add(std::span<const Shape>{&shape, 1}, std::span<const Surface>{&surface, 1});
    }

    // Called after the last shape and before the first ray.
    void commit();

    // The first surface ahead, in the lanes asked for.
    template <lumis::Real R>
    [[nodiscard]] Hit<R> closest(const Ray<R>& ray, const Mask<R>& asked, Rays rays = Rays::Any) const;

    // Whether something stands nearer than the distance, in the lanes asked for; or whether that point is so near that
    // closest() would not meet it.
    template <lumis::Real R>
    [[nodiscard]] Mask<R> is_occluded(const Ray<R>& ray, const R& distance, const Mask<R>& asked) const;

    [[nodiscard]] const Surface& surface(std::uint32_t index) const { return surfaces_[index]; }

  private:
    void attach(RTCGeometryTy* geometry, std::span<const Surface> surfaces);

    std::shared_ptr<RTCDeviceTy> device_;
    std::shared_ptr<RTCSceneTy> scene_;
    std::vector<std::shared_ptr<const std::vector<lumis::Sphere<float>>>>
        spheres_;  // as long as the scene that they are in
    std::vector<Surface> surfaces_;
    std::vector<std::uint32_t> first_surface_;  // of each of Embree's geometries
};

}  // namespace tracer
