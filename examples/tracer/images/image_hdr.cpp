// Radiance pictures (.hdr, .pic), as G. Ward's "Radiance File Formats" describes them: in RGB or XYZ, flat, in old or in new
// runs, in all eight orientations. Pixels are what they were before EXPOSURE and COLORCORR were applied. No library that
// Debian has reads all of this: OpenImageIO 2.4 and FreeImage 3.18 leave the exposure in and refuse old runs.
#include "images/image_formats.hpp"
#include "images/primaries.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

namespace tracer {

namespace {

struct Header {
    bool is_xyz = false;
    glm::vec3 factors{1};  // by which pixels have been multiplied
    std::optional<Primaries> primaries;
};

// A line up to its end, which is a line feed, or the two characters of Windows.
std::string take_line(Bytes& file) {
    const auto end = std::ranges::find(file, std::byte{'\n'});
    require(end != file.end(), "it ends too early");
    std::string line{reinterpret_cast<const char*>(file.data()), static_cast<std::size_t>(end - file.begin())};
    file = file.subspan(line.size() + 1);
    if (line.ends_with('\r')) line.pop_back();
    return line;
}

// As many numbers as asked for, and nothing else.
template <std::size_t N>
std::array<float, N> numbers(const std::string& line, const std::string& text) {
    std::array<float, N> result{};
    std::istringstream stream{text};
    for (float& number : result) stream >> number;
    require(!stream.fail() && (stream >> std::ws).eof(),
            "its line \"" + line + "\" is no number, or not enough of them");
    return result;
}

void multiply(glm::vec3& factors, const glm::vec3& by, const std::string& line) {
    for (int c = 0; c < 3; ++c) require(by[c] > 0 && std::isfinite(by[c]), "its line \"" + line + "\" is not positive");
    factors *= by;
}

// Lines NAME=value up to an empty one. A line that begins with a space belongs to a picture that this one was made from.
Header take_header(Bytes& file) {
    Header header;
    for (std::string line = take_line(file); !line.empty(); line = take_line(file)) {
        const auto equals = std::min(line.find('='), line.size());
        const std::string name = line.substr(0, equals);
        std::string value = line.substr(std::min(equals + 1, line.size()));
        if (name == "EXPOSURE") multiply(header.factors, glm::vec3{numbers<1>(line, value)[0]}, line);
        if (name == "COLORCORR") {
            const auto [r, g, b] = numbers<3>(line, value);
            multiply(header.factors, {r, g, b}, line);
        }
        if (name == "PRIMARIES") {
            const auto n = numbers<8>(line, value);
            header.primaries = {{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}};
            if (n == decltype(n){}) header.primaries.reset();  // Photoshop writes zeros for "not known"
        }
        if (name == "GAMMA") {
            require(numbers<1>(line, value)[0] == 1, "its line \"" + line + "\" says that its values are not linear");
        }
        if (name == "FORMAT") {
            std::erase(value, ' ');
            header.is_xyz = value == "32-bit_rle_xyze";
            require(header.is_xyz || value == "32-bit_rle_rgbe",
                    "its line \"" + line + "\" names neither 32-bit_rle_rgbe nor 32-bit_rle_xyze");
        }
    }
    return header;
}

// "-Y 512 +X 1024": lines follow one another along the first axis, and pixels within a line along the second. Y points
// upwards.
struct Resolution {
    std::array<char, 2> sign, axis;
    std::array<int, 2> size;

    [[nodiscard]] bool is_upright() const { return axis[0] == 'Y'; }
    [[nodiscard]] int width() const { return size[is_upright() ? 1 : 0]; }
    [[nodiscard]] int height() const { return size[is_upright() ? 0 : 1]; }

    // Where the pixel of a line belongs, row by row from the top.
    [[nodiscard]] std::size_t index(int line, int pixel) const {
        const std::array at{line, pixel};
        const auto along = [&](std::size_t i, char from_zero) {
            return sign[i] == from_zero ? at[i] : size[i] - 1 - at[i];
        };
        const int y = along(is_upright() ? 0 : 1, '-'), x = along(is_upright() ? 1 : 0, '+');
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x);
    }
};

Resolution take_resolution(Bytes& file) {
    const std::string line = take_line(file);
    Resolution r{};
    std::istringstream stream{line};
    for (std::size_t i = 0; i < 2; ++i) stream >> r.sign[i] >> r.axis[i] >> r.size[i];
    const auto is_sign = [](char c) { return c == '+' || c == '-'; };
    const bool axes = (r.axis[0] == 'Y' && r.axis[1] == 'X') || (r.axis[0] == 'X' && r.axis[1] == 'Y');
    require(!stream.fail() && is_sign(r.sign[0]) && is_sign(r.sign[1]) && axes,
            "its line \"" + line + "\" is no resolution such as \"-Y 512 +X 1024\"");
    return r;
}

using Rgbe = std::array<unsigned char, 4>;  // three mantissas and the exponent that they share

unsigned char take_byte(Bytes& file) {
    require(!file.empty(), "it ends too early");
    const auto value = std::to_integer<unsigned char>(file.front());
    file = file.subspan(1);
    return value;
}

// Pixel by pixel. 1, 1, 1, n stands for n pixels more like the last; a second such in a row counts 256 n, a third 65536 n.
void take_old_line(Bytes& file, std::vector<Rgbe>& line) {
    int shift = 0;
    for (std::size_t x = 0; x < line.size();) {
        Rgbe pixel;
        for (auto& byte : pixel) byte = take_byte(file);
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            line[x++] = pixel;
            shift = 0;
            continue;
        }
        const std::size_t count = std::size_t{pixel[3]} << shift;
        require(x > 0, "a line begins with a run that repeats nothing");
        require(shift <= 16 && count <= line.size() - x, "a run is longer than its line");
        std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(x), count, line[x - 1]);
        x += count;
        shift += 8;
    }
}

// One channel after another. A count above 128 stands for count - 128 equal bytes, another for as many bytes as they are.
void take_new_line(Bytes& file, std::vector<Rgbe>& line) {
    file = file.subspan(4);
    for (std::size_t c = 0; c < 4; ++c) {
        for (std::size_t x = 0; x < line.size();) {
            const unsigned char code = take_byte(file);
            const bool is_run = code > 128;
            const std::size_t count = is_run ? code - 128u : code;
            require(count > 0 && count <= line.size() - x, "a run is empty or longer than its line");
            const unsigned char value = is_run ? take_byte(file) : 0;
            for (const std::size_t end = x + count; x < end; ++x) line[x][c] = is_run ? value : take_byte(file);
        }
    }
}

// A line in new runs begins with 2, 2 and its own length.
bool begins_new_line(Bytes file, std::size_t width) {
    if (width < 8 || width > 0x7fff || file.size() < 4) return false;
    const auto byte = [&](std::size_t i) { return std::to_integer<std::size_t>(file[i]); };
    if (byte(0) != 2 || byte(1) != 2 || byte(2) >= 128) return false;
    require((byte(2) << 8 | byte(3)) == width, "a line has another length than the picture");
    return true;
}

// Bytes that a line takes at least: in new runs, 4 and in each of 4 channels 2 for up to 127 pixels; in old runs, 4 for a
// pixel and 4 for each power of 256 in the number of those that repeat it.
std::uint64_t least_bytes(std::uint64_t width) {
    const std::uint64_t in_old_runs = width == 1 ? 4 : width <= 1 + 255 ? 8 : width <= 1 + 255 * 257 ? 12 : 16;
    return std::min(in_old_runs, 4 + 8 * ((width + 126) / 127));
}

// Without the half that Radiance's own programs add to a mantissa: other programs, which wrote most files, do not.
glm::vec3 color(const Rgbe& pixel) {
    if (pixel[3] == 0) return glm::vec3{0};
    return std::ldexp(1.0f, int{pixel[3]} - (128 + 8)) * glm::vec3{pixel[0], pixel[1], pixel[2]};
}

}  // namespace

Image read_hdr(Bytes file, std::uint64_t limit) {
    (void)take_line(file);  // the name of the program, mostly "#?RADIANCE"
    const Header header = take_header(file);
    const Resolution resolution = take_resolution(file);
    Image image{resolution.width(), resolution.height(), {}};
    require_size(image.width, image.height, limit);
    const auto [lines, width] = resolution.size;
    require(static_cast<std::uint64_t>(lines) * least_bytes(static_cast<std::uint64_t>(width)) <= file.size(),
            name_of_size(image.width, image.height) + " is more than it can hold: it ends too early");

    image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    std::vector<Rgbe> line(static_cast<std::size_t>(width));
    for (int i = 0; i < lines; ++i) {
        begins_new_line(file, line.size()) ? take_new_line(file, line) : take_old_line(file, line);
        for (int j = 0; j < width; ++j) {
            image.pixels[resolution.index(i, j)] = color(line[static_cast<std::size_t>(j)]) / header.factors;
        }
    }
    if (header.is_xyz) convert_xyz_to_rec709(image);
    if (!header.is_xyz && header.primaries) convert_to_rec709(image, *header.primaries);
    return image;
}

}  // namespace tracer
