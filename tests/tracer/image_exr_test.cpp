// OpenEXR files of every kind that are read, and what they are read as.
#include "catch.hpp"
#include "exr_files.hpp"
#include "image_files.hpp"

#include <ImfChromaticitiesAttribute.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <string>

namespace {

using namespace image_files;
using namespace exr_files;
using tracer::Image;

// A picture that all pixel types hold and every lossy compression keeps well: red rises to the right, green downwards.
float slope(const std::string& channel, int x, int y) {
    if (channel.ends_with("R")) return 100 + static_cast<float>(x);
    if (channel.ends_with("G")) return 200 + static_cast<float>(2 * y);
    return 300;
}

Image sloped(int width, int height) {
    Image image{width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) image.pixels.emplace_back(slope("R", x, y), slope("G", x, y), 300);
    }
    return image;
}

}  // namespace

TEST_CASE("OpenEXR in every compression, order and pixel type") {
    constexpr int width = 21, height = 37;  // no multiple of a tile or of a compressed piece
    const Image expected = sloped(width, height);
    for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
        for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT, Imf::UINT}) {
            Imf::Header all = header(width, height, {"R", "G", "B"}, type);
            all.compression() = static_cast<Imf::Compression>(compression);
            const bool is_lossy = compression == Imf::B44_COMPRESSION || compression == Imf::B44A_COMPRESSION ||
                                  compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION;
            const float tolerance = is_lossy ? 3.0f : 0.0f;  // 1 % of the brightest
            for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y, Imf::RANDOM_Y}) {
                all.lineOrder() = order;
                INFO("compression " << compression << ", type " << type << ", order " << order);
                if (order != Imf::RANDOM_Y) {
                    CHECK(largest_difference(read(scan_lines(all, slope)), expected) <= tolerance);
                }
                for (const Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS}) {
                    CHECK(largest_difference(read(tiles(all, slope, mode)), expected) <= tolerance);
                }
            }
        }
    }
}

TEST_CASE("the picture of an OpenEXR file is its display window") {
    const auto read_window = [](const Imath::Box2i& display, const Imath::Box2i& data) {
        Imf::Header all{display, data};
        for (const char* name : {"R", "G", "B"}) all.channels().insert(name, Imf::Channel{Imf::FLOAT});
        return scan_lines(all, slope);
    };
    const Imath::Box2i display{{0, 0}, {7, 3}};
    const Image whole = sloped(8, 4);
    // What lies beyond the picture is cropped, on all sides.
    CHECK(largest_difference(read(read_window(display, {{-3, -2}, {9, 8}})), whole) == 0);

    // Where there is no data the picture is black.
    const Image part = read(read_window(display, {{2, 1}, {20, 2}}));
    REQUIRE(part.width == 8);
    REQUIRE(part.height == 4);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) {
            const auto i = static_cast<std::size_t>(8 * y + x);
            CHECK(part.pixels[i] == (x >= 2 && y >= 1 && y <= 2 ? whole.pixels[i] : glm::vec3{0}));
        }
    }
    // A display window that does not begin at 0.
    const Image moved = read(read_window({{10, 20}, {17, 23}}, {{10, 20}, {17, 23}}));
    CHECK(moved.pixels.front() == glm::vec3{110, 240, 300});
    CHECK(moved.pixels.back() == glm::vec3{117, 246, 300});

    CHECK(reason(read_window(display, {{8, 0}, {9, 3}})) == "its data window lies outside of its display window");
    CHECK(reason(read_window(display, {{0, -2}, {7, -1}})) == "its data window lies outside of its display window");
}

TEST_CASE("grey, and luminance with chroma") {
    const Image grey = read(scan_lines(header(4, 3, {"Y", "A"}), [](const std::string& channel, int x, int y) {
        return channel == "Y" ? static_cast<float>(x + 10 * y) : 1.0f;
    }));
    for (int i = 0; i < 12; ++i) {
        CHECK(grey.pixels[static_cast<std::size_t>(i)] == glm::vec3{static_cast<float>(i % 4 + 10 * (i / 4))});
    }

    // Chroma is stored for every second pixel of every second line: a colour that does not change survives.
    Imf::StdOSStream stream;
    {
        const std::vector<Imf::Rgba> pixels(64, Imf::Rgba{1, 0.5f, 0.25f, 1});
        Imf::RgbaOutputFile file{stream, Imf::Header{8, 8}, Imf::WRITE_YC, 0};
        file.setFrameBuffer(pixels.data(), 1, 8);
        file.writePixels(8);
    }
    const Image color = read(stream.str());
    REQUIRE(color.pixels.size() == 64);
    for (const auto& pixel : color.pixels) CHECK(glm::length(pixel - glm::vec3{1, 0.5f, 0.25f}) <= 0.01f);
}

TEST_CASE("layers and parts") {
    const Image expected = sloped(5, 2);
    // The default layer is taken whatever else there is.
    const Image plain = read(scan_lines(
        header(5, 2, {"R", "G", "B", "A", "Z", "albedo.R", "albedo.G", "albedo.B"}),
        [](const std::string& channel, int x, int y) { return channel.size() == 1 ? slope(channel, x, y) : 0; }));
    CHECK(largest_difference(plain, expected) == 0);
    CHECK(plain.remark == "");

    // The only layer with colour.
    const Image layer = read(
        scan_lines(header(5, 2, {"Z", "view.combined.R", "view.combined.G", "view.combined.B", "depth.Z"}), slope));
    CHECK(largest_difference(layer, expected) == 0);
    CHECK(layer.remark == "layer view.combined is taken");
    CHECK(reason(scan_lines(header(5, 2, {"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"}), slope)) ==
          "it has colour in several layers, none of which is the default: a, b");

    // The first part with colour.
    const Image part = read(parts({header(5, 2, {"Z"}), header(5, 2), header(5, 2, {"A"})}, slope));
    CHECK(largest_difference(part, expected) == 0);
    CHECK(part.remark == "part 2 of 3 (part 2) is taken");
}

TEST_CASE("other primaries than those of Rec. 709 are converted") {
    const auto red_of = [](const Imf::Chromaticities& chromaticities, Imf::PixelType type) {
        Imf::Header all = header(1, 1, {"R", "G", "B"}, type);
        Imf::addChromaticities(all, chromaticities);
        return read(scan_lines(all, [](const std::string& channel, int, int) { return channel == "R" ? 1.0f : 0.0f; }))
            .pixels[0];
    };
    CHECK(red_of({}, Imf::HALF) == glm::vec3{1, 0, 0});
    const glm::vec3 rec2020 =
        red_of({{0.708f, 0.292f}, {0.17f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.329f}}, Imf::FLOAT);
    CHECK(std::abs(rec2020.r - 1.6605f) <= 1e-3f);  // ITU-R BT.2087
    CHECK(std::abs(rec2020.g + 0.1246f) <= 1e-3f);
    CHECK(std::abs(rec2020.b + 0.0182f) <= 1e-3f);
}

TEST_CASE("an environment map may say so") {
    for (const Imf::Envmap kind : {Imf::ENVMAP_LATLONG, Imf::ENVMAP_CUBE}) {
        Imf::Header all = header(6, 36);
        Imf::addEnvmap(all, kind);
        CHECK(reason(scan_lines(all, slope)) ==
              (kind == Imf::ENVMAP_CUBE ? "it is a cube map; only latitude-longitude maps are read" : ""));
    }
}
