// A film's estimate of its own error, against errors known by other means.
#include "film/film.hpp"

#include "catch.hpp"
#include "folder.hpp"
#include "image_files.hpp"
#include "paths/random_stream.hpp"
#include <lumis/core/uniforms.hpp>
#include <lumis/statistics/error_metrics.hpp>
#include <lumis/statistics/running_moments.hpp>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>

#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace tracer;

// Passes of 8, and a last one of 3, of a channel of variance 1/12, one of 4/12 and one of none.
Film noise(int width, int height, std::uint64_t seed, int passes) {
    Film film{width, height};
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        lumis::Uniforms uniforms{random_stream(seed, i)};
        for (int pass = 0; pass < passes; ++pass) {
            const std::uint32_t samples = pass + 1 < passes ? 8 : 3;
            glm::dvec3 sum{0};
            for (std::uint32_t k = 0; k < samples; ++k) {
                const glm::vec2 u = uniforms.next<2>();
                sum += glm::dvec3{u.x, 2 * u.y, 0.7};
            }
            film.pixels[i].add_pass(sum, samples);
        }
    }
    return film;
}

std::span<const float> values(const Image& image) {
    return {&image.pixels.front().x, 3 * image.pixels.size()};
}

std::vector<float> channel(Imf::InputFile& file, const std::string& name, int width, int height) {
    REQUIRE(file.header().channels().findChannel(name) != nullptr);
    std::vector<float> result(static_cast<std::size_t>(width * height));
    Imf::FrameBuffer buffer;
    buffer.insert(name, {Imf::FLOAT, reinterpret_cast<char*>(result.data()), sizeof(float),
                         sizeof(float) * static_cast<std::size_t>(width)});
    file.setFrameBuffer(buffer);
    file.readPixels(0, height - 1);
    return result;
}

}  // namespace

// The mean over pixels of the estimated variance, whose own standard error is below 2 %: 7 passes tell a variance to
// sqrt(2 / 6), and there are 40,000 pixels.
TEST_CASE("the variance that a film tells is unbiased though the last pass is shorter") {
    const Film film = noise(200, 200, 1, 7);
    constexpr double samples = 6 * 8 + 3;
    CHECK(film.samples() == samples);
    CHECK(film.passes() == 7);
    glm::dvec3 variance{0};
    for (const Pixel& pixel : film.pixels) variance += pixel.variance() / static_cast<double>(film.pixels.size());
    CHECK(std::abs(variance.r * 12 * samples - 1) <= 0.015);
    CHECK(std::abs(variance.g * 3 * samples - 1) <= 0.015);
    CHECK(std::abs(variance.b) <= 1e-15);
    CHECK(std::abs(film.image().pixels[7].b - 0.7f) <= 1e-6f);
}

TEST_CASE("films merge as if their passes had been added to one") {
    Film one = noise(4, 2, 1, 3);
    const Film other = noise(4, 2, 2, 5), before = one;
    one.merge(other);
    CHECK(one.passes() == 8);
    CHECK(one.samples() == before.samples() + other.samples());
    for (std::size_t i = 0; i < one.pixels.size(); ++i) {
        CHECK(one.pixels[i].sum == before.pixels[i].sum + other.pixels[i].sum);
        CHECK(one.pixels[i].squares == before.pixels[i].squares + other.pixels[i].squares);
    }
}

// A bright square on a slope, whose samples deviate from their mean by as much as it. First with one bright pixel more, which
// is no mistake; then with one sample in a thousand that holds a hundred times its mean.
TEST_CASE("the relative error is that against the true image") {
    constexpr int size = 64, passes = 8, samples = 8;
    for (const double share : {0.0, 0.001}) {
        const auto value_at = [share](std::size_t i) {
            const std::size_t x = i % size, y = i / size;
            const bool is_bright = (x > 40 && y > 30) || (share == 0 && x == 10 && y == 10);
            return is_bright ? 20.0 : 0.02 * static_cast<double>(x);
        };
        Image truth{size, size, std::vector<glm::vec3>(size * size)};
        double mean = 0;
        for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
            truth.pixels[i] = glm::vec3{static_cast<float>(value_at(i) * (1 + 100 * share))};
            mean += truth.pixels[i].r / (size * size);
        }
        lumis::RunningMoments<> estimated, actual;  // squared
        for (std::uint64_t seed = 0; seed < 16; ++seed) {
            Film film{size, size};
            for (std::size_t i = 0; i < film.pixels.size(); ++i) {
                lumis::Uniforms uniforms{random_stream(seed, i)};
                for (int pass = 0; pass < passes; ++pass) {
                    double sum = 0;
                    for (int k = 0; k < samples; ++k) {
                        const glm::vec2 u = uniforms.next<2>();
                        sum += value_at(i) * (-std::log1p(-u.x) + (u.y < share ? 100 : 0));
                    }
                    film.pixels[i].add_pass(glm::dvec3{sum}, samples);
                }
            }
            const Image image = film.image();
            estimated.add(std::pow(film.relative_error(), 2));
            actual.add(lumis::relative_mean_squared_error(values(image), values(truth), 0.1 * mean));
        }
        INFO("share " << share << ": " << estimated.mean() << " +- " << estimated.standard_error() << ", actual "
                      << actual.mean() << " +- " << actual.standard_error());
        CHECK(std::abs(estimated.mean() / actual.mean() - 1) <= 0.1);
    }
}

TEST_CASE("a film that cannot know its error says so") {
    const double infinity = std::numeric_limits<double>::infinity();
    Film film{2, 1};
    CHECK(film.image().pixels[0] == glm::vec3{0});
    CHECK(film.relative_error() == infinity);
    const auto add = [&](double value) {
        for (Pixel& pixel : film.pixels) pixel.add_pass(glm::dvec3{value}, 1);
    };
    add(0);
    add(0);
    CHECK(film.relative_error() == infinity);  // all is black
    film = Film{2, 1};
    add(1);
    CHECK(film.relative_error() == infinity);  // one pass
    CHECK(film.standard_error().pixels[0].r == infinity);
    add(1);
    CHECK(film.relative_error() == 0);
    add(std::numeric_limits<double>::quiet_NaN());
    CHECK(std::isnan(film.relative_error()));
}

TEST_CASE("an EXR file keeps layers beside the picture") {
    const Folder folder;
    Film film = noise(5, 3, 1, 2);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const auto value = static_cast<float>(i);
        film.pixels[i].albedo = 11.0f * glm::vec3{value, value + 20, value + 40};
        film.pixels[i].normal = 11.0f * glm::vec3{-value, value + 60, value + 80};
    }
    const Image image = film.image(), error = film.standard_error();
    const std::vector<Layer> layers = film.layers();
    write_image(folder.file("a.exr"), image, layers);
    const Image read = read_image(folder.file("a.exr"));
    CHECK(image_files::largest_difference(read, image) == 0);
    CHECK(read.remark == "");

    Imf::InputFile file{folder.file("a.exr").c_str()};
    const auto require_channel = [&](const std::string& name, const auto& expected) {
        const std::vector<float> found = channel(file, name, 5, 3);
        for (std::size_t i = 0; i < found.size(); ++i) {
            INFO(name << ", pixel " << i);
            CHECK(std::abs(found[i] - expected(i)) <= 1e-5f * std::abs(expected(i)));
        }
    };
    for (int c = 0; c < 3; ++c) {
        const std::string color{"RGB"[c]}, axis{"XYZ"[c]};
        require_channel("albedo." + color,
                        [&](std::size_t i) { return static_cast<float>(i) + 20.0f * static_cast<float>(c); });
        require_channel("normal." + axis, [&](std::size_t i) { return film.normal().pixels[i][c]; });
        require_channel("variance." + color, [&](std::size_t i) { return error.pixels[i][c] * error.pixels[i][c]; });
    }
    require_channel("samples", [](std::size_t) { return 11.0f; });
    CHECK(film.normal().pixels[3] == glm::vec3{-3, 63, 83});
    CHECK(film.albedo().pixels[3] == glm::vec3{3, 23, 43});

    write_image(folder.file("a.png"), image, layers);  // has room for the picture alone
    CHECK(read_image(folder.file("a.png")).pixels.size() == 15);
}
