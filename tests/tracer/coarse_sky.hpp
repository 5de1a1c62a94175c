// The shipped sky, each of its texels the mean of 8 x 8. Directions of the BSDF meet the sun of the whole one so rarely, three
// times in a block, that their error is not normal.
#pragma once

#include "images/image.hpp"

inline tracer::Image coarse_sky() {
    constexpr int factor = 8;
    const tracer::Image fine = tracer::read_image(LUMIS_EXAMPLES_DATA "/venice_sunset_1k.hdr");
    tracer::Image coarse{fine.width / factor, fine.height / factor, {}};
    coarse.pixels.resize(fine.pixels.size() / (factor * factor));
    for (int y = 0; y < fine.height; ++y) {
        for (int x = 0; x < fine.width; ++x) {
            coarse.pixels[static_cast<std::size_t>(y / factor * coarse.width + x / factor)] +=
                fine.pixels[static_cast<std::size_t>(y * fine.width + x)] / float{factor * factor};
        }
    }
    return coarse;
}
