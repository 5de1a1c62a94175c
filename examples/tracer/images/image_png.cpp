// PNG by stb: every kind of pixel, 1 to 16 bits, made linear. Colours are those of sRGB unless the file has a gamma (gAMA) or
// primaries (cHRM) of its own and does not say sRGB. What is transparent lets black through, as in OpenEXR files.
#include "images/image_formats.hpp"
#include "images/primaries.hpp"

#define STB_IMAGE_IMPLEMENTATION
// Each format of stb's is a parser more that a corrupted file can reach.
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <string_view>

namespace tracer {

namespace {

[[noreturn]] void fail() {
    throw std::runtime_error(stbi_failure_reason());
}

// Big endian.
std::uint32_t number_at(Bytes bytes) {
    std::uint32_t value = 0;
    for (const std::byte b : bytes.first(4)) value = value << 8 | std::to_integer<std::uint32_t>(b);
    return value;
}

struct Colors {
    bool srgb = false, profile = false;  // chunks sRGB and iCCP
    std::optional<float> gamma;
    std::optional<Primaries> primaries;
};

// Walks over all chunks to the last. stb allocates what a chunk claims to hold, up to 1 GiB, and only then looks whether it
// is there.
Colors read_chunks(Bytes bytes) {
    constexpr std::size_t signature = 8, around = 12;  // length and name before a chunk's data, a checksum behind
    bytes = bytes.subspan(signature);
    Colors colors;
    for (std::string_view name; name != "IEND";) {
        require(bytes.size() >= around, "it ends too early");
        const std::size_t length = number_at(bytes);
        require(length <= bytes.size() - around, "it ends too early");
        name = {reinterpret_cast<const char*>(bytes.data()) + 4, 4};
        const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
        require(std::ranges::all_of(name, is_letter), "the name of a chunk is not made of letters");
        const Bytes data = bytes.subspan(8, length);
        const auto number = [&](std::size_t i) { return static_cast<float>(number_at(data.subspan(4 * i))) / 100'000; };
        if (name == "sRGB") colors.srgb = true;
        if (name == "iCCP") colors.profile = true;
        if (name == "gAMA" && length == 4) colors.gamma = number(0);
        if (name == "cHRM" && length == 32) {
            colors.primaries = {
                {number(2), number(3)}, {number(4), number(5)}, {number(6), number(7)}, {number(0), number(1)}};
        }
        bytes = bytes.subspan(around + length);
    }
    return colors;
}

}  // namespace

Image read_png(Bytes file, std::uint64_t limit) {
    const Colors colors = read_chunks(file);
    const auto* bytes = reinterpret_cast<const unsigned char*>(file.data());
    const int size = static_cast<int>(file.size());
    require(size >= 0 && static_cast<std::size_t>(size) == file.size(), "a file of more than 2 GiB is too large");
    Image image;
    int channels = 0;
    if (stbi_info_from_memory(bytes, size, &image.width, &image.height, &channels) == 0) fail();
    require_size(image.width, image.height, limit);
    // Deflate makes at most 1032 bytes of one, and a byte holds up to 8 pixels.
    const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    require(pixels / (8 * 1032) <= file.size(),
            name_of_size(image.width, image.height) + " is more than it can hold: it ends too early");

    constexpr int rgba = 4;
    const std::unique_ptr<std::uint16_t, void (*)(void*)> values{
        stbi_load_16_from_memory(bytes, size, &image.width, &image.height, &channels, rgba), stbi_image_free};
    if (values == nullptr) fail();

    // A gamma of 1 / 2.2 is how older programs name sRGB.
    constexpr float srgb_gamma = 1 / 2.2f;
    const bool own_colors = !colors.srgb && !colors.profile;
    const bool own_gamma = own_colors && colors.gamma && std::abs(*colors.gamma - srgb_gamma) > 1e-3f;
    require(!own_gamma || *colors.gamma > 0, "its gamma is 0");
    std::vector<float> known(65536, -1.0f);  // by the value in the file
    const auto linear = [&](std::uint16_t value) {
        float& result = known[value];
        if (result >= 0) return result;
        const float encoded = static_cast<float>(value) / 65535;
        return result = own_gamma ? std::pow(encoded, 1 / *colors.gamma) : linear_from_srgb(encoded);
    };
    image.pixels.reserve(pixels);
    for (const auto* v = values.get(); image.pixels.size() < pixels; v += rgba) {
        const float opacity = static_cast<float>(v[3]) / 65535;
        image.pixels.push_back(opacity * glm::vec3{linear(v[0]), linear(v[1]), linear(v[2])});
    }
    if (own_colors && colors.primaries) convert_to_rec709(image, *colors.primaries);
    if (colors.profile) image.remark = "its colour profile is taken for sRGB";
    return image;
}

std::string png_file(int width, int height, int channels, std::span<const unsigned char> bytes) {
    const auto append = [](void* file, void* data, int size) {
        static_cast<std::string*>(file)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
    };
    std::string file;
    if (stbi_write_png_to_func(append, &file, width, height, channels, bytes.data(), channels * width) == 0) {
        throw std::bad_alloc{};
    }
    return file;
}

}  // namespace tracer
