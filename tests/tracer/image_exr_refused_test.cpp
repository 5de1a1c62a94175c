// OpenEXR files that are refused, and why.
#include "catch.hpp"
#include "exr_files.hpp"
#include "image_files.hpp"

#include <limits>
#include <string>
#include <string_view>

namespace {

using namespace image_files;
using namespace exr_files;
using namespace std::string_view_literals;

float one(const std::string& /*channel*/, int /*x*/, int /*y*/) {
    return 1;
}

std::string changed(std::string file, std::size_t position, std::string_view bytes) {
    return file.replace(position, bytes.size(), bytes);
}

// Where the value of an attribute begins.
std::size_t value_of(std::string_view file, std::string_view name_and_type) {
    return file.find(name_and_type) + name_and_type.size() + 4;  // the value's size comes first
}

}  // namespace

TEST_CASE("what has no colour is refused") {
    const auto why = [](const std::vector<std::string>& channels) {
        return reason(scan_lines(header(2, 2, channels), one));
    };
    CHECK(why({"A"}) == "it has no colour, neither R, G, B nor Y: its channels are A");
    CHECK(why({"Z"}) == "it has no colour, neither R, G, B nor Y: its channels are Z");
    CHECK(why({"R", "G"}) == "it has no colour, neither R, G, B nor Y: its channels are G, R");
    CHECK(why({"N.X", "N.Y", "N.Z"}) == "it has no colour, neither R, G, B nor Y: its channels are N.X, N.Y, N.Z");
    CHECK(reason(parts({header(2, 2, {"Z"}), header(2, 2, {"A"})}, one)) ==
          "it has no colour, neither R, G, B nor Y: its channels are Z, A");
    CHECK(reason(deep()) == "its data is deep: a pixel is a list of samples at several distances");
}

TEST_CASE("colour channels that are subsampled are refused") {
    Imf::Header all = header(4, 4, {"R", "B"});
    all.channels().insert("G", Imf::Channel{Imf::FLOAT, 2, 2});
    CHECK(reason(scan_lines(all, one)) == "channel G is subsampled");
}

TEST_CASE("a texel that is no light is named") {
    const auto why = [](float value) {
        return reason(scan_lines(header(3, 2), [=](const std::string& channel, int x, int y) {
            return channel == "G" && x == 2 && y == 1 ? value : 1;
        }));
    };
    CHECK(why(std::numeric_limits<float>::quiet_NaN()).starts_with("texel (2, 1) is not finite: (1, "));
    CHECK(why(std::numeric_limits<float>::infinity()) == "texel (2, 1) is not finite: (1, inf, 1)");
    CHECK(why(-2) == "texel (2, 1) is of negative luminance: (1, -2, 1)");
    CHECK(why(-0.25f) == "");  // a colour beyond the primaries
    CHECK(why(std::numeric_limits<float>::max()) == "");
}

TEST_CASE("an OpenEXR file that ends early or claims too much is refused") {
    for (const Imf::Compression compression : {Imf::NO_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
        Imf::Header all = header(2, 17);
        all.compression() = compression;
        const std::string whole = scan_lines(all, one);
        CHECK(reason(whole) == "");
        for (std::size_t size = 0; size < whole.size(); ++size) CHECK(reason(whole.substr(0, size)) != "");
    }
    const std::string whole = scan_lines(header(2, 1), one);
    const std::size_t window = value_of(whole, "dataWindow\0box2i\0"sv),
                      display = value_of(whole, "displayWindow\0box2i\0"sv);
    CHECK(reason(changed(whole, display + 8, "\xff\xff\x00\0\xff\xff\x00\0"sv)) ==
          "an image of 65536 x 65536 is too large");
    CHECK(reason(changed(whole, window + 8, "\xff\xff\x00\0"sv)) ==
          "an image of 65536 x 1 is more than it can hold: it ends too early");
    CHECK(reason(changed(whole, window + 8, "\xff\xff\x00\0\xff\xff\x00\0"sv)) == "it ends too early");
    CHECK(reason(changed(whole, window + 8, "\xff\xff\xff\x7f\xff\xff\xff\x7f"sv)) != "");
    // 2 GiB for an attribute.
    CHECK(reason(changed(whole, value_of(whole, "pixelAspectRatio\0float\0"sv) - 4, "\xff\xff\xff\x7f"sv)) != "");
    CHECK(reason(changed(whole, value_of(whole, "compression\0compression\0"sv), "\x63"sv)) != "");
}
