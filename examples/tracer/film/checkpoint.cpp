// A checkpoint is, in the machine's byte order,
//     "lumis checkpoint" | version, origin's length | width, height, samples of a pass, 0 | CPU seconds | origin | pixels | CRC
//     16 bytes           | 2 x uint32               | 4 x int32                           | double      | text   | Pixel  | uint32
// where the CRC-32 is that of all before.
// The origin is one line for each of its names: "scene veach".
#include "film/checkpoint.hpp"

#include "images/image_formats.hpp"

#include <boost/crc.hpp>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <type_traits>

namespace tracer {

namespace {

struct Start {
    std::array<char, 16> magic;
    std::uint32_t version, origin_length;
    std::int32_t width, height, pass_samples, unused;
    double cpu_seconds;
};

constexpr std::array<char, 16> magic{'l', 'u', 'm', 'i', 's', ' ', 'c', 'h', 'e', 'c', 'k', 'p', 'o', 'i', 'n', 't'};
constexpr std::uint32_t current_version = 1;

// They are written as they are in memory, which has no gaps.
static_assert(std::is_trivially_copyable_v<Pixel> && sizeof(Pixel) == 6 * sizeof(double) + 2 * 4 + 6 * sizeof(float));
static_assert(std::is_trivially_copyable_v<Start> && sizeof(Start) == 48);

std::string text_of(const Origin& origin) {
    std::string text;
    for (const auto& [name, value] : origin) text += name + ' ' + value + '\n';
    return text;
}

Origin origin_of(const std::string& text) {
    Origin origin;
    std::istringstream lines{text};
    for (std::string line; std::getline(lines, line);) {
        const std::size_t space = std::min(line.find(' '), line.size());
        origin.emplace_back(line.substr(0, space), line.substr(std::min(space + 1, line.size())));
    }
    return origin;
}

[[noreturn]] void fail_to_write(const std::string& path) {
    throw FileError("cannot write " + path + ": " + std::strerror(errno));
}

// The new file until it is whole; in the same folder, since a file moves at once only within a file system.
std::string unfinished(const std::string& path) {
    return path + ".new";
}

// A file descriptor that is closed.
class Descriptor {
  public:
    Descriptor(const std::string& path, int flags) : number_{open(path.c_str(), flags | O_CLOEXEC, 0666)} {
        if (number_ < 0) fail_to_write(path);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (number_ >= 0) close(number_);
    }

    [[nodiscard]] bool write(Bytes bytes) const {
        while (!bytes.empty()) {
            const ssize_t written = ::write(number_, bytes.data(), bytes.size());
            if (written < 0 && errno != EINTR) return false;
            bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
        }
        return true;
    }
    // Puts everything written on the disk, where a loss of power does not reach it.
    [[nodiscard]] bool sync() const { return fsync(number_) == 0; }
    [[nodiscard]] bool finish() { return close(std::exchange(number_, -1)) == 0; }

  private:
    int number_;
};

// Puts the names in it on the disk, where the file system can do so.
void sync_folder_of(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path{path}.parent_path();
    const int number = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (number < 0) return;
    static_cast<void>(fsync(number));
    close(number);
}

// Throws unless the file is a whole and undamaged checkpoint.
std::pair<Checkpoint, Origin> read(const std::string& path) {
    require(!std::filesystem::is_directory(path), std::strerror(EISDIR));
    std::ifstream stream{path, std::ios::binary};
    require(static_cast<bool>(stream), std::strerror(errno));
    const std::uint64_t size = std::filesystem::file_size(path);
    boost::crc_32_type crc;
    const auto get = [&](void* to, std::uint64_t bytes) {
        require(static_cast<bool>(stream.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes))),
                "it ends too early");
        crc.process_bytes(to, bytes);
    };

    Start start{};
    get(&start, std::min<std::uint64_t>(size, sizeof(start)));
    require(start.magic == magic, "it is no checkpoint");
    require(size >= sizeof(start), "it ends too early");
    require(start.version == current_version, "it is of version " + std::to_string(start.version) +
                                                  " of the format, and this program reads version " +
                                                  std::to_string(current_version));
    require(start.width > 0 && start.height > 0, "it is damaged: it is " + name_of_size(start.width, start.height));
    // What the header claims is there before memory is asked for it.
    const std::uint64_t pixels = static_cast<std::uint64_t>(start.width) * static_cast<std::uint64_t>(start.height);
    require(pixels <= size / sizeof(Pixel), "it ends too early");
    const std::uint64_t whole = sizeof(start) + start.origin_length + pixels * sizeof(Pixel) + sizeof(std::uint32_t);
    require(size >= whole, "it ends too early");
    require(size == whole, "it is damaged: it is longer than it says");

    std::string origin(start.origin_length, '\0');
    get(origin.data(), origin.size());
    Film film{start.width, start.height};
    get(film.pixels.data(), pixels * sizeof(Pixel));
    const std::uint32_t expected = crc.checksum();
    std::uint32_t checksum{};
    get(&checksum, sizeof(checksum));
    require(checksum == expected, "it is damaged: its checksum is wrong");
    const std::int64_t samples = std::int64_t{start.pass_samples} * film.passes();
    require(start.pass_samples > 0 && samples == film.samples(), "it is damaged: its passes are not whole");
    return {{std::move(film), start.pass_samples, start.cpu_seconds}, origin_of(origin)};
}

// Throws with the first difference.
void require_same(const Origin& found, const Origin& expected) {
    for (std::size_t i = 0; i < std::max(found.size(), expected.size()); ++i) {
        require(i < found.size() && i < expected.size() && found[i].first == expected[i].first,
                "it was written by another version of this program");
        const auto& [name, value] = found[i];
        require(value == expected[i].second, "its " + name + " is " + value + ", not " + expected[i].second);
    }
}

}  // namespace

void save_checkpoint(const std::string& path, const Origin& origin, const Checkpoint& checkpoint) {
    const Film& film = checkpoint.film;
    const std::string text = text_of(origin);
    const Start start{magic,      current_version,       static_cast<std::uint32_t>(text.size()),
                      film.width, film.height,           checkpoint.pass_samples,
                      0,          checkpoint.cpu_seconds};
    const std::array pieces{std::as_bytes(std::span{&start, 1}), std::as_bytes(std::span{text}),
                            std::as_bytes(std::span{film.pixels})};
    boost::crc_32_type crc;
    for (const Bytes piece : pieces) crc.process_bytes(piece.data(), piece.size());
    const std::uint32_t checksum = crc.checksum();

    const std::string beside = unfinished(path);
    Descriptor file{beside, O_WRONLY | O_CREAT | O_TRUNC};
    const bool is_written = std::ranges::all_of(pieces, [&](Bytes piece) { return file.write(piece); }) &&
                            file.write(std::as_bytes(std::span{&checksum, 1})) && file.sync() && file.finish();
    if (!is_written || std::rename(beside.c_str(), path.c_str()) != 0) {
        const int reason = errno;
        unlink(beside.c_str());
        errno = reason;
        fail_to_write(path);
    }
    sync_folder_of(path);
}

Checkpoint load_checkpoint(const std::string& path, const Origin& origin, int width, int height) {
    try {
        auto [checkpoint, found] = read(path);
        require_same(found, origin);
        const Film& film = checkpoint.film;
        require(film.width == width && film.height == height,
                "it is " + name_of_size(film.width, film.height) + ", not " + name_of_size(width, height));
        return std::move(checkpoint);
    } catch (const std::bad_alloc&) {
        throw FileError("cannot resume from " + path + ": there is not enough memory for it");
    } catch (const std::exception& error) {
        throw FileError("cannot resume from " + path + ": " + error.what());
    }
}

void require_checkpoint_writable(const std::string& path) {
    require_writable(path);
    require_writable(unfinished(path));
}

std::string checksum_of_file(const std::string& path) {
    std::ifstream stream{path, std::ios::binary};
    boost::crc_32_type crc;
    std::uint64_t size = 0;
    std::array<char, 65536> bytes;
    do {
        stream.read(bytes.data(), bytes.size());
        const auto got = static_cast<std::size_t>(stream.gcount());
        crc.process_bytes(bytes.data(), got);
        size += got;
    } while (stream);
    if (!stream.eof()) throw FileError("cannot read " + path + ": " + std::strerror(errno));
    std::ostringstream text;
    text << std::hex << crc.checksum() << ", " << std::dec << size << " bytes";
    return text.str();
}

}  // namespace tracer
