#include "exr_check.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

namespace tracer {

namespace {

void require(bool condition, const std::string& reason) {
    if (!condition) throw std::runtime_error(reason);
}

// Reads from the front; throws where the bytes end.
class Reader {
  public:
    explicit Reader(std::span<const std::byte> bytes) : rest_{bytes} {}

    [[nodiscard]] std::span<const std::byte> take(std::size_t size) {
        require(size <= rest_.size(), "it ends too early");
        const auto taken = rest_.first(size);
        rest_ = rest_.subspan(size);
        return taken;
    }

    // Little endian, as the machines that we run on.
    template <class T>
    [[nodiscard]] T number() {
        T value;
        std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
        return value;
    }

    // Up to a zero byte, of at most 31 characters.
    [[nodiscard]] std::string text() {
        std::string result;
        while (const char c = number<char>()) {
            result += c;
            require(result.size() <= 31, "a name in its header is too long");
        }
        return result;
    }

    [[nodiscard]] std::size_t left() const { return rest_.size(); }

  private:
    std::span<const std::byte> rest_;
};

struct Header {
    std::optional<int> chunks;  // if the header says how many
    unsigned compression{};
    std::int64_t min_y{}, width{}, height{};
    std::size_t pixel_size{};  // bytes of all channels

    [[nodiscard]] std::int64_t lines_per_chunk() const { return compression == 3 ? 16 : 1; }
};

std::size_t read_channels(Reader value) {
    std::set<std::string> names;
    std::size_t pixel_size = 0;
    for (std::string name = value.text(); !name.empty(); name = value.text()) {
        const int type = value.number<int>();
        (void)value.take(4);
        const int step_x = value.number<int>(), step_y = value.number<int>();
        require(type == 1 || type == 2, "channel " + name + " is neither half nor float");
        require(step_x == 1 && step_y == 1, "channel " + name + " is subsampled");
        require(names.insert(name).second, "channel " + name + " occurs twice");
        pixel_size += type == 1 ? 2 : 4;
    }
    require(value.left() == 0, "its list of channels is corrupt");
    const bool is_color = names.contains("R") && names.contains("G") && names.contains("B");
    require(is_color || names.size() == 1, "it has no channels R, G, B");
    return pixel_size;
}

void read_window(Reader value, Header& header, std::uint64_t max_pixels) {
    const auto [min_x, min_y, max_x, max_y] = value.number<std::array<int, 4>>();
    constexpr int limit = 1 << 20;
    for (const int edge : {min_x, min_y, max_x, max_y}) {
        require(-limit < edge && edge < limit, "its data window is out of range");
    }
    require(min_x <= max_x && min_y <= max_y, "its data window is empty");
    header.min_y = min_y;
    header.width = max_x - min_x + 1;
    header.height = max_y - min_y + 1;
    require(static_cast<std::uint64_t>(header.width * header.height) <= max_pixels,
            "an image of " + std::to_string(header.width) + " x " + std::to_string(header.height) + " is too large");
}

Header read_header(Reader& file, std::uint64_t max_pixels) {
    require(file.number<std::uint32_t>() == 20000630, "it is not an OpenEXR file");
    require(file.number<std::uint32_t>() == 2, "only single-part scanline OpenEXR files are supported");

    struct Attribute {
        std::string_view name;
        std::size_t size;  // 0: any
    };
    constexpr Attribute required[] = {{"channels", 0},           {"compression", 1},      {"dataWindow", 16},
                                      {"displayWindow", 16},     {"lineOrder", 1},        {"pixelAspectRatio", 4},
                                      {"screenWindowCenter", 8}, {"screenWindowWidth", 4}};

    Header header;
    std::set<std::string> seen;
    for (std::string name = file.text(); !name.empty(); name = file.text()) {
        require(!file.text().empty(), "attribute " + name + " has no type");
        const auto size = file.number<std::uint32_t>();
        const Reader value{file.take(size)};
        require(size > 0 && seen.insert(name).second, "attribute " + name + " is empty or occurs twice");
        require(seen.size() <= 64, "it has too many attributes");
        for (const auto& attribute : required) {
            require(name != attribute.name || attribute.size == 0 || size == attribute.size,
                    "attribute " + name + " has a wrong size");
        }
        if (name == "channels") header.pixel_size = read_channels(value);
        if (name == "compression") header.compression = Reader{value}.number<unsigned char>();
        if (name == "dataWindow") read_window(value, header, max_pixels);
        if (name == "chunkCount") header.chunks = Reader{value}.number<int>();
    }
    for (const auto& attribute : required) {
        require(seen.contains(std::string{attribute.name}), "it has no attribute " + std::string{attribute.name});
    }
    require(header.compression <= 3, "its compression is neither none, RLE nor ZIP");
    return header;
}

}  // namespace

void check_exr(std::span<const std::byte> bytes, std::uint64_t max_pixels) {
    Reader file{bytes};
    const Header header = read_header(file, max_pixels);
    const std::int64_t chunks = (header.height + header.lines_per_chunk() - 1) / header.lines_per_chunk();
    require(header.chunks.value_or(static_cast<int>(chunks)) == chunks, "it has a wrong number of chunks");
    std::uint64_t all_sizes = 0;  // chunks that overlap would make a large image of a small file
    for (std::int64_t chunk = 0; chunk < chunks; ++chunk) {
        const auto offset = file.number<std::uint64_t>();
        require(offset > 0 && offset <= bytes.size(), "a chunk begins outside of it");
        Reader data{bytes.subspan(offset)};
        const std::int64_t first = chunk * header.lines_per_chunk();
        require(data.number<int>() == header.min_y + first, "a chunk has a wrong line number");
        const auto size = data.number<std::uint32_t>();
        all_sizes += size;
        require(size > 0 && size <= data.left() && all_sizes <= bytes.size(), "a chunk ends outside of it");
        const std::int64_t lines = std::min(header.lines_per_chunk(), header.height - first);
        const std::uint64_t raw_size = static_cast<std::uint64_t>(header.width * lines) * header.pixel_size;
        // Deflate makes at most 1032 bytes of one.
        require(header.compression == 0 ? size == raw_size : raw_size <= std::uint64_t{1032} * size,
                "a chunk is too small for its pixels");
    }
}

}  // namespace tracer
