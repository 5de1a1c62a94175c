// Every strategy draws, evaluates and inverts on a CUDA device what it does on the host.
#include "compare.cuh"
#include "uniforms.cuh"
#include <lumis/lumis.hpp>

#include <cstddef>
#include <random>
#include <vector>

namespace {

using namespace lumis;

LUMIS_HD void put(float*& out, float x) {
    *out++ = x;
}
LUMIS_HD void put(float*& out, std::size_t x) {
    *out++ = static_cast<float>(x);
}
template <int N>
LUMIS_HD void put(float*& out, const glm::vec<N, float>& x) {
    for (int i = 0; i < N; ++i) *out++ = x[i];
}

LUMIS_HD void put(float*& out, const SurfaceRay<float>& ray) {
    put(out, ray.position);
    put(out, ray.direction);
}

// A point and its density, both from sample and from pdf, the distance of a light, and what invert makes of the point.
template <class S>
struct Strategies {
    static constexpr int size = 15;
    S strategy;

    LUMIS_HD void operator()(unsigned index, float* out) const {
        float* const end = out + size;
        device::Stream uniforms{index};
        const auto sample = strategy.sample(uniforms.next<S::dimensions>());
        if (sample.pdf > 0) {
            put(out, sample.value);
            put(out, strategy.pdf(sample.value));
            if constexpr (requires { sample.distance; }) put(out, sample.distance);
            if constexpr (LightStrategy<S>) put(out, strategy.distance_along(sample.value));
            if constexpr (SurfaceStrategy<S>) {
                put(out, sample.surface.position);
                put(out, strategy.hit_along(sample.value).surface.uv);
            }
            if constexpr (InvertibleStrategy<S>) put(out, strategy.invert(sample.value));
        }
        put(out, sample.pdf);
        while (out < end) put(out, 0.0f);
    }
};

template <class S>
bool check(const char* name, const S& here, const S& there) {
    return device::agrees(name, Strategies<S>{here}, Strategies<S>{there});
}
template <class S>
bool check(const char* name, const S& strategy) {
    return check(name, strategy, strategy);
}

bool check_directions() {
    bool good = check("uniform sphere", UniformSphere<float>{});
    good &= check("uniform hemisphere", UniformHemisphere<float>{});
    good &= check("cosine hemisphere", CosineHemisphere<float>{});
    good &= check("uniform cone", UniformCone{0.3f});
    good &= check("Henyey-Greenstein", HenyeyGreenstein{glm::vec3{0.6f, 0, 0.8f}, 0.7f});
    const Frame frame{glm::vec3{0.6f, -0.48f, 0.64f}};
    good &= check("in frame", in_frame(frame, CosineHemisphere<float>{}));
    return good;
}

bool check_microfacets() {
    const glm::vec3 wo{0.48f, 0.6f, 0.64f};
    const glm::vec2 alpha{0.3f, 0.1f};
    bool good = check("GGX normals", GgxNdf<float>{alpha});
    good &= check("GGX visible normals", GgxVndf<float>{wo, alpha});
    good &= check("GGX reflection", GgxReflection<float>{wo, alpha});
    good &= check("GGX bounded reflection", GgxBoundedReflection<float>{wo, alpha});
    good &= check("GGX classical reflection", Reflected<GgxNdf<float>>{wo, GgxNdf<float>{alpha}});
    good &= check("perfect reflection", PerfectReflection<float>{wo});
    good &= check("rough glass", GgxDielectric<float>{wo, alpha, 1.5f});
    good &= check("rough glass from below", GgxDielectric<float>{-wo, alpha, 1.5f});
    good &= check("smooth glass", SmoothDielectric<float>{wo, 1.5f});
    good &= check("smooth glass from below", SmoothDielectric<float>{-wo, 1.5f});
    return good;
}

template <class Sampling, class... Shape>
bool check_shapes(const char* sampling, const Shape&... shapes) {
    std::puts(sampling);
    const glm::vec3 point{0.1f, -0.2f, 0.3f};
    return (check("  area light", AreaLight<Shape, Sampling>{shapes, point}) & ...) &
           (check("  surface light", SurfaceLight<Shape, Sampling>{shapes, point, Sides::Both}) & ...);
}

bool check_lights() {
    const Triangle<float> triangle{{-1, 0, 2}, {1, 0.2f, 2.5f}, {0, 1, 3}};
    const Parallelogram<float> parallelogram{{-1, -1, 2}, {2, 0, 0.1f}, {0, 1.5f, 0}};
    const Disk<float> disk{{0, 1, 2}, {0, -0.6f, -0.8f}, 0.5f};
    const Sphere<float> sphere{{1, 1, 4}, 0.7f};
    bool good = check_shapes<ByArea>("by area", triangle, parallelogram, disk, sphere);
    good &= check_shapes<BySolidAngle>("by solid angle", triangle, parallelogram, sphere);
    const glm::vec3 point{0.1f, -0.2f, 0.3f}, normal{0.6f, 0, 0.8f};
    good &= check("triangle by cosine", AreaLight<Triangle<float>, ByCosine>{triangle, point, normal});
    good &= check("parallelogram by cosine", SurfaceLight<Parallelogram<float>, ByCosine>{parallelogram, point, normal});
    good &= check("surface area", SurfaceArea{triangle}) & check("surface area", SurfaceArea{disk});
    good &= check("surface area", SurfaceArea{sphere}) & check("emission", SurfaceEmission{parallelogram, Sides::Both});
    good &= check("point light", PointLight<float>{{1, 2, 3}, {0, 0, 0.5f}});
    good &= check("sun", Sun{glm::vec3{0.6f, 0, 0.8f}, 0.00465f});
    good &= check("directional light", DirectionalLight<float>{{0.6f, 0, 0.8f}});
    return good;
}

// A view here, and one of a copy there.
template <class Table>
bool check_table(const char* name, const Table& table) {
    device::Copies copies;
    return check(name, table.view(), table.view(copies));
}

bool check_tables() {
    std::mt19937 engine{1};
    std::vector<float> weights(64 * 32);
    for (float& weight : weights) weight = static_cast<float>(engine() % 1000);
    bool good = check_table("alias table", AliasTable{weights});
    good &= check_table("discrete table", DiscreteTable{weights});
    good &= check_table("fine alias table", FineAliasTable{weights});
    good &= check_table("piecewise constant, 1D", PiecewiseConstant1D{weights});
    good &= check_table("piecewise constant, 2D", PiecewiseConstant2D{64, 32, weights});
    const Parallelogram<float> screen{{-1, -1, 2}, {2, 0, 0.1f}, {0, 1.5f, 0}};
    const PiecewiseConstant2D image{64, 32, weights};
    device::Copies copies;
    good &= check("image light", ImageLight{screen, image.view(), glm::vec3{0}},
                  ImageLight{screen, image.view(copies), glm::vec3{0}});
    good &= check_table("environment map", EnvironmentMap{64, 32, weights});
    good &= check_table("alias environment map", AliasEnvironmentMap{64, 32, weights});
    return good;
}

}  // namespace

int main() {
    if (!device::is_present()) return device::skipped;
    const bool good = check_directions() & check_microfacets() & check_lights() & check_tables();
    return good ? 0 : 1;
}
