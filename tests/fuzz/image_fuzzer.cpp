// The tracer's image reader: any bytes are an image or a FileError that says why not.
#include "check.hpp"
#include "images/image.hpp"

#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string name = "fuzz";
    constexpr std::uint64_t limit = 1 << 16;  // pixels: large images find nothing more, but more slowly
    try {
        const tracer::Image image = tracer::read_image(std::as_bytes(std::span{data, size}), name, limit);
        CHECK(image.width > 0 && image.height > 0);
        CHECK(image.pixels.size() == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    } catch (const tracer::FileError& error) {
        const std::string start = "cannot read " + name + ": ";
        CHECK(std::string{error.what()}.starts_with(start) && error.what() != start);
    }
    return 0;
}
