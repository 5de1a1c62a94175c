#include "renderer.hpp"

#include <numbers>

float white_furnace(const lumis::CosineHemisphere<float>& bsdf) {
    const auto drawn = bsdf.sample(glm::vec2{0.25f, 0.75f});
    return drawn.value.z * std::numbers::inv_pi_v<float> / drawn.pdf;
}
