// The irradiance of a square light at a point, by two strategies that share the work: about 1.7408 times its radiance.
#include <lumis/lumis.hpp>

#include <cstdio>
#include <random>

int main() {
    const lumis::Parallelogram square{glm::vec3{-1, -1, 1}, glm::vec3{2, 0, 0}, glm::vec3{0, 2, 0}};
    const lumis::AreaLight light{square, glm::vec3{0}};  // seen from the origin
    const lumis::CosineHemisphere<float> bsdf;           // about +z

    const auto direct = multi_sample(lumis::PowerHeuristic{}, lumis::take(1, bsdf), lumis::take(1, light));
    const auto cosine = [&](glm::vec3 w) { return w.z > 0 && light.pdf(w) > 0 ? w.z : 0.0f; };

    std::mt19937 engine{7};
    lumis::Uniforms uniforms{engine};
    lumis::RunningMoments<float> irradiance;
    for (int i = 0; i < 100'000; ++i) irradiance.add(direct.estimate(cosine, uniforms));
    std::printf("%.4f +- %.4f\n", irradiance.mean(), irradiance.standard_error());
}
