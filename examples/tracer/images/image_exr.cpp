// OpenEXR files, by the OpenEXR library: scan lines or tiles, any compression, half, float or integer channels R, G and B,
// or Y (grey), or Y with RY and BY; of several parts, the first that has colour. What is refused says why: deep data, cube
// maps, no colour. The picture is the display window: black where the file has no data, without the data around it. Which
// direction is the middle of a latitude-longitude map is not read from the file: see environment.hpp.
#include "images/image_formats.hpp"
#include "images/primaries.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfTileDescription.h>
#include <openexr.h>

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <set>

namespace tracer {

namespace {

// A file in memory.
class Stream final : public Imf::IStream {
  public:
    explicit Stream(Bytes file) : IStream{"file"}, file_{file} {}

    bool read(char* to, int size) override {
        const auto wanted = static_cast<std::size_t>(size);
        require(size >= 0 && at_ <= file_.size() && wanted <= file_.size() - at_, "it ends too early");
        std::memcpy(to, file_.data() + at_, wanted);
        at_ += wanted;
        return at_ < file_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override { at_ = position; }

  private:
    Bytes file_;
    std::uint64_t at_ = 0;
};

// The library's C++ classes allocate what an attribute claims to hold and only then look whether it is there. Its C
// interface looks first; it is asked to read the headers alone.
void require_sound_headers(Bytes bytes) {
    struct File {
        Bytes bytes;
        std::string reason;
    };
    File file{bytes, {}};
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.flags |= EXR_CONTEXT_FLAG_STRICT_HEADER;  // what it would repair, the C++ classes would not
    setup.user_data = &file;
    setup.size_fn = [](exr_const_context_t, void* self) {
        return static_cast<std::int64_t>(static_cast<const File*>(self)->bytes.size());
    };
    setup.read_fn = [](exr_const_context_t, void* self, void* to, std::uint64_t size, std::uint64_t position,
                       exr_stream_error_func_ptr_t) {
        const Bytes& all = static_cast<const File*>(self)->bytes;
        const Bytes rest = all.subspan(std::min<std::uint64_t>(position, all.size()));
        const std::size_t got = std::min<std::uint64_t>(size, rest.size());
        if (got > 0) std::memcpy(to, rest.data(), got);
        return static_cast<std::int64_t>(got);
    };
    setup.error_handler_fn = [](exr_const_context_t context, exr_result_t, const char* reason) {
        void* self = nullptr;
        if (exr_get_user_data(context, &self) == EXR_ERR_SUCCESS) static_cast<File*>(self)->reason = reason;
    };
    exr_context_t context = nullptr;
    const exr_result_t result = exr_start_read(&context, "file", &setup);
    exr_finish(&context);
    if (result == EXR_ERR_SUCCESS && file.reason.empty()) return;
    throw std::runtime_error(file.reason.empty() ? exr_get_default_error_message(result) : file.reason);
}

enum class Model { Rgb, Grey, LuminanceChroma };

struct Colors {
    int part;
    Model model;
    std::string layer;  // what comes before R, G and B, with its dot
};

bool has(const Imf::ChannelList& channels, const std::string& layer, std::initializer_list<const char*> names) {
    return std::ranges::all_of(names, [&](const char* name) { return channels.findChannel(layer + name) != nullptr; });
}

std::string with_comma(const std::string& list, const std::string& item) {
    return list.empty() ? item : list + ", " + item;
}

// The colours of a part: those of the default layer, or else of the only layer that has some.
std::optional<Colors> colors_of(int part, const Imf::ChannelList& channels) {
    if (has(channels, "", {"R", "G", "B"})) return Colors{part, Model::Rgb, ""};
    if (has(channels, "", {"Y", "RY", "BY"})) return Colors{part, Model::LuminanceChroma, ""};
    if (has(channels, "", {"Y"})) return Colors{part, Model::Grey, ""};
    std::set<std::string> layers;
    channels.layers(layers);
    std::erase_if(layers, [&](const std::string& layer) { return !has(channels, layer + ".", {"R", "G", "B"}); });
    if (layers.empty()) return {};
    std::string names;
    for (const std::string& layer : layers) names = with_comma(names, layer);
    require(layers.size() == 1, "it has colour in several layers, none of which is the default: " + names);
    return Colors{part, Model::Rgb, names + "."};
}

Colors find_colors(const Imf::MultiPartInputFile& file) {
    std::string names;
    bool is_deep = false;
    for (int part = 0; part < file.parts(); ++part) {
        const Imf::Header& header = file.header(part);
        if (header.hasType() && Imf::isDeepData(header.type())) {
            is_deep = true;
            continue;
        }
        if (auto found = colors_of(part, header.channels())) return *found;
        for (auto c = header.channels().begin(); c != header.channels().end(); ++c) names = with_comma(names, c.name());
    }
    require(!is_deep || !names.empty(), "its data is deep: a pixel is a list of samples at several distances");
    throw std::runtime_error("it has no colour, neither R, G, B nor Y: its channels are " + names);
}

struct Window {
    std::int64_t left, top, width, height;

    explicit Window(const Imath::Box2i& box)
        : left{box.min.x},
          top{box.min.y},
          width{std::int64_t{box.max.x} - left + 1},
          height{std::int64_t{box.max.y} - top + 1} {}
};

// Bytes that one of a file can stand for at most.
std::uint64_t most_bytes_of_one(Imf::Compression compression) {
    constexpr std::uint64_t deflate = 1032;
    switch (compression) {
        case Imf::NO_COMPRESSION:
            return 1;
        case Imf::DWAA_COMPRESSION:  // run lengths of blocks of 64, deflated
        case Imf::DWAB_COMPRESSION:
            return 64 * deflate;
        default:
            return deflate;
    }
}

// The library allocates what a header asks for and only then looks for the pixels.
void require_plausible(const Imf::Header& header, std::size_t file_size, std::uint64_t limit) {
    const Window data{header.dataWindow()}, display{header.displayWindow()};
    require_size(data.width, data.height, limit);
    require_size(display.width, display.height, limit);
    std::uint64_t bytes = 0, bytes_of_pixel = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        const Imf::Channel& channel = c.channel();
        const std::uint64_t size = channel.type == Imf::HALF ? 2 : 4;
        bytes_of_pixel += size;
        bytes +=
            size * static_cast<std::uint64_t>((data.width / channel.xSampling) * (data.height / channel.ySampling));
    }
    require(bytes / most_bytes_of_one(header.compression()) <= file_size,
            name_of_size(data.width, data.height) + " is more than it can hold: it ends too early");
    constexpr std::uint64_t most_lines = 256;  // which are compressed at once, by DWAB
    std::uint64_t pixels_at_once = static_cast<std::uint64_t>(data.width) * most_lines;
    if (header.hasTileDescription()) {
        const auto& tile = header.tileDescription();
        pixels_at_once = std::max(pixels_at_once, std::uint64_t{tile.xSize} * tile.ySize);
    }
    require(pixels_at_once * bytes_of_pixel <= std::uint64_t{1} << 30, "it is compressed in pieces of more than 1 GiB");
}

// Reads line by line, so that a buffer holds one line alone; what(y, line) gets each.
void for_each_line(Imf::MultiPartInputFile& file, const Colors& colors, const auto& what) {
    Imf::InputPart part{file, colors.part};
    const Window data{part.header().dataWindow()};
    std::vector<glm::vec3> line(static_cast<std::size_t>(data.width));
    Imf::FrameBuffer buffer;
    const bool is_grey = colors.model == Model::Grey;
    for (int c = 0; c < (is_grey ? 1 : 3); ++c) {
        const std::string name = is_grey ? "Y" : colors.layer + "RGB"[c];
        const Imf::Channel& channel = part.header().channels()[name];
        require(channel.xSampling == 1 && channel.ySampling == 1, "channel " + name + " is subsampled");
        char* first = reinterpret_cast<char*>(line.data()) + static_cast<std::ptrdiff_t>(sizeof(float)) * c;
        buffer.insert(is_grey ? "Y" : colors.layer + "RGB" [c], {
            Imf::FLOAT, first - data.left* static_cast<std::ptrdiff_t>(sizeof(glm::vec3)), sizeof(glm::vec3), 0
        });
    }
    part.setFrameBuffer(buffer);
    for (std::int64_t y = data.top; y < data.top + data.height; ++y) {
        part.readPixels(static_cast<int>(y));
        if (is_grey) std::ranges::for_each(line, [](glm::vec3& pixel) { pixel = glm::vec3{pixel.r}; });
        what(y, line);
    }
}

// The same for luminance and chroma, which the library makes colours of, in half precision.
void for_each_luminance_chroma_line(Bytes bytes, const auto& what) {
    Stream stream{bytes};
    Imf::RgbaInputFile file{stream, 0};
    const Window data{file.dataWindow()};
    std::vector<Imf::Rgba> line(static_cast<std::size_t>(data.width));
    std::vector<glm::vec3> converted(line.size());
    file.setFrameBuffer(line.data() - data.left, 1, 0);
    for (std::int64_t y = data.top; y < data.top + data.height; ++y) {
        file.readPixels(static_cast<int>(y));
        std::ranges::transform(line, converted.begin(), [](const Imf::Rgba& p) { return glm::vec3{p.r, p.g, p.b}; });
        what(y, converted);
    }
}

// What was taken, where there was a choice.
std::string remark(const Imf::MultiPartInputFile& file, const Colors& colors) {
    std::string result;
    if (file.parts() > 1) {
        result = "part " + std::to_string(colors.part + 1) + " of " + std::to_string(file.parts());
        if (file.header(colors.part).hasName()) result += " (" + file.header(colors.part).name() + ")";
    }
    if (!colors.layer.empty()) result = with_comma(result, "layer " + colors.layer.substr(0, colors.layer.size() - 1));
    return result.empty() ? result : result + " is taken";
}

}  // namespace

Image read_exr(Bytes bytes, std::uint64_t limit) {
    require_sound_headers(bytes);
    Stream stream{bytes};
    // One thread; and a table of chunks that is missing is not made up for by reading the whole file.
    Imf::MultiPartInputFile file{stream, 0, false};
    const Colors colors = find_colors(file);
    const Imf::Header& header = file.header(colors.part);
    require_plausible(header, bytes.size(), limit);
    require(!Imf::hasEnvmap(header) || Imf::envmap(header) != Imf::ENVMAP_CUBE,
            "it is a cube map; only latitude-longitude maps are read");

    const Window data{header.dataWindow()}, display{header.displayWindow()};
    // Columns of the picture that have data.
    const std::int64_t first = std::max(data.left - display.left, std::int64_t{0});
    const std::int64_t last = std::min(data.left + data.width - display.left, display.width);
    require(first < last && data.top < display.top + display.height && display.top < data.top + data.height,
            "its data window lies outside of its display window");
    Image image{static_cast<int>(display.width), static_cast<int>(display.height), {}, remark(file, colors)};
    image.pixels.resize(static_cast<std::size_t>(display.width * display.height));
    const auto place = [&](std::int64_t y, const std::vector<glm::vec3>& line) {
        const std::int64_t row = y - display.top;
        if (row < 0 || row >= display.height) return;
        std::copy_n(line.begin() + (display.left + first - data.left), last - first,
                    image.pixels.begin() + (row * display.width + first));
    };
    if (colors.model != Model::LuminanceChroma) {
        for_each_line(file, colors, place);
    } else {
        require(colors.part == 0, "luminance and chroma in a later part are not read");
        for_each_luminance_chroma_line(bytes, place);
    }
    if (Imf::hasChromaticities(header)) {
        const Imf::Chromaticities& c = Imf::chromaticities(header);
        convert_to_rec709(image,
                          {{c.red.x, c.red.y}, {c.green.x, c.green.y}, {c.blue.x, c.blue.y}, {c.white.x, c.white.y}});
    }
    return image;
}

std::string exr_file(const Image& image, std::span<const Layer> layers) {
    Imf::Header header{image.width, image.height};
    Imf::FrameBuffer buffer;
    const auto width = static_cast<std::size_t>(image.width);
    // The library only reads from it. A bytes_of_line of 0 makes all lines one, whose values change.
    const auto add_channel = [&](const std::string& name, const float& first, std::size_t bytes_of_line) {
        header.channels().insert(name, Imf::Channel{Imf::FLOAT});
        auto* values = reinterpret_cast<char*>(const_cast<float*>(&first));
        buffer.insert(name, {Imf::FLOAT, values, sizeof(glm::vec3), bytes_of_line});
    };
    for (int c = 0; c < 3; ++c) add_channel({"RGB"[c]}, image.pixels.front()[c], width * sizeof(glm::vec3));
    std::vector<std::vector<glm::vec3>> lines(layers.size(), std::vector<glm::vec3>(width));
    for (std::size_t i = 0; i < layers.size(); ++i) {
        for (std::size_t c = 0; c < layers[i].channels.size(); ++c) {
            add_channel(layers[i].channels[c], lines[i].front()[static_cast<int>(c)], 0);
        }
    }
    Imf::StdOSStream stream;
    {
        Imf::OutputFile file{stream, header, 0};
        file.setFrameBuffer(buffer);
        for (std::size_t begin = 0; begin < image.pixels.size(); begin += width) {
            for (std::size_t i = 0; i < layers.size(); ++i) {
                for (std::size_t x = 0; x < width; ++x) lines[i][x] = layers[i].values(begin + x);
            }
            file.writePixels(1);
        }
    }
    return stream.str();
}

}  // namespace tracer
