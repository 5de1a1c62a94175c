// What an OpenEXR file must be before tinyexr may read it: tinyexr trusts sizes, counts and offsets of the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tracer {

// Throws std::runtime_error with the reason unless the bytes are a single-part scanline file, uncompressed or compressed by
// RLE or ZIP, of half or float channels R, G, B and others or of one channel, with at most `max_pixels` pixels, whose
// chunks lie in the file and can hold the pixels that the header claims.
void check_exr(std::span<const std::byte> bytes, std::uint64_t max_pixels);

}  // namespace tracer
