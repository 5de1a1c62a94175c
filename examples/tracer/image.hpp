// Linear RGB images, and the files they come from and go to.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace tracer {

struct Image {
    int width{}, height{};
    std::vector<glm::vec3> pixels;  // row by row from the top
};

// A file that cannot be read or written; what() says which and why.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Rec. 709.
[[nodiscard]] float luminance(const glm::vec3& color) noexcept;

// By the ending: .exr files (see exr_check.hpp for which), else Radiance .hdr and .png files (made linear). Throws FileError
// for what is not well formed, for more than 2^27 pixels (16384 x 8192), and for more than the file can hold.
[[nodiscard]] Image read_image(const std::string& path);
// The same from a file's bytes; `name` gives the ending and stands in messages.
[[nodiscard]] Image read_image(std::span<const std::byte> bytes, const std::string& name);

// By the ending: .exr keeps the linear values, .png shows them in sRGB.
[[nodiscard]] bool is_writable_format(const std::string& path);
void write_image(const std::string& path, const Image& image);

// A .png of one byte a pixel, row by row from the top: numbers as grey, 0 black.
void write_grey(const std::string& path, int width, int height, std::span<const unsigned char> values);

}  // namespace tracer
