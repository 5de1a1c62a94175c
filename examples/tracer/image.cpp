#include "image.hpp"

#include "exr_check.hpp"

#define STB_IMAGE_IMPLEMENTATION
// Each format of stb's is a parser more that a corrupted file can reach.
#define STBI_ONLY_HDR
#define STBI_ONLY_PNG
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <glm/geometric.hpp>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#include <tinyexr.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <memory>
#include <sstream>
#include <utility>

namespace tracer {

namespace {

unsigned char srgb(float linear) {
    const float x = std::clamp(linear, 0.0f, 1.0f);
    const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
    return static_cast<unsigned char>(std::lround(255 * encoded));
}

void write_png(const std::string& path, int width, int height, int channels, const unsigned char* bytes) {
    if (stbi_write_png(path.c_str(), width, height, channels, bytes, channels * width) == 0) {
        throw FileError("cannot write " + path);
    }
}

void write_srgb(const std::string& path, const Image& image) {
    std::vector<unsigned char> bytes;
    bytes.reserve(3 * image.pixels.size());
    for (const auto& pixel : image.pixels) bytes.insert(bytes.end(), {srgb(pixel.r), srgb(pixel.g), srgb(pixel.b)});
    write_png(path, image.width, image.height, 3, bytes.data());
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

constexpr std::uint64_t max_pixels = std::uint64_t{1} << 27;

// tinyexr's own function for this leaks the header of a file whose pixels it cannot decode.
struct Exr {
    EXRHeader header;
    EXRImage image;

    Exr() {
        InitEXRHeader(&header);
        InitEXRImage(&image);
    }
    Exr(const Exr&) = delete;
    Exr& operator=(const Exr&) = delete;
    ~Exr() {
        FreeEXRImage(&image);
        FreeEXRHeader(&header);
    }

    // The only channel, or the one of a name; check_exr has seen to it that there is one.
    [[nodiscard]] const float* channel(const char* name) const {
        int c = 0;
        while (header.num_channels > 1 && std::strcmp(header.channels[c].name, name) != 0) ++c;
        return reinterpret_cast<const float*>(image.images[c]);
    }
};

Image read_exr(std::span<const std::byte> bytes) {
    check_exr(bytes, max_pixels);
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    const char* reason = nullptr;
    Exr exr;
    EXRVersion version{};
    version.version = 2;
    if (ParseEXRHeaderFromMemory(&exr.header, &version, data, bytes.size(), &reason) != TINYEXR_SUCCESS) {
        throw std::runtime_error(take_reason(reason));
    }
    std::fill_n(exr.header.requested_pixel_types, exr.header.num_channels, TINYEXR_PIXELTYPE_FLOAT);
    // On failure it frees the image but leaves it dangling, and of the channels as many as the image says it has.
    exr.image.num_channels = exr.header.num_channels;
    if (LoadEXRImageFromMemory(&exr.image, &exr.header, data, bytes.size(), &reason) != TINYEXR_SUCCESS) {
        InitEXRImage(&exr.image);
        throw std::runtime_error(take_reason(reason));
    }
    Image image{exr.image.width, exr.image.height, {}};
    image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    const float *red = exr.channel("R"), *green = exr.channel("G"), *blue = exr.channel("B");
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = {red[i], green[i], blue[i]};
    return image;
}

// A file as stb reads it, which remembers that stb asked for more than there is. stb takes what is missing at the end of a
// Radiance file for zeros, among them runs of length 0, and would not end; what it gets are line feeds, which end a header
// and are no run of length 0.
struct File {
    std::span<const std::byte> rest;
    bool ended_early = false;

    static int read(void* self, char* data, int size) {
        auto& file = *static_cast<File*>(self);
        const std::size_t wanted = static_cast<std::size_t>(size), got = std::min(wanted, file.rest.size());
        std::copy_n(reinterpret_cast<const char*>(file.rest.data()), got, data);
        std::fill_n(data + got, wanted - got, '\n');
        file.rest = file.rest.subspan(got);
        // It fills its buffer with what is left; of anything else it needs all.
        const bool is_buffer = wanted == sizeof(stbi__context::buffer_start);
        file.ended_early |= got == 0 || (got < wanted && !is_buffer);
        return got > 0 ? static_cast<int>(got) : size;
    }
    static void skip(void* self, int size) {
        auto& file = *static_cast<File*>(self);
        file.rest = file.rest.subspan(std::min(static_cast<std::size_t>(size), file.rest.size()));
    }
    static int eof(void* self) { return static_cast<File*>(self)->rest.empty(); }
};

constexpr stbi_io_callbacks callbacks{File::read, File::skip, File::eof};

// stb allocates what a chunk claims to hold, up to 1 GiB, and only then looks whether it is there.
void check_png_chunks(std::span<const std::byte> bytes) {
    constexpr std::size_t signature = 8, around = 12;  // length and name before a chunk's data, a checksum behind
    if (bytes.size() < signature || bytes[0] != std::byte{0x89}) return;
    bytes = bytes.subspan(signature);
    for (bool is_end = false; !is_end;) {
        if (bytes.size() < around) throw std::runtime_error("it ends too early");
        std::size_t length = 0;
        for (const std::byte b : bytes.first(4)) length = length << 8 | std::to_integer<std::size_t>(b);
        if (length > bytes.size() - around) throw std::runtime_error("it ends too early");
        is_end = std::memcmp(bytes.data() + 4, "IEND", 4) == 0;
        bytes = bytes.subspan(around + length);
    }
}

// stb allocates what the header asks for and only then looks for the pixels.
void check_size(std::span<const std::byte> bytes) {
    int width = 0, height = 0, channels = 0;
    File file{bytes};
    if (stbi_info_from_callbacks(&callbacks, &file, &width, &height, &channels) == 0) {
        throw std::runtime_error(stbi_failure_reason());
    }
    const std::string size = "an image of " + std::to_string(width) + " x " + std::to_string(height);
    if (width <= 0 || height <= 0) throw std::runtime_error(size);
    const auto w = static_cast<std::uint64_t>(width), h = static_cast<std::uint64_t>(height);
    if (w * h > max_pixels) throw std::runtime_error(size + " is too large");
    File again{bytes};
    // Radiance: a line of runs takes 4 bytes, and in each of 4 channels 2 bytes for up to 127 pixels; without runs, a pixel
    // takes 4 bytes. PNG: deflate makes at most 1032 bytes of one, and a byte holds up to 8 pixels.
    const bool is_radiance = stbi_is_hdr_from_callbacks(&callbacks, &again) != 0;
    const std::uint64_t least = is_radiance ? h * std::min(4 + 8 * ((w + 126) / 127), 4 * w) : w * h / (8 * 1032);
    if (least > bytes.size()) throw std::runtime_error(size + " is more than it can hold: it ends too early");
}

Image read_by_stb(std::span<const std::byte> bytes) {
    check_png_chunks(bytes);
    check_size(bytes);
    File file{bytes};
    Image image;
    int channels = 0;
    const std::unique_ptr<float, void (*)(void*)> values{
        stbi_loadf_from_callbacks(&callbacks, &file, &image.width, &image.height, &channels, 3), stbi_image_free};
    if (file.ended_early) throw std::runtime_error("it ends too early");
    if (values == nullptr) throw std::runtime_error(stbi_failure_reason());
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
    std::ifstream stream{path, std::ios::binary};
    if (!stream) throw FileError("cannot read " + path + ": " + std::strerror(errno));
    std::ostringstream content;
    content << stream.rdbuf();
    const std::string bytes = std::move(content).str();
    return read_image(std::as_bytes(std::span{bytes}), path);
}

Image read_image(std::span<const std::byte> bytes, const std::string& name) {
    try {
        return name.ends_with(".exr") ? read_exr(bytes) : read_by_stb(bytes);
    } catch (const std::exception& error) {
        throw FileError("cannot read " + name + ": " + error.what());
    }
}

bool is_writable_format(const std::string& path) {
    return path.ends_with(".png") || path.ends_with(".exr");
}

void write_image(const std::string& path, const Image& image) {
    if (!std::ofstream{path}) throw FileError("cannot write " + path + ": " + std::strerror(errno));
    path.ends_with(".exr") ? write_exr(path, image) : write_srgb(path, image);
}

void write_grey(const std::string& path, int width, int height, std::span<const unsigned char> values) {
    write_png(path, width, height, 1, values.data());
}

}  // namespace tracer
