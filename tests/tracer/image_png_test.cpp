// PNG files of every kind of pixel, byte by byte.
#include "catch.hpp"
#include "image_files.hpp"

#include <boost/crc.hpp>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace image_files;
using tracer::Image;
using namespace std::string_literals;

std::string big_endian(std::uint32_t n) {
    return {static_cast<char>(n >> 24), static_cast<char>(n >> 16), static_cast<char>(n >> 8), static_cast<char>(n)};
}

std::string chunk(const std::string& name, const std::string& data) {
    boost::crc_32_type crc;
    crc.process_bytes((name + data).data(), name.size() + data.size());
    return big_endian(static_cast<std::uint32_t>(data.size())) + name + data + big_endian(crc.checksum());
}

// One stored block of at most 65535 bytes.
std::string deflated(const std::string& bytes) {
    std::uint32_t a = 1, b = 0;  // Adler-32
    for (const char c : bytes) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (a + b) % 65521;
    }
    const auto size = static_cast<unsigned>(bytes.size()), opposite = ~size;
    return "\x78\x01\x01"s + static_cast<char>(size) + static_cast<char>(size >> 8) + static_cast<char>(opposite) +
           static_cast<char>(opposite >> 8) + bytes + big_endian(b << 16 | a);
}

enum class Kind : char { Grey = 0, Rgb = 2, Palette = 3, GreyAlpha = 4, Rgba = 6 };

// One row.
std::string png(int width, int bits, Kind kind, const std::string& row, const std::string& chunks = "") {
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR", big_endian(static_cast<std::uint32_t>(width)) + big_endian(1) + static_cast<char>(bits) +
                             static_cast<char>(kind) + "\0\0\0"s) +
           chunks + chunk("IDAT", deflated("\0"s + row)) + chunk("IEND", "");
}

// IEC 61966-2-1, in double precision.
double linear(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

bool is_close(const glm::vec3& color, double r, double g, double b) {
    const auto close = [](float value, double expected) { return std::abs(value - expected) <= 1e-6 * expected; };
    return close(color.r, r) && close(color.g, g) && close(color.b, b);
}

bool is_grey(const glm::vec3& color, double value) {
    return is_close(color, value, value, value);
}

}  // namespace

TEST_CASE("PNG values of all depths are made linear by the curve of sRGB") {
    std::string all;
    for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
    const Image grey = read(png(256, 8, Kind::Grey, all));
    REQUIRE(grey.pixels.size() == 256);
    for (std::size_t i = 0; i < 256; ++i) CHECK(is_grey(grey.pixels[i], linear(static_cast<double>(i) / 255)));

    const Image bits = read(png(8, 1, Kind::Grey, "\xa0"));
    CHECK(bits.pixels[0] == glm::vec3{1});
    CHECK(bits.pixels[1] == glm::vec3{0});
    CHECK(is_grey(read(png(2, 4, Kind::Grey, "\x30")).pixels[0], linear(3 / 15.0)));

    const auto deep = read(png(1, 16, Kind::Rgb, "\x00\x01\x12\x34\xff\xff"s));
    CHECK(is_close(deep.pixels[0], linear(1 / 65535.0), linear(0x1234 / 65535.0), 1));
    CHECK(is_close(read(png(1, 8, Kind::Rgb, "\x01\x80\xff")).pixels[0], linear(1 / 255.0), linear(128 / 255.0), 1));
    const Image palette = read(png(2, 8, Kind::Palette, "\1\0"s, chunk("PLTE", "\x80\x01\x02\xff\x01\x80"s)));
    CHECK(is_close(palette.pixels[0], 1, linear(1 / 255.0), linear(128 / 255.0)));
}

TEST_CASE("what is transparent in a PNG lets black through") {
    CHECK(is_grey(read(png(1, 8, Kind::GreyAlpha, "\xff\x33")).pixels[0], 0.2));
    CHECK(is_close(read(png(1, 8, Kind::Rgba, "\xff\x80\x01\x33")).pixels[0], 0.2, 0.2 * linear(128 / 255.0),
                   0.2 * linear(1 / 255.0)));
    CHECK(is_grey(read(png(1, 16, Kind::GreyAlpha, "\xff\xff\x33\x33")).pixels[0], 0.2));
    // A palette's second colour, and a colour declared to be transparent.
    const Image palette =
        read(png(2, 8, Kind::Palette, "\0\1"s, chunk("PLTE", "\xff\xff\xff\xff\xff\xff") + chunk("tRNS", "\xff\x33")));
    CHECK(is_grey(palette.pixels[0], 1));
    CHECK(is_grey(palette.pixels[1], 0.2));
    CHECK(is_grey(read(png(1, 8, Kind::Grey, "\xff", chunk("tRNS", "\0\xff"s))).pixels[0], 0));
}

TEST_CASE("a PNG's own gamma and primaries are used unless it says sRGB") {
    const auto gamma = [](std::uint32_t value) { return chunk("gAMA", big_endian(value)); };
    const auto first = [](const std::string& chunks) {
        return read(png(1, 8, Kind::Rgb, "\x80\x80\x80", chunks)).pixels[0];
    };
    const double encoded = 128 / 255.0;
    CHECK(is_grey(first(gamma(100'000)), encoded));
    CHECK(is_grey(first(gamma(50'000)), encoded * encoded));
    CHECK(is_grey(first(gamma(45'455)), linear(encoded)));  // how older programs name sRGB
    CHECK(is_grey(first(gamma(100'000) + chunk("sRGB", "\0"s)), linear(encoded)));
    CHECK(reason(png(1, 8, Kind::Grey, "\1", gamma(0))) == "its gamma is 0");

    std::string rec2020;
    for (const std::uint32_t n : {31270u, 32900u, 70800u, 29200u, 17000u, 79700u, 13100u, 4600u})
        rec2020 += big_endian(n);
    const Image red = read(png(1, 8, Kind::Rgb, "\xff\0\0"s, chunk("cHRM", rec2020)));
    CHECK(std::abs(red.pixels[0].r - 1.6605f) <= 1e-3f);  // ITU-R BT.2087
    CHECK(std::abs(red.pixels[0].g + 0.1246f) <= 1e-3f);
    CHECK(std::abs(red.pixels[0].b + 0.0182f) <= 1e-3f);
    CHECK(read(png(1, 8, Kind::Grey, "\1", chunk("iCCP", "x\0\0"s))).remark == "its colour profile is taken for sRGB");
}

TEST_CASE("a PNG file that ends early or claims too much is refused") {
    const std::string whole = png(4, 8, Kind::Grey, "1234");
    CHECK(reason(whole) == "");
    for (std::size_t size = 0; size < whole.size(); ++size) CHECK(reason(whole.substr(0, size)) != "");
    CHECK(reason(whole.substr(0, whole.size() - 1)) == "it ends too early");
    CHECK(reason(png(5, 8, Kind::Grey, "1234")) != "");
    CHECK(reason(png(100'000, 8, Kind::Grey, "1234")) == "an image of 100000 x 1 is too large");

    CHECK(reason(png(4, 8, Kind::Grey, "1234", chunk("\0\0\0\0"s, ""))) ==
          "the name of a chunk is not made of letters");
    CHECK(reason(png(4, 8, Kind::Grey, "1234", chunk("ABCD", ""))) == "ABCD PNG chunk not known");

    std::string large = whole;
    large.replace(16, 8, big_endian(12'000) + big_endian(11'000));
    CHECK(reason(large) == "an image of 12000 x 11000 is more than it can hold: it ends too early");
    // 1 GiB for a chunk that is not there.
    std::string claims = whole;
    claims.replace(whole.find("IDAT") - 4, 4, big_endian(0x3f000000));
    CHECK(reason(claims) == "it ends too early");
}
