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
#include <cstdint>
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
    // Texel centres lie at half integers; u wraps around, v is clamped. Addresses are of all lanes at once, texels of each alone.
    template <lumis::Real R>
    [[nodiscard]] LUMIS_INLINE Vector<R> radiance_at(const glm::vec<2, R>& uv) const {
        using Four = lumis::Lanes<float, 4>;
        const auto [column, to_right] = split<R>(uv.x * static_cast<float>(width_) + 0.5f);
        const auto [row, to_lower] = split<R>(uv.y * static_cast<float>(height_) + 0.5f);
        Indices<R> texels;
        for (std::size_t i = 0; i < lanes<R>; ++i) texels[i] = row[i] * stride_ + column[i];
        std::array<std::array<float, 4>, lanes<R>> looked_up;
        for (std::size_t i = 0; i < lanes<R>; ++i) {
            const glm::vec4* const texel = &texels_[texels[i]];
            const auto at = [&](std::size_t k) { return Four::load(&texel[k].x); };
            const Four above = at(0) + lane(to_right, i) * (at(1) - at(0));
            const Four below = at(stride_) + lane(to_right, i) * (at(stride_ + 1) - at(stride_));
            (above + lane(to_lower, i) * (below - above)).store(looked_up[i].data());
        }
        return {of_lanes<R>([&](auto i) { return looked_up[i][0]; }),
                of_lanes<R>([&](auto i) { return looked_up[i][1]; }),
                of_lanes<R>([&](auto i) { return looked_up[i][2]; })};
    }

    // The map's texels, and around them those that are looked up beyond its edges.
    static std::vector<glm::vec4> padded(const Image& map) {
        std::vector<glm::vec4> result;
        for (int y = -1; y <= map.height; ++y) {
            for (int x = -1; x <= map.width; ++x) {
                const int column = (x + map.width) % map.width, row = std::clamp(y, 0, map.height - 1);
                result.emplace_back(map.pixels[static_cast<std::size_t>(row * map.width + column)], 0.0f);
            }
        }
        return result;
    }
    static std::vector<float> luminances(const Image& map) {
        std::vector<float> result(map.pixels.size());
        std::ranges::transform(map.pixels, result.begin(), luminance);
        return result;
    }

    int width_, height_;
    std::uint32_t stride_ = static_cast<std::uint32_t>(width_) + 2;  // of texels_
    std::vector<glm::vec4> texels_;                                  // four numbers each, to be loaded at once
    Strategy alone_, beside_bsdf_;
};

}  // namespace tracer
