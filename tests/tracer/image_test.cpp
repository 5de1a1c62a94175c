#include "image.hpp"

#include "catch.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <string_view>

namespace {

using namespace tracer;
namespace fs = std::filesystem;

// A folder of its own that goes away with the test.
struct Folder {
    fs::path path;
    Folder() {
        do {
            path = fs::temp_directory_path() / ("lumis_image_test_" + std::to_string(std::random_device{}()));
        } while (!fs::create_directory(path));  // another test's
    }
    ~Folder() { fs::remove_all(path); }
    [[nodiscard]] std::string file(const char* name) const { return (path / name).string(); }
};

std::string message_of(auto&& action) {
    try {
        action();
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("EXR keeps linear values") {
    const Folder folder;
    const Image image{2, 1, {{0.125f, 3000, 0}, {1e-4f, 7, 0.3f}}};
    write_image(folder.file("a.exr"), image);
    const Image read = read_image(folder.file("a.exr"));
    CHECK(read.width == 2);
    CHECK(read.height == 1);
    CHECK(read.pixels == image.pixels);
}

TEST_CASE("PNG shows them in sRGB") {
    const Folder folder;
    write_image(folder.file("a.png"), Image{3, 1, {{0, 0.5f, 1}, {2, -1, 0.0031308f}, {0.18f, 0.18f, 0.18f}}});
    const Image read = read_image(folder.file("a.png"));  // stb makes it linear by a power of 2.2
    REQUIRE(read.pixels.size() == 3);
    CHECK(read.pixels[0].r == 0);
    CHECK(std::abs(read.pixels[0].g - 0.5f) <= 0.02f);
    CHECK(read.pixels[0].b == 1);
    CHECK(read.pixels[1].r == 1);
    CHECK(read.pixels[1].g == 0);
    CHECK(std::abs(read.pixels[2].r - 0.18f) <= 0.02f);
}

TEST_CASE("the shipped environment map is read") {
    const Image map = read_image(LUMIS_EXAMPLES_DATA "/venice_sunset_1k.hdr");
    CHECK(map.width == 1024);
    CHECK(map.height == 512);
    float brightest = 0;
    for (const auto& pixel : map.pixels) brightest = std::max(brightest, luminance(pixel));
    CHECK(std::abs(brightest - 2090.5f) <= 0.5f);
}

TEST_CASE("a file that cannot be read or written says which and why") {
    const Folder folder;
    const auto reading = [&](const std::string& file) { return message_of([&] { (void)read_image(file); }); };
    const auto writing = [&](const std::string& file) {
        return message_of([&] { write_image(file, {1, 1, {{1, 1, 1}}}); });
    };

    CHECK(reading(folder.file("none.hdr")) == "cannot read " + folder.file("none.hdr") + ": No such file or directory");
    CHECK(writing(folder.file("none/a.png")) ==
          "cannot write " + folder.file("none/a.png") + ": No such file or directory");
    CHECK(writing(folder.file("none/a.exr")) ==
          "cannot write " + folder.file("none/a.exr") + ": No such file or directory");

    for (const char* name : {"broken.hdr", "broken.exr"}) {
        std::ofstream{folder.file(name)} << "not an image";
        CHECK(reading(folder.file(name)).starts_with("cannot read " + folder.file(name) + ": "));
    }
    std::ofstream{folder.file("cut.hdr")} << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 64\n";
    CHECK(reading(folder.file("cut.hdr")).starts_with("cannot read " + folder.file("cut.hdr") + ": "));
}

// What tests/fuzz/image_fuzzer.cpp found.
TEST_CASE("a corrupted file is refused before it costs memory or time") {
    const auto reading = [](std::string_view bytes, const std::string& name) {
        return message_of([&] { (void)read_image(std::as_bytes(std::span{bytes}), name); });
    };
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";

    // stb took what is missing for runs of length 0 and never came back.
    const std::string start_of_line{"\2\2\0\10", 4};
    CHECK(reading(header + "-Y 1 +X 8\n" + start_of_line, "a.hdr") == "cannot read a.hdr: it ends too early");
    // stb missed that the last pixel is cut.
    CHECK(reading(header + "-Y 1 +X 2\n1234567", "a.hdr") == "cannot read a.hdr: it ends too early");

    // 1.5 GiB for 60 bytes.
    CHECK(reading(header + "-Y 11000 +X 12000\n", "a.hdr") ==
          "cannot read a.hdr: an image of 12000 x 11000 is more than it can hold: it ends too early");
    CHECK(reading(header + "-Y 100000 +X 100000\n", "a.hdr") ==
          "cannot read a.hdr: an image of 100000 x 100000 is too large");
    CHECK(reading(header + "-Y -1 +X 8\n", "a.hdr") == "cannot read a.hdr: an image of 8 x -1");

    // 1 GiB for a PNG's chunk that is not there.
    const std::string_view png{"\211PNG\r\n\32\n\0\0\0\15IHDR\0\0\0\4\0\0\0\4\10\2\0\0\0abcd\77\0\0\0IDAT", 41};
    CHECK(reading(png, "a.png") == "cannot read a.png: it ends too early");
}

TEST_CASE("an OpenEXR file that tinyexr would trust is refused") {
    const Folder folder;
    write_image(folder.file("a.exr"), Image{2, 1, {{1, 2, 3}, {4, 5, 6}}});
    std::ifstream stream{folder.file("a.exr"), std::ios::binary};
    const std::string good{std::istreambuf_iterator<char>{stream}, {}};
    const auto reading = [](std::string_view bytes) {
        return message_of([&] { (void)read_image(std::as_bytes(std::span{bytes}), "a.exr"); });
    };
    const auto changed = [&](std::size_t position, std::string_view bytes) {
        std::string result = good;
        return result.replace(position, bytes.size(), bytes);
    };
    const auto value_of = [&](std::string_view name_and_type) {
        return good.find(name_and_type) + name_and_type.size() + 4;  // the value's size comes first
    };
    using namespace std::string_view_literals;
    CHECK(reading(good) == "");

    const std::size_t window = value_of("dataWindow\0box2i\0"sv);
    CHECK(reading(changed(window + 8, "\xff\xff\xff\x7f\xff\xff\xff\x7f"sv)) ==
          "cannot read a.exr: its data window is out of range");
    CHECK(reading(changed(window + 8, "\xff\xff\x00\0\xff\xff\x00\0"sv)) ==
          "cannot read a.exr: an image of 65536 x 65536 is too large");
    CHECK(reading(changed(window + 8, "\xff\x0f\x00\0"sv)) == "cannot read a.exr: a chunk is too small for its pixels");
    CHECK(reading(changed(value_of("compression\0compression\0"sv) - 4, "\0"sv)) ==
          "cannot read a.exr: attribute compression is empty or occurs twice");
    CHECK(reading(changed(4, "\2\2"sv)) == "cannot read a.exr: only single-part scanline OpenEXR files are supported");
    // Every other byte that is missing.
    for (std::size_t size = 0; size < good.size(); ++size) {
        CHECK(reading(good.substr(0, size)).starts_with("cannot read a.exr: "));
    }
}
