// examples/embree_host with Lumis's parts and with the textbook's: error x time of the room, for direct light and for paths.
//
//     embree_host_parts [width [samples a pixel]]
#include "textbook/host_parts.hpp"

#include "adaptors.hpp"
#include "images/image.hpp"
#include "render.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace {

constexpr int images = 64;

struct Cost {
    double error = 0, seconds = 0;  // relative mean squared error of one image, by how much independent ones differ
};

// The parts take turns, so that what else the machine does slows both alike.
template <class... Parts>
std::array<Cost, sizeof...(Parts)> costs(const host::Scene& scene, const host::View& view, int samples, int bounces,
                                         const Parts&... parts) {
    using Moments = std::vector<lumis::RunningMoments<float>>;
    std::array<Cost, sizeof...(Parts)> result;
    std::array<Moments, sizeof...(Parts)> moments;
    moments.fill(Moments(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height)));
    for (int i = 0; i < images; ++i) {
        std::size_t part = 0;
        const auto add = [&](const auto& these) {
            const std::clock_t start = std::clock();  // of all threads
            const auto image = render(scene, these, view, samples, bounces, static_cast<std::uint64_t>(i));
            result[part].seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
            for (std::size_t k = 0; k < image.size(); ++k) moments[part][k].add(luminance(image[k]));
            ++part;
        };
        (add(parts), ...);
    }
    for (std::size_t part = 0; part < sizeof...(Parts); ++part) {
        double variance = 0, squared = 0;
        for (const auto& m : moments[part]) variance += m.variance(), squared += m.mean() * m.mean();
        result[part].error = variance / squared;
        result[part].seconds /= images;
    }
    return result;
}

}  // namespace

int main(int argc, char** argv) {
    host::View view = host::room_view;
    view.width = argc > 1 ? std::atoi(argv[1]) : 160, view.height = view.width * 3 / 4;
    const int samples = argc > 2 ? std::atoi(argv[2]) : 16;
    const host::Scene scene{LUMIS_EXAMPLES_DATA "/room.obj",
                            host::read_sky(LUMIS_EXAMPLES_DATA "/venice_sunset_1k.hdr")};
    const textbook::HostParts textbook{scene}, by_power{scene, textbook::LightsBy::Power};
    const host::LumisParts lumis{scene};
    std::printf("| | parts | relative MSE | CPU seconds | error x time |\n| --- | --- | ---: | ---: | ---: |\n");
    for (const int bounces : {1, 8}) {
        const std::array all = costs(scene, view, samples, bounces, textbook, by_power, lumis);
        const std::array names{"textbook", "textbook, lights by power", "Lumis"};
        for (std::size_t part = 0; part < all.size(); ++part) {
            std::printf("| %s | %s | %.3g | %.3g | %.2f |\n", bounces == 1 ? "direct light" : "8 bounces", names[part],
                        all[part].error, all[part].seconds,
                        all[part].error * all[part].seconds / (all[0].error * all[0].seconds));
        }
    }
}
