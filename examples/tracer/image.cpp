#include "image.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <glm/geometric.hpp>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#include <tinyexr.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>

namespace tracer {

namespace {

unsigned char srgb(float linear) {
    const float x = std::clamp(linear, 0.0f, 1.0f);
    const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
    return static_cast<unsigned char>(std::lround(255 * encoded));
}

void write_png(const std::string& path, const Image& image) {
    std::vector<unsigned char> bytes;
    bytes.reserve(3 * image.pixels.size());
    for (const auto& pixel : image.pixels) bytes.insert(bytes.end(), {srgb(pixel.r), srgb(pixel.g), srgb(pixel.b)});
    if (stbi_write_png(path.c_str(), image.width, image.height, 3, bytes.data(), 3 * image.width) == 0) {
        throw FileError("cannot write " + path);
    }
}

// tinyexr's message, which it asks us to free.
std::string take_reason(const char* reason) {
    const std::string why = reason != nullptr ? reason : "unknown error";
    FreeEXRErrorMessage(reason);
    return why;
}

void write_exr(const std::string& path, const Image& image) {
    const char* reason = nullptr;
    const float* values = &image.pixels.front().x;
    if (SaveEXR(values, image.width, image.height, 3, /*save_as_fp16=*/0, path.c_str(), &reason) != TINYEXR_SUCCESS) {
        throw FileError("cannot write " + path + ": " + take_reason(reason));
    }
}

Image read_exr(const std::string& path) {
    Image image;
    const char* reason = nullptr;
    float* values = nullptr;  // red, green, blue, alpha
    if (LoadEXR(&values, &image.width, &image.height, path.c_str(), &reason) != TINYEXR_SUCCESS) {
        throw FileError("cannot read " + path + ": " + take_reason(reason));
    }
    const std::unique_ptr<float, void (*)(void*)> owner{values, std::free};
    image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        image.pixels[i] = {values[4 * i], values[4 * i + 1], values[4 * i + 2]};
    }
    return image;
}

// A file as stb reads it. stb takes what is missing at the end of a Radiance file for zeros; this remembers that it was
// asked for more than there is.
struct File {
    std::ifstream stream;
    bool ended_early = false;

    static int read(void* self, char* data, int size) {
        auto& file = *static_cast<File*>(self);
        const auto got = static_cast<int>(file.stream.read(data, size).gcount());
        file.ended_early |= got == 0;
        return got;
    }
    static void skip(void* self, int bytes) { static_cast<File*>(self)->stream.ignore(bytes); }
    static int eof(void* self) { return static_cast<File*>(self)->stream.eof(); }
};

Image read_by_stb(const std::string& path) {
    File file{std::ifstream{path, std::ios::binary}};
    const stbi_io_callbacks callbacks{File::read, File::skip, File::eof};
    Image image;
    int channels = 0;
    const std::unique_ptr<float, void (*)(void*)> values{
        stbi_loadf_from_callbacks(&callbacks, &file, &image.width, &image.height, &channels, 3), stbi_image_free};
    if (values == nullptr) throw FileError("cannot read " + path + ": " + stbi_failure_reason());
    if (file.ended_early) throw FileError("cannot read " + path + ": it ends too early");
    image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    std::memcpy(image.pixels.data(), values.get(), image.pixels.size() * sizeof(glm::vec3));
    return image;
}

}  // namespace

float luminance(const glm::vec3& color) noexcept {
    return glm::dot(color, glm::vec3{0.2126f, 0.7152f, 0.0722f});
}

Image read_image(const std::string& path) {
    // The libraries say only that they cannot; the system knows why.
    if (!std::ifstream{path}) throw FileError("cannot read " + path + ": " + std::strerror(errno));
    return path.ends_with(".exr") ? read_exr(path) : read_by_stb(path);
}

bool is_writable_format(const std::string& path) {
    return path.ends_with(".png") || path.ends_with(".exr");
}

void write_image(const std::string& path, const Image& image) {
    if (!std::ofstream{path}) throw FileError("cannot write " + path + ": " + std::strerror(errno));
    path.ends_with(".exr") ? write_exr(path, image) : write_png(path, image);
}

}  // namespace tracer
