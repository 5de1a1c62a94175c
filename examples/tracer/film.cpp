#include "film.hpp"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tracer {

namespace {

// The image of value(pixel).
Image image_of(const Film& film, const auto& value) {
    Image image{film.width, film.height, {}};
    image.pixels.reserve(film.pixels.size());
    for (const Pixel& pixel : film.pixels) image.pixels.emplace_back(value(pixel));
    return image;
}

glm::vec3 mean_of(const glm::vec3& sum, const Pixel& pixel) {
    return sum / static_cast<float>(std::max(pixel.samples, 1u));
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
    return image_of(*this, [](const Pixel& pixel) { return mean_of(pixel.albedo, pixel); });
}

Image Film::normal() const {
    return image_of(*this, [](const Pixel& pixel) { return mean_of(pixel.normal, pixel); });
}

Image Film::sample_counts() const {
    return image_of(*this, [](const Pixel& pixel) { return glm::vec3{static_cast<float>(pixel.samples)}; });
}

double Film::relative_error() const {
    glm::dvec3 total{0};
    for (const Pixel& pixel : pixels) total += pixel.mean();
    const double values = 3 * static_cast<double>(pixels.size());
    const double floor = 0.1 * (total.r + total.g + total.b) / values;
    if (floor == 0 || passes() < 2) return std::numeric_limits<double>::infinity();

    glm::dvec3 squares{0};
    for (const Pixel& pixel : pixels) {
        const glm::dvec3 scale = glm::max(glm::abs(pixel.mean()), glm::dvec3{floor});
        squares += pixel.variance() / (scale * scale);
    }
    return std::sqrt((squares.r + squares.g + squares.b) / values);
}

}  // namespace tracer
