// Radiance pictures as many programs write them, byte by byte.
#include "catch.hpp"
#include "image_files.hpp"

#include <glm/geometric.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using namespace image_files;
using tracer::Image;
using namespace std::string_literals;
using namespace std::string_view_literals;

const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

// A pixel whose red is n / 128; its exponent 129 makes 1 of a mantissa of 128.
std::string pixel(int n) {
    return {static_cast<char>(n), '\2', '\3', '\x81'};
}

std::string pixels(const std::vector<int>& numbers) {
    std::string result;
    for (const int n : numbers) result += pixel(n);
    return result;
}

// The numbers of the pixels of an image, row by row from the top.
std::vector<int> numbers(const Image& image) {
    std::vector<int> result;
    for (const auto& p : image.pixels) {
        CHECK(p.g == 2 / 128.0f);
        CHECK(p.b == 3 / 128.0f);
        result.push_back(static_cast<int>(128 * p.r));
    }
    return result;
}

}  // namespace

TEST_CASE("a Radiance picture in each of eight orientations") {
    // The picture is 3 wide and 2 high: 10 20 30 above 40 50 60. Y points upwards.
    const std::vector<int> picture{10, 20, 30, 40, 50, 60};
    const std::vector<std::pair<std::string, std::vector<int>>> files{
        {"-Y 2 +X 3", {10, 20, 30, 40, 50, 60}}, {"-Y 2 -X 3", {30, 20, 10, 60, 50, 40}},
        {"+Y 2 +X 3", {40, 50, 60, 10, 20, 30}}, {"+Y 2 -X 3", {60, 50, 40, 30, 20, 10}},
        {"+X 3 -Y 2", {10, 40, 20, 50, 30, 60}}, {"-X 3 -Y 2", {30, 60, 20, 50, 10, 40}},
        {"+X 3 +Y 2", {40, 10, 50, 20, 60, 30}}, {"-X 3 +Y 2", {60, 30, 50, 20, 40, 10}}};
    for (const auto& [resolution, order] : files) {
        INFO(resolution);
        const Image image = read(header + "\n" + resolution + "\n" + pixels(order));
        CHECK(image.width == 3);
        CHECK(image.height == 2);
        CHECK(numbers(image) == picture);
    }
}

TEST_CASE("exposure and colour correction are taken back, all of them") {
    const auto first = [](const std::string& lines) {
        return read(header + lines + "\n-Y 1 +X 1\n\x80\x80\x80\x81").pixels[0];
    };
    CHECK(first("") == glm::vec3{1});
    CHECK(first("EXPOSURE=8\n") == glm::vec3{0.125f});
    CHECK(first("EXPOSURE= 8.0\nEXPOSURE=0.5\n") == glm::vec3{0.25f});
    CHECK(first("COLORCORR=2 4 0.5\nEXPOSURE=2\n") == glm::vec3{0.25f, 0.125f, 1});
    // A line that begins with a tab tells of a picture that this one was made from.
    CHECK(first("pcompos a.hdr\n\tEXPOSURE=8\nVIEW= -vtv\nPIXASPECT=1\nGAMMA=1.0\n") == glm::vec3{1});

    const auto why = [](const std::string& lines) { return reason(header + lines + "\n-Y 1 +X 1\n\x80\x80\x80\x81"); };
    CHECK(why("EXPOSURE=0\n") == "its line \"EXPOSURE=0\" is not positive");
    CHECK(why("EXPOSURE=-1\n") == "its line \"EXPOSURE=-1\" is not positive");
    CHECK(why("EXPOSURE=bright\n") == "its line \"EXPOSURE=bright\" is no number, or not enough of them");
    CHECK(why("COLORCORR=1 2\n") == "its line \"COLORCORR=1 2\" is no number, or not enough of them");
    CHECK(why("EXPOSURE=1e-38\nEXPOSURE=1e-38\n").starts_with("texel (0, 0) is not finite"));
    CHECK(why("GAMMA=2.2\n") == "its line \"GAMMA=2.2\" says that its values are not linear");
}

TEST_CASE("colours other than Rec. 709 are converted") {
    const auto first = [](const std::string& lines) {
        return read("#?RADIANCE\n" + lines + "\n-Y 1 +X 1\n\x80\x80\x80\x81").pixels[0];
    };
    // X = Y = Z = 1, by the inverse of IEC 61966-2-1's matrix.
    const glm::vec3 white = first("FORMAT=32-bit_rle_xyze\n");
    CHECK(std::abs(white.r - 1.2048f) <= 1e-3f);
    CHECK(std::abs(white.g - 0.9483f) <= 1e-3f);
    CHECK(std::abs(white.b - 0.9087f) <= 1e-3f);
    // So is the white of primaries whose white has equal energy.
    const glm::vec3 equal = first("FORMAT=32-bit_rle_rgbe\nPRIMARIES= .64 .33 .29 .60 .15 .06 .333333 .333333\n");
    CHECK(glm::length(equal - white) <= 1e-3f);
    CHECK(first("PRIMARIES= .64 .33 .30 .60 .15 .06 .3127 .3290\n") == glm::vec3{1});
    CHECK(first("PRIMARIES=0 0 0 0 0 0 0 0\n") == glm::vec3{1});  // Photoshop's "not known"
    CHECK(reason("#?RADIANCE\nPRIMARIES= 1 1 1 1 1 1 1 1\n\n-Y 1 +X 1\n\x80\x80\x80\x81") != "");
}

TEST_CASE("Windows' ends of lines, and a program of any name") {
    const std::string windows = "#?RGBE\r\nFORMAT=32-bit_rle_rgbe\r\nEXPOSURE=1\r\n\r\n-Y 1 +X 2\r\n";
    CHECK(numbers(read(windows + pixels({10, 20}))) == std::vector{10, 20});
    CHECK(reason("#?RADIANCE\nFORMAT=32-bit_rle_cmyk\n\n-Y 1 +X 1\n1234") ==
          "its line \"FORMAT=32-bit_rle_cmyk\" names neither 32-bit_rle_rgbe nor 32-bit_rle_xyze");
    CHECK(reason(header + "\n-Y 1 -Y 1\n1234") == "its line \"-Y 1 -Y 1\" is no resolution such as \"-Y 512 +X 1024\"");
}

TEST_CASE("old run lengths") {
    const auto read_line = [](int width, const std::string& bytes) {
        return numbers(read(header + "\n-Y 1 +X " + std::to_string(width) + "\n" + bytes));
    };
    const auto run = [](int count) { return "\1\1\1"s + static_cast<char>(count); };
    CHECK(read_line(6, pixel(9) + run(4) + pixel(8)) == std::vector{9, 9, 9, 9, 9, 8});
    // The second run in a row counts 256 times as much.
    std::vector<int> expected(1 + 3 + 2 * 256, 9);
    expected.push_back(8);
    CHECK(read_line(static_cast<int>(expected.size()), pixel(9) + run(3) + run(2) + pixel(8)) == expected);
    // A pixel in between starts anew.
    CHECK(read_line(6, pixel(9) + run(2) + pixel(8) + run(2)) == std::vector{9, 9, 9, 8, 8, 8});

    const std::string line = header + "\n-Y 1 +X 6\n";
    CHECK(reason(line + run(6) + pixel(8)) == "a line begins with a run that repeats nothing");
    CHECK(reason(line + pixel(9) + run(6)) == "a run is longer than its line");
    CHECK(reason(line + pixel(9) + run(0) + run(0) + run(0) + run(1)) == "a run is longer than its line");
    CHECK(reason(line + pixel(9) + run(2)) == "it ends too early");
}

TEST_CASE("new run lengths") {
    const std::string start = header + "\n-Y 1 +X 8\n";
    const auto line = [&](std::string_view begin, std::string_view red) {
        std::string file = start;
        for (const std::string_view part : {begin, red, "\x88\2"sv, "\x88\3"sv, "\x88\x81"sv}) file += part;
        return file;
    };
    CHECK(numbers(read(line("\2\2\0\10"sv, "\x85\7\3\1\2\3"sv))) == std::vector{7, 7, 7, 7, 7, 1, 2, 3});
    CHECK(reason(line("\2\2\0\11"sv, "\x88\7"sv)) == "a line has another length than the picture");
    CHECK(reason(line("\2\2\0\10"sv, "\x89\1"sv)) == "a run is empty or longer than its line");
    CHECK(reason(line("\2\2\0\10"sv, "\0\1"sv)) == "a run is empty or longer than its line");
    // A picture of 8 pixels may be flat all the same.
    CHECK(numbers(read(start + pixels({1, 2, 3, 4, 5, 6, 7, 8}))) == std::vector{1, 2, 3, 4, 5, 6, 7, 8});
}

TEST_CASE("a Radiance file that ends early or claims too much is refused") {
    const std::string whole = header + "EXPOSURE=2\n\n-Y 2 +X 8\n" +
                              "\2\2\0\10\x88\1\x88\2\x88\3\x88\x81\2\2\0\10\x88\1\x88\2\x88\3\x88\x81"s;
    CHECK(reason(whole) == "");
    for (std::size_t size = 0; size < whole.size(); ++size) CHECK(reason(whole.substr(0, size)) != "");
    // 1.5 GiB for 60 bytes.
    CHECK(reason(header + "\n-Y 11000 +X 12000\n") ==
          "an image of 12000 x 11000 is more than it can hold: it ends too early");
    CHECK(reason(header + "\n-Y 100000 +X 100000\n") == "an image of 100000 x 100000 is too large");
    CHECK(reason(header + "\n-Y -1 +X 8\n") == "an image of 8 x -1");
    CHECK(reason(header + "\n-Y 0 +X 8\n") == "an image of 8 x 0");
    CHECK(reason(header + "\n-Y 99999999999 +X 8\n") != "");
    CHECK(reason(header + "\n-Y 1 +X 2\n1234567") == "an image of 2 x 1 is more than it can hold: it ends too early");
    CHECK(reason(header + "\n-Y 1 +X 3\n1234567812") == "it ends too early");
}
