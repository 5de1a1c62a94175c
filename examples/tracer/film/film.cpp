#include "film/film.hpp"

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

// The sum of value(i) over pixels and channels, in the same order for any number of threads.
double sum_over_pixels(std::size_t count, const auto& value) {
    const oneapi::tbb::blocked_range<std::size_t> all{0, count, 4096};
    const auto sum = [&](const oneapi::tbb::blocked_range<std::size_t>& range, glm::dvec3 total) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) total += value(i);
        return total;
    };
    const glm::dvec3 total = oneapi::tbb::parallel_deterministic_reduce(all, glm::dvec3{0}, sum, std::plus<>{});
    return total.r + total.g + total.b;
}

// The third largest of a pixel's eight neighbours, channel by channel. Beyond the edge, the image goes on as at the edge.
glm::vec3 third_brightest_around(const Image& image, std::size_t index) {
    const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
    const std::size_t x = index % width, y = index / width;
    const std::size_t columns[]{x - (x > 0), x, x + (x + 1 < width)};
    const std::size_t rows[]{y - (y > 0), y, y + (y + 1 < height)};
    glm::vec3 first{0}, second{0}, third{0};
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            if (rows[r] == y && columns[c] == x) continue;
            const glm::vec3& value = image.pixels[rows[r] * width + columns[c]];
            third = glm::max(third, glm::min(second, value));
            second = glm::max(second, glm::min(first, value));
            first = glm::max(first, value);
        }
    }
    return third;
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
    const Image means = image();
    const double values = 3 * static_cast<double>(pixels.size());
    const double floor = 0.1 * sum_over_pixels(pixels.size(), [&](std::size_t i) { return means.pixels[i]; }) / values;
    if (floor == 0 || passes() < 2) return std::numeric_limits<double>::infinity();
    const double squares = sum_over_pixels(pixels.size(), [&](std::size_t i) {
        const glm::dvec3 value = pixels[i].mean(), variance = pixels[i].variance();
        const glm::dvec3 likely = glm::min(value, glm::dvec3{third_brightest_around(means, i)});
        const glm::dvec3 scale = glm::max(glm::max(likely, value - 2.0 * glm::sqrt(variance)), glm::dvec3{floor});
        return variance / (scale * scale);
    });
    return std::sqrt(squares / values);
}

}  // namespace tracer
