// Renders one scene with one integrator. What can be known to be wrong is found before rendering. Exit codes: 0, 1 for files
// and memory, 2 for a wrong command, 128 + the signal's number after an interruption.
#include "image.hpp"
#include "interruption.hpp"
#include "renderer.hpp"

#include <CLI/CLI.hpp>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <new>
#include <set>
#include <sstream>

namespace {

using namespace tracer;

struct Settings {
    std::string scene = "veach", integrator = "power";
    int spp = 64;
    double seconds = 0;  // 0: samples decide
    std::uint64_t seed = 1;
    int threads = oneapi::tbb::info::default_concurrency();
    int width = 0, height = 0;  // 0: the scene's own
    std::string environment;
    std::vector<std::string> outputs{"render.png"};
};

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const SceneEntry& scene : scenes()) names.emplace_back(scene.name);
    return names;
}

void list() {
    for (const SceneEntry& scene : scenes()) {
        std::cout << "scene " << scene.name << ": " << scene.title << ", " << scene.width << " x " << scene.height
                  << '\n';
    }
    for (const auto name : integrator_names) std::cout << "integrator " << name << '\n';
}

// Bytes that the machine has left; as many as there can be if it does not say.
double available_memory() {
    std::ifstream stream{"/proc/meminfo"};
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("MemAvailable:")) return 1024 * std::atof(line.c_str() + line.find(':') + 1);
    }
    return std::numeric_limits<double>::infinity();
}

// The system grants more memory than there is, and ends a program that uses it without a word.
void require_memory(int width, int height) {
    constexpr double bytes_of_pixel = 140;  // what it sees, its sum, and the images to be written
    const double needed = bytes_of_pixel * width * height, available = available_memory();
    if (needed <= available) return;
    std::ostringstream message;
    message << std::fixed << std::setprecision(1) << "an image of " << width << " x " << height << " needs "
            << needed / 1e9 << " GB of memory, and " << available / 1e9 << " GB are available";
    throw std::runtime_error(message.str());
}

// Shows on one line how far a rendering is.
class Progress {
  public:
    explicit Progress(const Settings& settings) : settings_{settings} {}

    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

    // At most ten times a second, and when it is done.
    void show(int samples, bool is_done) {
        const double now = seconds();
        if (!is_done && now < shown_ + 0.1) return;
        shown_ = now;
        std::fprintf(stderr, "\r%s, %s: ", settings_.scene.c_str(), settings_.integrator.c_str());
        if (settings_.seconds > 0) {
            std::fprintf(stderr, "%d samples a pixel, %.1f of %g s ", samples, now, settings_.seconds);
        } else {
            const double left = now * (settings_.spp - samples) / std::max(samples, 1);
            std::fprintf(stderr, "%d of %d samples a pixel, %.1f s, %.1f s left ", samples, settings_.spp, now, left);
        }
        if (is_done) std::fprintf(stderr, "\n");
    }

  private:
    const Settings& settings_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double shown_ = 0;
};

// Adds passes until the samples or the seconds are used up, or the user interrupts.
Film render(const Renderer& renderer, const Settings& settings, int width, int height) {
    Film film{width, height};
    Progress progress{settings};
    double cpu_seconds = 0;
    const bool timed = settings.seconds > 0;
    for (std::uint64_t pass = 0; Interruption::received() == 0; ++pass) {
        const int samples = timed ? pass_samples : std::min(pass_samples, settings.spp - film.samples());
        if (timed ? pass > 0 && progress.seconds() >= settings.seconds : samples == 0) break;
        cpu_seconds += renderer.add_pass(film, settings.integrator, samples, settings.seed, pass);
        progress.show(film.samples(), false);
    }
    progress.show(film.samples(), true);
    std::printf("%d samples a pixel in %.2f s, %.2f s of CPU\n", film.samples(), progress.seconds(), cpu_seconds);
    return film;
}

// All outputs that can be written; what went wrong with the others.
void write(const std::vector<std::string>& outputs, const Image& image) {
    std::string wrong;
    for (const std::string& output : outputs) {
        try {
            write_image(output, image);
            std::printf("wrote %s\n", output.c_str());
        } catch (const FileError& error) {
            wrong += (wrong.empty() ? "" : "; ") + std::string{error.what()};
        }
    }
    if (!wrong.empty()) throw FileError(wrong);
}

int run(const Settings& settings) {
    const oneapi::tbb::global_control threads{oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(settings.threads)};
    const SceneEntry& scene = *find_scene(settings.scene);
    const int width = settings.width > 0 ? settings.width : scene.width;
    const int height = settings.height > 0 ? settings.height : scene.height;
    for (const std::string& output : settings.outputs) require_writable(output);
    require_memory(width, height);
    bool any = false;
    try {
        const auto renderer = scene.make({width, height, settings.environment});
        Interruption::watch();
        const Film film = render(*renderer, settings, width, height);
        any = film.samples() > 0;
        if (any) write(settings.outputs, film.image());
    } catch (const std::bad_alloc&) {
        throw std::runtime_error("there is not enough memory for an image of " + std::to_string(width) + " x " +
                                 std::to_string(height));
    }
    if (Interruption::received() == 0) return 0;
    std::cerr << "tracer: interrupted" << (any ? "" : " before the first pass, nothing is written") << '\n';
    return 128 + Interruption::received();
}

std::string check_output(const std::string& path) {
    return is_writable_format(path) ? std::string{} : path + " ends neither in .png nor in .exr";
}

std::string check_seconds(const std::string& text) {
    const double seconds = std::atof(text.c_str());
    return seconds > 0 && std::isfinite(seconds) ? std::string{} : text + " is no positive number";
}

// Without this, -1 would count as 2^64 - 1.
std::string check_seed(const std::string& text) {
    return text.starts_with('-') ? text + " is negative" : std::string{};
}

// What no option by itself shows.
void check_together(const Settings& settings, bool has_environment) {
    if (has_environment && !find_scene(settings.scene)->has_sky) {
        throw CLI::ValidationError("--env", "the scene " + settings.scene + " has no sky");
    }
    if (has_environment && settings.environment.empty()) throw CLI::ValidationError("--env", "the file has no name");
    std::set<std::filesystem::path> files;
    for (const std::string& output : settings.outputs) {
        if (files.insert(weakly_canonical(absolute(std::filesystem::path{output}))).second) continue;
        throw CLI::ValidationError("--output", output + " is named twice");
    }
}

}  // namespace

int main(int argc, char** argv) {
    Settings settings;
    const std::vector<std::string> integrators(integrator_names.begin(), integrator_names.end());
    bool list_only = false;

    CLI::App app{"Renders direct light with Lumis."};
    app.add_option("--scene", settings.scene, "What to render")
        ->check(CLI::IsMember(scene_names()))
        ->capture_default_str();
    app.add_option("--integrator", settings.integrator, "How to estimate its light")
        ->check(CLI::IsMember(integrators))
        ->capture_default_str();
    const auto* spp =
        app.add_option("--spp", settings.spp, "Samples a pixel")->check(CLI::Range(1, 1 << 24))->capture_default_str();
    app.add_option("--seconds", settings.seconds, "Render for this long instead")
        ->check(CLI::Validator{check_seconds, ""})
        ->excludes(const_cast<CLI::Option*>(spp));
    app.add_option("--seed", settings.seed, "Of the random numbers")
        ->check(CLI::Validator{check_seed, ""})
        ->capture_default_str();
    app.add_option("--threads", settings.threads, "The image does not depend on them")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app.add_option("--width", settings.width, "In pixels; the scene's own by default")->check(CLI::Range(1, 16384));
    app.add_option("--height", settings.height, "In pixels; the scene's own by default")->check(CLI::Range(1, 16384));
    const auto* environment = app.add_option(
        "--env", settings.environment, "Environment map of the scene sky, latitude-longitude: .hdr, .exr or .png");
    app.add_option("--output", settings.outputs, "A .png for the eye, a .exr for the linear values, or both")
        ->check(check_output)
        ->capture_default_str();
    app.add_flag("--list", list_only, "Show the scenes and integrators");

    try {
        app.parse(argc, argv);
        check_together(settings, environment->count() > 0);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (list_only) {
        list();
        return 0;
    }
    try {
        return run(settings);
    } catch (const std::exception& error) {
        std::cerr << "tracer: " << error.what() << '\n';
        return 1;
    }
}
