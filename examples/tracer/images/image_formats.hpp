// The formats behind image.hpp, one in a file of its own each. Readers and writers throw any std::exception with the reason.
#pragma once

#include "images/image.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace tracer {

using Bytes = std::span<const std::byte>;

[[nodiscard]] Image read_exr(Bytes file, std::uint64_t limit);
[[nodiscard]] Image read_hdr(Bytes file, std::uint64_t limit);
[[nodiscard]] Image read_png(Bytes file, std::uint64_t limit);

// The bytes of a file.
[[nodiscard]] std::string exr_file(const Image& image, std::span<const Layer> layers);
[[nodiscard]] std::string png_file(int width, int height, int channels, std::span<const unsigned char> bytes);

// The curve of sRGB, from [0, 1] to [0, 1] and back.
[[nodiscard]] float srgb_from_linear(float linear) noexcept;
[[nodiscard]] float linear_from_srgb(float encoded) noexcept;

inline void require(bool condition, std::string_view reason) {
    if (!condition) throw std::runtime_error(std::string{reason});
}

// "an image of 16 x 8", for messages.
[[nodiscard]] std::string name_of_size(std::int64_t width, std::int64_t height);

// That it is neither empty nor too large.
void require_size(std::int64_t width, std::int64_t height, std::uint64_t limit);

}  // namespace tracer
