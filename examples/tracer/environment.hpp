// Light from infinitely far away: the radiance of a latitude-longitude image, looked up bilinearly, and the strategy that
// samples it.
#pragma once

#include "image.hpp"
#include <lumis/core/latlong.hpp>
#include <lumis/lights/environment_map.hpp>

#include <algorithm>
#include <cmath>

namespace tracer {

class Environment {
  public:
    explicit Environment(const Image& map)
        : map_{map}, strategy_{map.width, map.height, luminances(map), {lumis::Interpolation::Bilinear}} {}

    [[nodiscard]] const lumis::EnvironmentMap<float>& strategy() const { return strategy_; }

    // Texel centres lie at half integers; u wraps around, v is clamped.
    [[nodiscard]] glm::vec3 radiance(const glm::vec3& w) const {
        const auto uv = lumis::latlong_from_direction(w);
        const float x = uv.x * static_cast<float>(map_.width) - 0.5f;
        const float y = uv.y * static_cast<float>(map_.height) - 0.5f;
        const float left = std::floor(x), top = std::floor(y);
        const auto row = [&](int j) {
            const int i = static_cast<int>(left);
            return (left + 1 - x) * texel(i, j) + (x - left) * texel(i + 1, j);
        };
        const int j = static_cast<int>(top);
        return (top + 1 - y) * row(j) + (y - top) * row(j + 1);
    }

  private:
    [[nodiscard]] const glm::vec3& texel(int column, int row) const {
        const int i = (column + map_.width) % map_.width, j = std::clamp(row, 0, map_.height - 1);
        return map_.pixels[static_cast<std::size_t>(j * map_.width + i)];
    }

    static std::vector<float> luminances(const Image& map) {
        std::vector<float> result(map.pixels.size());
        std::ranges::transform(map.pixels, result.begin(), luminance);
        return result;
    }

    Image map_;
    lumis::EnvironmentMap<float> strategy_;
};

}  // namespace tracer
