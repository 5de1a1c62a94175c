// Latitude-longitude pictures and their texels.
#pragma once

#include "measured.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace stability {

template <class T>
struct Picture {
    std::size_t width, height;
    std::vector<T> texels;

    Picture(std::size_t w, std::size_t h, auto luminance) : width{w}, height{h} {
        for (std::size_t y = 0; y < h; ++y) {
            for (std::size_t x = 0; x < w; ++x) texels.push_back(static_cast<T>(luminance(x, y)));
        }
    }
    [[nodiscard]] lumis::EnvironmentMap<T> map(lumis::EnvironmentOptions options = {}) const {
        return {width, height, texels, options};
    }
};

[[nodiscard]] inline Quad texel_solid_angle(std::size_t y, std::size_t width, std::size_t height) {
    return 2 * quad_pi / width * (cos(quad_pi * y / height) - cos(quad_pi * (y + 1) / height));
}

// The direction to a texel's centre.
template <class T>
[[nodiscard]] lumis::Direction<T> centre_of(std::size_t x, std::size_t y, std::size_t width, std::size_t height) {
    constexpr double pi = std::numbers::pi;
    const double theta = pi * (static_cast<double>(y) + 0.5) / static_cast<double>(height);
    const double phi = 2 * pi * ((static_cast<double>(x) + 0.5) / static_cast<double>(width) - 0.5);
    return {static_cast<T>(std::sin(theta) * std::cos(phi)), static_cast<T>(std::cos(theta)),
            static_cast<T>(std::sin(theta) * std::sin(phi))};
}

}  // namespace stability
