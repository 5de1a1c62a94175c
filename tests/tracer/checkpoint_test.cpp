// A checkpoint gives back what was saved, or says why not: cut short anywhere, or with any bit flipped.
#include "film/checkpoint.hpp"

#include "catch.hpp"
#include "folder.hpp"
#include "image_files.hpp"

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

using namespace tracer;
using image_files::message_of;

const Origin origin{{"scene", "veach"}, {"env", "the scene's own"}, {"mesh", ""}, {"seed", "1"}};

Checkpoint rendering() {
    Checkpoint result{Film{2, 1}, 16, 12.5};
    for (std::size_t i = 0; i < result.film.pixels.size(); ++i) {
        const auto value = static_cast<double>(i);
        result.film.pixels[i].add_pass({value, 1 / (value + 1), 1e300}, 16);
        result.film.pixels[i].add_pass({-value, 0, 3}, 16);
        result.film.pixels[i].albedo = glm::vec3{static_cast<float>(value), 0.1f, 0.2f};
        result.film.pixels[i].normal = glm::vec3{0.3f, static_cast<float>(value), 0.4f};
    }
    return result;
}

std::string bytes_of(const std::string& path) {
    std::ifstream stream{path, std::ios::binary};
    return {std::istreambuf_iterator<char>{stream}, {}};
}

struct Saved {
    Folder folder;
    std::string path = folder.file("a.ckpt"), bytes;

    Saved() {
        save_checkpoint(path, origin, rendering());
        bytes = bytes_of(path);
    }

    // Why a file of these bytes is refused; empty if it is not.
    [[nodiscard]] std::string reason(const std::string& changed) const {
        std::ofstream{path, std::ios::binary} << changed;
        return reason();
    }
    [[nodiscard]] std::string reason(const Origin& expected = origin, int width = 2, int height = 1) const {
        const std::string message = message_of([&] { (void)load_checkpoint(path, expected, width, height); });
        const std::string start = "cannot resume from " + path + ": ";
        return message.starts_with(start) ? message.substr(start.size()) : message;
    }
};

}  // namespace

TEST_CASE("a checkpoint gives back what was saved") {
    const Saved saved;
    const Checkpoint expected = rendering(), found = load_checkpoint(saved.path, origin, 2, 1);
    CHECK(found.film.width == 2);
    CHECK(found.film.height == 1);
    CHECK(found.pass_samples == 16);
    CHECK(found.cpu_seconds == 12.5);
    REQUIRE(found.film.pixels.size() == 2);
    CHECK(std::memcmp(found.film.pixels.data(), expected.film.pixels.data(), 2 * sizeof(Pixel)) == 0);
    // A rendering that has not begun, too.
    save_checkpoint(saved.path, origin, {Film{2, 2}, 8, 0});
    CHECK(load_checkpoint(saved.path, origin, 2, 2).film.passes() == 0);
}

TEST_CASE("a checkpoint is replaced whole or not at all") {
    const Saved saved;
    Checkpoint later = rendering();
    for (Pixel& pixel : later.film.pixels) pixel.add_pass({1, 1, 1}, 16);
    save_checkpoint(saved.path, origin, later);
    CHECK(load_checkpoint(saved.path, origin, 2, 1).film.passes() == 3);
    CHECK(!std::filesystem::exists(saved.path + ".new"));

    // A file system that is full refuses the new one; the old one stays.
    std::filesystem::create_symlink("/dev/full", saved.path + ".new");
    CHECK(message_of([&] { save_checkpoint(saved.path, origin, rendering()); }) ==
          "cannot write " + saved.path + ": No space left on device");
    CHECK(load_checkpoint(saved.path, origin, 2, 1).film.passes() == 3);
    const std::string nowhere = saved.folder.file("none/a.ckpt");
    CHECK(message_of([&] { save_checkpoint(nowhere, origin, later); }) ==
          "cannot write " + nowhere + ".new: No such file or directory");
}

TEST_CASE("a checkpoint that is cut short or damaged is refused") {
    const Saved saved;
    CHECK(saved.reason(saved.bytes) == "");
    for (std::size_t size = 0; size < saved.bytes.size(); size += 3) {
        INFO(size << " of " << saved.bytes.size() << " bytes");
        const std::string reason = saved.reason(saved.bytes.substr(0, size));
        CHECK(reason == (size < 16 ? "it is no checkpoint" : "it ends too early"));
    }
    CHECK(saved.reason(saved.bytes + '\0') == "it is damaged: it is longer than it says");
    for (std::size_t i = 0; i < saved.bytes.size(); i += 3) {
        std::string changed = saved.bytes;
        changed[i] = static_cast<char>(changed[i] ^ (1 << i % 8));
        INFO("byte " << i);
        const std::string reason = saved.reason(changed);
        CHECK(
            (i < 48 ? reason != "" : reason == "it is damaged: its checksum is wrong"));  // from 48 on, sizes are known
    }
    std::string next = saved.bytes;
    next[16] = 2;
    CHECK(saved.reason(next) == "it is of version 2 of the format, and this program reads version 1");
    CHECK(saved.reason("not a checkpoint, but longer than the start of one is") == "it is no checkpoint");
    std::filesystem::remove(saved.path);
    CHECK(saved.reason() == "No such file or directory");
    std::filesystem::create_directory(saved.path);
    CHECK(saved.reason() == "Is a directory");
}

TEST_CASE("a checkpoint of another rendering is refused") {
    const Saved saved;
    for (std::size_t i = 0; i < origin.size(); ++i) {
        Origin other = origin;
        other[i].second = "another";
        CHECK(saved.reason(other) == "its " + origin[i].first + " is " + origin[i].second + ", not another");
    }
    Origin longer = origin;
    longer.emplace_back("lens", "thin");
    CHECK(saved.reason(longer) == "it was written by another version of this program");
    CHECK(saved.reason(origin, 1, 2) == "it is an image of 2 x 1, not an image of 1 x 2");
    // A shorter pass, which is added last of all, cannot be continued.
    Checkpoint broken = rendering();
    for (Pixel& pixel : broken.film.pixels) pixel.add_pass({1, 1, 1}, 5);
    save_checkpoint(saved.path, origin, broken);
    CHECK(saved.reason() == "it is damaged: its passes are not whole");
}

TEST_CASE("a file's checksum is that of its bytes") {
    const Folder folder;
    std::ofstream{folder.file("a")} << "123456789";
    CHECK(checksum_of_file(folder.file("a")) == "cbf43926, 9 bytes");  // the check value of CRC-32
    CHECK(message_of([&] { (void)checksum_of_file(folder.file("none")); }) ==
          "cannot read " + folder.file("none") + ": No such file or directory");
    CHECK(message_of([&] { (void)checksum_of_file(folder.path.string()); }) ==
          "cannot read " + folder.path.string() + ": Is a directory");
}
