// The tracer's image reader: any bytes are an image or a FileError that says why not.
#include "check.hpp"
#include "image.hpp"

#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const bool is_exr = size > 0 && data[0] == 'v';  // its magic number begins so
    const std::string name = is_exr ? "fuzz.exr" : "fuzz.hdr";
    try {
        const tracer::Image image = tracer::read_image(std::as_bytes(std::span{data, size}), name);
        CHECK(image.width > 0 && image.height > 0);
        CHECK(image.pixels.size() == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    } catch (const tracer::FileError& error) {
        const std::string start = "cannot read " + name + ": ";
        CHECK(std::string{error.what()}.starts_with(start) && error.what() != start);
    }
    return 0;
}
