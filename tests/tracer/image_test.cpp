#include "catch.hpp"
#include "folder.hpp"
#include "image_files.hpp"

#include <filesystem>
#include <fstream>
#include <string>

namespace {

using namespace tracer;
using image_files::message_of;

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
    const Image read = read_image(folder.file("a.png"));
    REQUIRE(read.pixels.size() == 3);
    CHECK(read.pixels[0].r == 0);
    CHECK(std::abs(read.pixels[0].g - 0.5f) <= 0.005f);
    CHECK(read.pixels[0].b == 1);
    CHECK(read.pixels[1].r == 1);
    CHECK(read.pixels[1].g == 0);
    CHECK(std::abs(read.pixels[2].r - 0.18f) <= 0.002f);
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
        CHECK(reading(folder.file(name)) ==
              "cannot read " + folder.file(name) + ": it is neither an OpenEXR nor a Radiance nor a PNG file");
    }
    std::ofstream{folder.file("empty.exr")};
    CHECK(reading(folder.file("empty.exr")) == "cannot read " + folder.file("empty.exr") + ": it is empty");
    CHECK(reading(folder.path.string()) == "cannot read " + folder.path.string() + ": Is a directory");
    CHECK(writing(folder.path.string() + "/") == "cannot write " + folder.path.string() + "/: Is a directory");
    // Every write fails there.
    for (const char* name : {"full.exr", "full.png"}) {
        std::filesystem::create_symlink("/dev/full", folder.file(name));
        CHECK(writing(folder.file(name)).starts_with("cannot write " + folder.file(name) + ": "));
    }
}

TEST_CASE("a file is what it contains, whatever its name") {
    const Folder folder;
    const Image image{2, 1, {{0, 1, 0}, {1, 0, 1}}};
    for (const char* ending : {".exr", ".EXR", ".Exr", ".png", ".PNG"}) {
        const std::string file = folder.file("a") + ending;
        CHECK(is_writable_format(file));
        write_image(file, image);
        CHECK(read_image(file).pixels == image.pixels);
        std::filesystem::rename(file, folder.file("b.hdr"));
        CHECK(read_image(folder.file("b.hdr")).pixels == image.pixels);
    }
    for (const char* file : {"a.jpg", "a", "exr", ".exrx", ""}) CHECK(!is_writable_format(file));
}
