// Linear RGB images, and the files they come from and go to.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace tracer {

struct Image {
    int width{}, height{};
    std::vector<glm::vec3> pixels;  // row by row from the top, Rec. 709
    std::string remark{};           // what a choice had to be made about when it was read
};

// Channels that a file keeps beside the picture's R, G and B: up to three, by their full names ("albedo.R", "albedo.G" ...).
struct Layer {
    std::vector<std::string> channels;
    std::function<glm::vec3(std::size_t pixel)> values;  // of the first, second and third channel
};

// A file that cannot be read or written; what() says which and why.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Rec. 709.
[[nodiscard]] float luminance(const glm::vec3& color) noexcept;

// OpenEXR, Radiance and PNG files, told apart by how they begin: see image_exr.cpp, image_hdr.cpp and image_png.cpp for what
// of each is read. Throws FileError with the reason for everything else, for what is not well formed or more than the file
// can hold, for more than 65536 pixels along a side or 2^27 in all, and for a texel that is no light (infinite, NaN, or of
// negative luminance). Prints a remark, if there is one, on stderr.
[[nodiscard]] Image read_image(const std::string& path);

inline constexpr std::uint64_t max_pixels = std::uint64_t{1} << 27;

// The same from a file's bytes, without printing; `name` stands in messages.
[[nodiscard]] Image read_image(std::span<const std::byte> bytes, const std::string& name,
                               std::uint64_t limit = max_pixels);

// The ending, in small or capital letters, decides: .exr keeps the linear values and the layers, .png shows the picture in sRGB.
[[nodiscard]] bool is_writable_format(const std::string& path);
void write_image(const std::string& path, const Image& image, std::span<const Layer> layers = {});

// Throws FileError unless the file can be written. What it contains stays as it is.
void require_writable(const std::string& path);

// A .png of one byte a pixel, row by row from the top: numbers as grey, 0 black.
void write_grey(const std::string& path, int width, int height, std::span<const unsigned char> values);

}  // namespace tracer
