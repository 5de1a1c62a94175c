// Renders one scene with one integrator.
#include "image.hpp"
#include "renderer.hpp"

#include <CLI/CLI.hpp>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>

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

// Adds passes until the samples or the seconds are used up.
Film render(const Renderer& renderer, const Settings& settings, int width, int height) {
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    Film film{width, height};
    double cpu_seconds = 0;
    constexpr int pass_samples = 4;
    for (std::uint64_t pass = 0;; ++pass) {
        const bool timed = settings.seconds > 0;
        const int samples = timed ? pass_samples : std::min(pass_samples, settings.spp - film.samples);
        if (timed ? pass > 0 && elapsed() >= settings.seconds : samples == 0) break;
        cpu_seconds += renderer.add_pass(film, settings.integrator, samples, settings.seed, pass);
        std::fprintf(stderr, "\r%s, %s: %d samples a pixel, %.1f s ", settings.scene.c_str(),
                     settings.integrator.c_str(), film.samples, elapsed());
    }
    std::fprintf(stderr, "\n");
    std::printf("%d samples a pixel in %.2f s, %.2f s of CPU\n", film.samples, elapsed(), cpu_seconds);
    return film;
}

void run(const Settings& settings) {
    const oneapi::tbb::global_control threads{oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(settings.threads)};
    const SceneEntry& scene = *find_scene(settings.scene);
    const int width = settings.width > 0 ? settings.width : scene.width;
    const int height = settings.height > 0 ? settings.height : scene.height;
    const auto renderer = scene.make({width, height, settings.environment});
    const Film film = render(*renderer, settings, width, height);
    for (const std::string& output : settings.outputs) {
        write_image(output, film.image());
        std::printf("wrote %s\n", output.c_str());
    }
}

std::string check_output(const std::string& path) {
    return is_writable_format(path) ? std::string{} : path + " ends neither in .png nor in .exr";
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
        ->check(CLI::PositiveNumber)
        ->excludes(const_cast<CLI::Option*>(spp));
    app.add_option("--seed", settings.seed, "Of the random numbers")->capture_default_str();
    app.add_option("--threads", settings.threads, "The image does not depend on them")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app.add_option("--width", settings.width, "In pixels; the scene's own by default")->check(CLI::Range(1, 16384));
    app.add_option("--height", settings.height, "In pixels; the scene's own by default")->check(CLI::Range(1, 16384));
    app.add_option("--env", settings.environment, "Environment map of the scene sky, latitude-longitude, .hdr");
    app.add_option("--output", settings.outputs, "A .png for the eye, a .exr for the linear values, or both")
        ->check(check_output)
        ->capture_default_str();
    app.add_flag("--list", list_only, "Show the scenes and integrators");

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (list_only) {
        list();
        return 0;
    }
    try {
        run(settings);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "tracer: " << error.what() << '\n';
        return 1;
    }
}
