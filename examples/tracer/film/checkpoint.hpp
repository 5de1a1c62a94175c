// A rendering on disk, from which it continues to the image that it would have become without a break, bit for bit.
#pragma once

#include "film/film.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tracer {

// All that the samples of a rendering depend on, name by name: {"scene", "veach"}, {"seed", "1"} ...; no line breaks.
using Origin = std::vector<std::pair<std::string, std::string>>;

struct Checkpoint {
    Film film;
    int pass_samples;        // of each of its passes, which are whole, and of those to come
    double cpu_seconds = 0;  // spent on it
};

// Replaces the file at once: whatever happens meanwhile, it is the old one or the new one, and whole. Throws FileError.
void save_checkpoint(const std::string& path, const Origin& origin, const Checkpoint& checkpoint);

// Throws FileError with the reason if the file is missing, cut short, damaged, or a rendering of another origin or size.
[[nodiscard]] Checkpoint load_checkpoint(const std::string& path, const Origin& origin, int width, int height);

// Throws FileError unless save_checkpoint could write there.
void require_checkpoint_writable(const std::string& path);

// "1a2b3c4d, 1234 bytes": what a file contains, whatever its name. Throws FileError.
[[nodiscard]] std::string checksum_of_file(const std::string& path);

}  // namespace tracer
