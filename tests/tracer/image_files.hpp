// What the tests of image files share: reading bytes, and the reason why they are refused.
#pragma once

#include "images/image.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace image_files {

[[nodiscard]] inline tracer::Image read(std::string_view bytes) {
    return tracer::read_image(std::as_bytes(std::span{bytes}), "a file");
}

// The message of a FileError; empty if nothing was thrown.
[[nodiscard]] std::string message_of(auto&& action) {
    try {
        action();
    } catch (const tracer::FileError& error) {
        return error.what();
    }
    return "";
}

// Why the bytes are refused; empty if they are not.
[[nodiscard]] inline std::string reason(std::string_view bytes) {
    const std::string message = message_of([&] { (void)read(bytes); });
    constexpr std::string_view start = "cannot read a file: ";
    return message.starts_with(start) ? message.substr(start.size()) : message;
}

// The largest difference between two values of two images of one size; NaN if a value is NaN, infinity if sizes differ.
[[nodiscard]] inline float largest_difference(const tracer::Image& a, const tracer::Image& b) {
    if (a.width != b.width || a.height != b.height) return std::numeric_limits<float>::infinity();
    float largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const float difference = std::abs(a.pixels[i][c] - b.pixels[i][c]);
            if (!(difference <= largest)) largest = difference;
        }
    }
    return largest;
}

}  // namespace image_files
