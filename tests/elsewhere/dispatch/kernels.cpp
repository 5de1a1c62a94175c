// What a program compiles once for each kind of processor, as the function FUNCTION: batches, an estimate of direct light,
// and tables. Returns a sum of what they yield.
#include <lumis/core/platform.hpp>

#include <concepts>

// A host's own forward declaration.
namespace lumis::LUMIS_ISA {
template <std::floating_point T>
class EnvironmentMap;
}

#include <lumis/batch/batch.hpp>
#include <lumis/lumis.hpp>

#include <random>
#include <vector>

double FUNCTION() {
    const lumis::GgxReflection<float> lobe{glm::vec3{0.6f, 0, 0.8f}, glm::vec2{0.3f}};
    const lumis::AreaLight light{lumis::Sphere<float>{glm::vec3{0, 1, 3}, 0.5f}, glm::vec3{0}};
    double sum = 0;

    constexpr std::size_t count = 37;
    std::vector<float> u(count), x(count), y(count), z(count), pdf(count);
    for (std::size_t i = 0; i < count; ++i) u[i] = static_cast<float>(i) / count;
    lumis::sample_n(lobe, {u, u}, {x, y, z, pdf});
    lumis::pdf_n(lumis::CosineHemisphere<float>{}, x, y, z, pdf);
    for (std::size_t i = 0; i < count; ++i) sum += pdf[i];

    std::mt19937 engine{1};
    lumis::Uniforms uniforms{engine};
    const auto direct = lumis::multi_sample(lumis::PowerHeuristic{}, lumis::take(1, lobe), lumis::take(1, light));
    for (int i = 0; i < 100; ++i) sum += direct.estimate([](const glm::vec3& w) { return w.z; }, uniforms);

    const std::vector<float> luminance(32, 1.0f);
    const lumis::EnvironmentMap map{8, 4, luminance};
    return sum + map.sample({0.3f, 0.6f}).pdf;
}
