// A folder of a test's own.
#pragma once

#include <filesystem>
#include <random>
#include <string>

// Goes away with its object.
struct Folder {
    std::filesystem::path path;
    Folder() {
        do {
            path = std::filesystem::temp_directory_path() / ("lumis_test_" + std::to_string(std::random_device{}()));
        } while (!std::filesystem::create_directory(path));  // another test's
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { std::filesystem::remove_all(path); }
    [[nodiscard]] std::string file(const char* name) const { return (path / name).string(); }
};
