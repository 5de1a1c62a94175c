#include "image.hpp"

#include "catch.hpp"

#include <filesystem>
#include <fstream>

namespace {

using namespace tracer;
namespace fs = std::filesystem;

// A folder of its own that goes away with the test.
struct Folder {
    fs::path path = fs::temp_directory_path() / ("lumis_image_test_" + std::to_string(std::rand()));
    Folder() { fs::create_directory(path); }
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
