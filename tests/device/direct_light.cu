// The kernel of docs/device.md, and the program around it: light from a lamp and the sky at the points of a glossy floor.
#include "compare.cuh"
#include "uniforms.cuh"
#include <lumis/lumis.hpp>

#include <cmath>
#include <vector>

namespace {

struct Scene {
    lumis::EnvironmentMapView<float> sky;
    lumis::Parallelogram<float> lamp;
    glm::vec2 alpha;  // roughness of the floor
};

LUMIS_HD float direct_light(const Scene& scene, const glm::vec3& point, const glm::vec3& eye, device::Stream uniforms) {
    const lumis::Frame frame{glm::vec3{0, 1, 0}};
    const glm::vec3 wo = frame.to_local(glm::normalize(eye - point));
    const lumis::GgxReflection<float> floor{wo, scene.alpha};
    const lumis::AreaLight<lumis::Parallelogram<float>, lumis::BySolidAngle> lamp{scene.lamp, point};
    const auto direct = lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, lumis::in_frame(frame, floor)),
                                            lumis::take(1, lamp), lumis::take(1, scene.sky));
    const auto radiance = [&](const lumis::AnySample auto& s) {  // nothing hides the lamp
        const glm::vec3 wi = frame.to_local(s.value);
        return (std::isfinite(s.distance) ? 5.0f : 1.0f) * floor.ggx().brdf(wo, wi) * std::abs(wi.z);
    };
    lumis::RunningMoments<float> moments;
    for (int i = 0; i < 64; ++i) moments.add(direct.estimate(radiance, uniforms));
    return static_cast<float>(moments.mean());
}

__global__ void render(Scene scene, glm::vec3 eye, float* picture, unsigned width, unsigned height) {
    const unsigned x = blockIdx.x * blockDim.x + threadIdx.x, y = blockIdx.y * blockDim.y + threadIdx.y;
    if (x >= width || y >= height) return;
    const glm::vec3 point{static_cast<float>(x) / width - 0.5f, 0, static_cast<float>(y) / height - 0.5f};
    const unsigned pixel = y * width + x;
    picture[pixel] = direct_light(scene, point, eye, device::Stream{pixel});
}

}  // namespace

int main() {
    const unsigned width = 32, height = 16;
    const glm::vec3 eye{0, 1, -2};
    std::vector<float> luminance(64 * 32, 1.0f);
    luminance[10 * 64 + 20] = 100;
    const lumis::EnvironmentMap sky{64, 32, luminance};
    Scene scene{sky.view(), {{-0.2f, 0.5f, -0.2f}, {0, 0, 0.4f}, {0.4f, 0, 0}}, glm::vec2{0.3f}};
    std::vector<float> on_host;
    for (unsigned pixel = 0; pixel < width * height; ++pixel) {
        const glm::vec3 point{static_cast<float>(pixel % width) / width - 0.5f, 0,
                              static_cast<float>(pixel / width) / height - 0.5f};
        on_host.push_back(direct_light(scene, point, eye, device::Stream{pixel}));
    }
    if (!device::is_present()) return device::skipped;

    device::Copies to_device;
    scene.sky = sky.view(to_device);
    device::Array<float> picture{width * height};
    render<<<dim3(width / 8, height / 8), dim3(8, 8)>>>(scene, eye, picture.data(), width, height);
    return device::agree("direct light", on_host, picture.values()) ? 0 : 1;
}
