// The irradiance of a photographed sky, with its sun and without: texels, not interpolated, so that the answer is a sum.
#include "lights/environment.hpp"

#include "problem.hpp"
#include <lumis/combine/in_frame.hpp>
#include <lumis/directions/cosine_hemisphere.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace {

using namespace convergence;

struct Sky {
    int width, height;
    std::vector<double> luminance;

    [[nodiscard]] double at(const glm::dvec3& w) const {
        const glm::dvec2 uv = lumis::latlong_from_direction(w);
        const auto cell = [](double x, int n) { return std::clamp(static_cast<int>(x * n), 0, n - 1); };
        return luminance[static_cast<std::size_t>(cell(uv.y, height) * width + cell(uv.x, width))];
    }

    // On a plane that faces +y. A texel spans cosines from c to d: its part is L (c^2 - d^2) / 2 times its width.
    [[nodiscard]] double irradiance() const {
        double sum = 0;
        for (int row = 0; row < height / 2; ++row) {
            const double c = std::cos(std::numbers::pi * row / height),
                         d = std::cos(std::numbers::pi * (row + 1) / height);
            double row_sum = 0;
            for (int x = 0; x < width; ++x) row_sum += luminance[static_cast<std::size_t>(row * width + x)];
            sum += row_sum * (c - d) * (c + d);
        }
        return sum * std::numbers::pi / width;
    }
};

// The sky and the luminance that a thousandth of its texels exceed.
std::pair<Sky, double> venice() {
    const tracer::Image image = tracer::read_image(LUMIS_EXAMPLES_DATA "/venice_sunset_1k.hdr");
    Sky sky{image.width, image.height, {}};
    for (const glm::vec3& pixel : image.pixels) sky.luminance.push_back(tracer::luminance(pixel));
    std::vector<double> sorted = sky.luminance;
    const auto brightest = sorted.end() - static_cast<std::ptrdiff_t>(sorted.size() / 1000);
    std::ranges::nth_element(sorted, brightest);
    return {std::move(sky), *brightest};
}

Problem environment(const std::string& title, const std::string& description, bool with_brightest) {
    auto [sky, bright] = venice();
    if (!with_brightest) {
        for (double& texel : sky.luminance) texel = texel < bright ? texel : 0;
    }
    const auto kept = std::make_shared<const Sky>(std::move(sky));
    const auto f = [kept](const glm::dvec3& w) { return w.y > 0 ? kept->at(w) * w.y : 0.0; };
    const Technique cosine{"bsdf",
                           lumis::in_frame(lumis::Frame{glm::dvec3{0, 1, 0}}, lumis::CosineHemisphere<double>{})};
    const Technique map{"light", lumis::EnvironmentMap<double>{kept->width, kept->height, kept->luminance}};
    const Partition sun_or_sky{[kept, limit = bright](const glm::dvec3& w) { return kept->at(w) < limit ? 0 : 1; }};
    Problem problem{"environment", title, description, Answer{kept->irradiance(), 0, "sum over all texels"}};
    return problem.compare(f, sun_or_sky, cosine, map);
}

const Registered with_sun{"environment", [] {
                              return environment(
                                  "Under a sunset",
                                  "The irradiance of a photographed sky of 1024 x 512 texels on the ground.", true);
                          }};
const Registered without_sun{"environment-without-brightest", [] {
                                 return environment("Under a sunset without its brightest texels",
                                                    "The same sky, the brightest thousandth of its texels black.",
                                                    false);
                             }};

}  // namespace
