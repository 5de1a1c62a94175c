// Linear RGB images, and the files they come from and go to.
#pragma once

#include <glm/vec3.hpp>

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

// By the ending: .exr files, else Radiance .hdr files and whatever else stb reads (made linear).
[[nodiscard]] Image read_image(const std::string& path);

// By the ending: .exr keeps the linear values, .png shows them in sRGB.
[[nodiscard]] bool is_writable_format(const std::string& path);
void write_image(const std::string& path, const Image& image);

}  // namespace tracer
