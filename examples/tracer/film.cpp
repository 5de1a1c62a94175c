#include "film.hpp"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

namespace tracer {

namespace {

// The image of value(pixel).
Image image_of(const Film& film, const auto& value) {
    Image image{film.width, film.height, {}};
    image.pixels.reserve(film.pixels.size());
    for (const Pixel& pixel : film.pixels) image.pixels.emplace_back(value(pixel));
    return image;
}

glm::vec3 albedo_of(const Pixel& pixel) {
    return pixel.albedo / static_cast<float>(std::max(pixel.samples, 1u));
}
glm::vec3 normal_of(const Pixel& pixel) {
    return pixel.normal / static_cast<float>(std::max(pixel.samples, 1u));
}

// The sum of value(pixel) over pixels and channels, in the same order for any number of threads.
double sum_over(const std::vector<Pixel>& pixels, const auto& value) {
    const oneapi::tbb::blocked_range<std::size_t> all{0, pixels.size(), 4096};
    const auto sum = [&](const oneapi::tbb::blocked_range<std::size_t>& range, glm::dvec3 total) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) total += value(pixels[i]);
        return total;
    };
    const glm::dvec3 total = oneapi::tbb::parallel_deterministic_reduce(all, glm::dvec3{0}, sum, std::plus<>{});
    return total.r + total.g + total.b;
}

}  // namespace

glm::dvec3 Pixel::variance() const noexcept {
    if (passes < 2) return glm::dvec3{std::numeric_limits<double>::infinity()};
    const auto n = static_cast<double>(samples);
    const glm::dvec3 spread = squares - sum * sum / n;
    // Rounding may leave less than 0 of passes that are all equal. NaN stays NaN.
    return glm::max(spread, glm::dvec3{0}) / (n * (passes - 1.0));
}

void Film::merge(const Film& other) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        Pixel& to = pixels[i];
        const Pixel& from = other.pixels[i];
        to.sum += from.sum;
        to.squares += from.squares;
        to.passes += from.passes;
        to.samples += from.samples;
        to.albedo += from.albedo;
        to.normal += from.normal;
    }
}

Image Film::image() const {
    return image_of(*this, [](const Pixel& pixel) { return pixel.mean(); });
}

Image Film::standard_error() const {
    return image_of(*this, [](const Pixel& pixel) { return glm::sqrt(pixel.variance()); });
}

Image Film::albedo() const {
    return image_of(*this, albedo_of);
}

Image Film::normal() const {
    return image_of(*this, normal_of);
}

std::vector<Layer> Film::layers() const {
    const auto layer = [this](std::vector<std::string> channels, auto value) {
        return Layer{std::move(channels), [this, value](std::size_t i) -> glm::vec3 { return value(pixels[i]); }};
    };
    return {layer({"albedo.R", "albedo.G", "albedo.B"}, albedo_of),
            layer({"normal.X", "normal.Y", "normal.Z"}, normal_of),
            layer({"variance.R", "variance.G", "variance.B"}, [](const Pixel& pixel) { return pixel.variance(); }),
            layer({"samples"}, [](const Pixel& pixel) { return glm::vec3{static_cast<float>(pixel.samples)}; })};
}

double Film::relative_error() const {
    const double values = 3 * static_cast<double>(pixels.size());
    const double floor = 0.1 * sum_over(pixels, [](const Pixel& pixel) { return pixel.mean(); }) / values;
    if (floor == 0 || passes() < 2) return std::numeric_limits<double>::infinity();
    const double squares = sum_over(pixels, [floor](const Pixel& pixel) {
        const glm::dvec3 scale = glm::max(glm::abs(pixel.mean()), glm::dvec3{floor});
        return pixel.variance() / (scale * scale);
    });
    return std::sqrt(squares / values);
}

}  // namespace tracer
