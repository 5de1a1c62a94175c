// Light from infinitely far away: the radiance of a latitude-longitude image, looked up bilinearly, and the strategy that
// samples it.
#pragma once

#include "images/image.hpp"
#include "lights/lights.hpp"
#include "paths/packet.hpp"
#include <lumis/core/latlong.hpp>
#include <lumis/lights/environment_map.hpp>

#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace tracer {

// The image of a sky that is the same everywhere.
[[nodiscard]] inline Image uniform_image(const glm::vec3& radiance) {
    return {2, 1, {radiance, radiance}};
}

class Environment {
  public:
    static constexpr bool is_background = true, is_delta = false;
    static constexpr std::size_t samples = 1;
    using Strategy = lumis::EnvironmentMap<float>;

    explicit Environment(const Image& map)
        : width_{map.width},
          height_{map.height},
          texels_{padded(map)},
          alone_{map.width, map.height, luminances(map), {lumis::Interpolation::Bilinear, false}},
          beside_bsdf_{map.width, map.height, luminances(map), {lumis::Interpolation::Bilinear, true}} {}

    // Draws all of the sky, or, beside samples of a BSDF, what is brighter than its mean.
    [[nodiscard]] const Strategy& strategy(bool has_bsdf_samples) const {
        return has_bsdf_samples ? beside_bsdf_ : alone_;
    }

    template <lumis::Real R>
    [[nodiscard]] Vector<R> radiance(const Vector<R>& w) const {
        return radiance_at<R>(lumis::latlong_from_direction(w));
    }

    // The same wherever it is seen from.
    template <lumis::Real R>
    class Seen {
      public:
        Seen(const Environment& environment, bool has_bsdf_samples)
            : environment_{environment}, strategy_{environment.strategy(has_bsdf_samples)} {}

        [[nodiscard]] LightDraw<R> sample(const glm::vec<3, R>& u) const {
            const auto drawn = strategy_.sample_uv(glm::vec<2, R>{u.x, u.y});
            return {drawn.value, drawn.pdf, drawn.distance, environment_.radiance_at<R>(drawn.uv)};
        }

        [[nodiscard]] MetSky<R> met(const Vector<R>& w) const {
            const auto uv = lumis::latlong_from_direction(w);
            return {environment_.radiance_at<R>(uv), strategy_.pdf_at(uv)};
        }

      private:
        const Environment& environment_;
        const Strategy& strategy_;
    };

    template <lumis::Real R>
    [[nodiscard]] Seen<R> seen_from(const Receiver<R>& receiver, std::size_t /*count*/) const {
        return Seen<R>{*this, receiver.has_bsdf_samples};
    }

  private:
    // Texel centres lie at half integers; u wraps around, v is clamped.
    template <lumis::Real R>
    [[nodiscard]] LUMIS_INLINE Vector<R> radiance_at(const glm::vec<2, R>& uv) const {
        const R x = uv.x * static_cast<float>(width_), y = uv.y * static_cast<float>(height_);
        std::array<std::array<float, 4>, lanes<R>> looked_up;
        for (std::size_t i = 0; i < lanes<R>; ++i) looked_up[i] = interpolated(lane(x, i), lane(y, i));
        return {of_lanes<R>([&](auto i) { return looked_up[i][0]; }),
                of_lanes<R>([&](auto i) { return looked_up[i][1]; }),
                of_lanes<R>([&](auto i) { return looked_up[i][2]; })};
    }

    [[nodiscard]] LUMIS_INLINE std::array<float, 4> interpolated(float x, float y) const {
        using Four = lumis::Lanes<float, 4>;
        // Numbers are positive, so that cutting off digits rounds down.
        const int right = static_cast<int>(x + 0.5f), lower = static_cast<int>(y + 0.5f);
        const float to_right = x + 0.5f - static_cast<float>(right), to_lower = y + 0.5f - static_cast<float>(lower);
        const int left = right > 0 ? right - 1 : width_ - 1, upper = std::max(lower - 1, 0);
        const int wrapped = right < width_ ? right : 0, last = std::min(lower, height_ - 1);
        const auto texel = [&](int column, int row) {
            return Four::load(&texels_[static_cast<std::size_t>(row * width_ + column)].x);
        };
        const Four above = texel(left, upper) + to_right * (texel(wrapped, upper) - texel(left, upper));
        const Four below = texel(left, last) + to_right * (texel(wrapped, last) - texel(left, last));
        std::array<float, 4> result;
        (above + to_lower * (below - above)).store(result.data());
        return result;
    }

    static std::vector<glm::vec4> padded(const Image& map) {
        std::vector<glm::vec4> result;
        for (const glm::vec3& pixel : map.pixels) result.emplace_back(pixel, 0.0f);
        return result;
    }
    static std::vector<float> luminances(const Image& map) {
        std::vector<float> result(map.pixels.size());
        std::ranges::transform(map.pixels, result.begin(), luminance);
        return result;
    }

    int width_, height_;
    std::vector<glm::vec4> texels_;  // four numbers each, to be loaded at once
    Strategy alone_, beside_bsdf_;
};

}  // namespace tracer
