// Mistakes in shapes of one's own, each beside what was meant; see mistakes.py.
#include <lumis/core/lanes.hpp>
#include <lumis/lumis.hpp>

using namespace lumis;

namespace {

struct SlitView {
#ifndef NO_AREA  // says: view.area
    [[nodiscard]] float area() const noexcept {
        return 1;
    }
#endif
#ifndef NO_SAMPLE  // says: view.sample
    [[nodiscard]] SurfaceSample<float> sample(glm::vec2 u) const noexcept {
        return {{u.x, u.y, 1}, 1};
    }
#endif
#ifndef NO_INTERSECT  // says: view.intersect
    [[nodiscard]] SurfaceHit<float> intersect(const glm::vec3&) const noexcept {
        return {};
    }
#endif
};

struct Slit {
#ifndef NO_SCALAR  // says: Scalar
    using Scalar = float;
#endif
#ifndef NOT_SEEN  // says: seen_from
    [[nodiscard]] SlitView seen_from(const glm::vec3&) const noexcept {
        return {};
    }
#endif
};

}  // namespace

int main() {
    const AreaLight<Slit> light{Slit{}, {0, 0, 0}};
    float sum = light.area();

    using FourFloats = Lanes<float, 4>;
    const glm::vec<3, FourFloats> z{FourFloats{0}, FourFloats{0}, FourFloats{1}};
    const AreaLight<Sphere<FourFloats>, BySolidAngle> spheres{{z, 0.5f}, z};
    sum += spheres.solid_angle()[0];
#ifdef TRIANGLES_BY_SOLID_ANGLE_IN_LANES  // says: of lanes only Sphere
    const AreaLight<Triangle<FourFloats>, BySolidAngle> triangles{{z, z, z}, z};
#endif
#ifdef NO_SAMPLING  // says: draws ByArea, BySolidAngle or ByCosine
    const AreaLight<Sphere<float>, int> other{};
#endif
#ifdef SPHERE_BY_COSINE  // says: draws Triangle and Parallelogram by cosine
    const AreaLight<Sphere<float>, ByCosine> by_cosine{};
#endif
#ifdef HIT_BY_COSINE  // says: depends on the direction and the receiver's normal
    sum += pdf_from_hit<ByCosine>(Triangle<float>{}, glm::vec3{0}, 1, 1);
#endif
    return sum > 0 ? 0 : 1;
}
