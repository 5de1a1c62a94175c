#include "page.hpp"

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace convergence {

namespace {

void run(const std::string& program, const std::string& arguments) {
    std::fflush(stdout);
    if (std::system((program + ' ' + arguments).c_str()) != 0) throw std::runtime_error(program + " failed");
}

// For a shell, which leaves what stands between such marks as it is.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string{"'\\''"} : std::string{c};
    return result + '\'';
}

}  // namespace

void measure_extremes(const std::filesystem::path& folder) {
    run(quoted(LUMIS_STABILITY), "--allow-failures --output " + quoted(folder.string()));
}

void draw_page(const std::filesystem::path& folder) {
    run(quoted(LUMIS_PYTHON), quoted(LUMIS_REPORT) + ' ' + quoted((folder / "results.json").string()));
}

}  // namespace convergence
