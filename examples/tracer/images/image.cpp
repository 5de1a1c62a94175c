#include "images/image.hpp"

#include "images/image_formats.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <new>
#include <sstream>
#include <string_view>
#include <utility>

namespace tracer {

namespace {

// In small or capital letters.
bool ends_in(std::string_view path, std::string_view ending) {
    return path.size() >= ending.size() &&
           std::ranges::equal(path.substr(path.size() - ending.size()), ending, {},
                              [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
}

bool starts_with(Bytes file, std::string_view magic) {
    return file.size() >= magic.size() && std::memcmp(file.data(), magic.data(), magic.size()) == 0;
}

Image read_by_content(Bytes file, std::uint64_t limit) {
    require(!file.empty(), "it is empty");
    if (starts_with(file, "\x76\x2f\x31\x01")) return read_exr(file, limit);
    if (starts_with(file, "#?")) return read_hdr(file, limit);
    if (starts_with(file, "\x89PNG\r\n\x1a\n")) return read_png(file, limit);
    throw std::runtime_error("it is neither an OpenEXR nor a Radiance nor a PNG file");
}

// Every texel is light: finite, and its luminance, which strategies are built from, not negative.
void require_light(const Image& image) {
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec3& color = image.pixels[i];
        const bool finite = std::isfinite(color.r) && std::isfinite(color.g) && std::isfinite(color.b);
        const float y = luminance(color);
        if (finite && y >= 0 && y <= std::numeric_limits<float>::max()) continue;
        const auto width = static_cast<std::size_t>(image.width);
        std::ostringstream reason;
        reason << "texel (" << i % width << ", " << i / width << ") is "
               << (finite ? "of negative luminance" : "not finite") << ": (" << color.r << ", " << color.g << ", "
               << color.b << ')';
        throw std::runtime_error(reason.str());
    }
}

std::string srgb_file(const Image& image) {
    std::vector<unsigned char> bytes;
    bytes.reserve(3 * image.pixels.size());
    for (const auto& pixel : image.pixels) {
        for (int c = 0; c < 3; ++c) {
            bytes.push_back(static_cast<unsigned char>(std::lround(255 * srgb_from_linear(pixel[c]))));
        }
    }
    return png_file(image.width, image.height, 3, bytes);
}

// The libraries say only that they cannot; the system knows why.
[[noreturn]] void fail(const std::string& what, const std::string& path) {
    throw FileError("cannot " + what + " " + path + ": " + std::strerror(errno));
}

std::string read_file(const std::string& path) {
    std::ifstream stream{path, std::ios::binary};
    try {
        if (stream) return {std::istreambuf_iterator<char>{stream}, {}};
    } catch (const std::ios_base::failure&) {  // a folder
    }
    fail("read", path);
}

void write_file(const std::string& path, const std::string& bytes) {
    std::ofstream stream{path, std::ios::binary};
    if (!stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush()) fail("write", path);
}

}  // namespace

float luminance(const glm::vec3& color) noexcept {
    return glm::dot(color, glm::vec3{0.2126f, 0.7152f, 0.0722f});
}

float srgb_from_linear(float linear) noexcept {
    const float x = std::clamp(linear, 0.0f, 1.0f);
    return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
}

float linear_from_srgb(float encoded) noexcept {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

std::string name_of_size(std::int64_t width, std::int64_t height) {
    return "an image of " + std::to_string(width) + " x " + std::to_string(height);
}

void require_size(std::int64_t width, std::int64_t height, std::uint64_t limit) {
    constexpr std::int64_t max_side = 65536;
    require(width > 0 && height > 0, name_of_size(width, height));
    require(width <= max_side && height <= max_side && static_cast<std::uint64_t>(width * height) <= limit,
            name_of_size(width, height) + " is too large");
}

Image read_image(const std::string& path) {
    const std::string bytes = read_file(path);
    Image image = read_image(std::as_bytes(std::span{bytes}), path);
    if (!image.remark.empty()) std::cerr << path << ": " << image.remark << '\n';
    return image;
}

Image read_image(Bytes bytes, const std::string& name, std::uint64_t limit) {
    try {
        Image image = read_by_content(bytes, limit);
        require_light(image);
        return image;
    } catch (const std::bad_alloc&) {
        throw FileError("cannot read " + name + ": there is not enough memory for it");
    } catch (const std::exception& error) {
        throw FileError("cannot read " + name + ": " + error.what());
    }
}

bool is_writable_format(const std::string& path) {
    return ends_in(path, ".png") || ends_in(path, ".exr");
}

void require_writable(const std::string& path) {
    const bool is_new = !std::filesystem::exists(path);
    if (!std::ofstream{path, std::ios::app}) fail("write", path);
    if (is_new) std::filesystem::remove(path);
}

void write_image(const std::string& path, const Image& image, std::span<const Layer> layers) {
    write_file(path, ends_in(path, ".exr") ? exr_file(image, layers) : srgb_file(image));
}

void write_grey(const std::string& path, int width, int height, std::span<const unsigned char> values) {
    write_file(path, png_file(width, height, 1, values));
}

}  // namespace tracer
