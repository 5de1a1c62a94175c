// The renderer's camera, and images of what it sees.
#pragma once

#include "paths.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <numbers>

namespace host {

struct View {
    Vec position, target;
    float degrees;  // field of view on the smaller axis
    int width, height;

    // Up is +y; (0, 0) is the upper left corner of the image, (width, height) the lower right one.
    [[nodiscard]] Vec direction(float x, float y) const {
        const Vec forward = normalized(target - position), right = normalized(cross(forward, {0, 1, 0}));
        const float pixel =
            2 * std::tan(degrees * std::numbers::pi_v<float> / 360) / static_cast<float>(std::min(width, height));
        const float across = x - static_cast<float>(width) / 2, down = y - static_cast<float>(height) / 2;
        return normalized(forward + pixel * (across * right - down * cross(right, forward)));
    }
};

// The camera for examples/data/room.obj.
inline constexpr View room_view{{1.2f, 1.35f, 5.4f}, {-0.1f, 1.0f, -0.5f}, 38, 480, 360};

// Row by row from the top. Images of different seeds are independent.
template <class Parts>
[[nodiscard]] std::vector<Vec> render(const Scene& scene, const Parts& parts, const View& view, int samples,
                                      int bounces, std::uint64_t seed) {
    const SobolPoints points{static_cast<std::size_t>(samples)};
    const auto pixels = static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height);
    std::vector<Vec> image(pixels);
    oneapi::tbb::parallel_for(std::size_t{0}, pixels, [&](std::size_t i) {
        const auto width = static_cast<std::size_t>(view.width);
        Vec sum;
        for (std::size_t k = 0; k < static_cast<std::size_t>(samples); ++k) {
            PathSampler sampler{points, k, seed * pixels + i};
            const float x = sampler.next(), y = sampler.next();
            const Vec direction = view.direction(static_cast<float>(i % width) + x, static_cast<float>(i / width) + y);
            sum = sum + radiance(scene, parts, view.position, direction, sampler, bounces);
        }
        image[i] = 1 / static_cast<float>(samples) * sum;
    });
    return image;
}

}  // namespace host
