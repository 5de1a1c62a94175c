// Measures the error of estimators against their run time, and writes what the report is drawn from.
#include "integral_study.hpp"
#include "render_study.hpp"
#include "renderer.hpp"
#include "results.hpp"
#include "stiff_study.hpp"

#include <CLI/CLI.hpp>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <numeric>

namespace {

using namespace convergence;

struct Settings {
    std::filesystem::path output = "report";
    int seeds = 8;
    double seconds = 0.4;
    int width = 240;
    int reference_samples = 128;
    int threads = oneapi::tbb::info::default_concurrency();
    std::string environment;
};

// One line on the terminal that is written over again and again.
class ProgressLine {
  public:
    void operator()(const std::string& what) {
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        std::fprintf(stderr, "\r%5.1f s  %-50s", seconds, what.c_str());
        std::fflush(stderr);
    }
    void clear() { std::fprintf(stderr, "\r%-60s\r", ""); }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::vector<std::uint64_t> first_seeds(int count) {
    std::vector<std::uint64_t> seeds(static_cast<std::size_t>(count));
    std::iota(seeds.begin(), seeds.end(), std::uint64_t{1});
    return seeds;
}

void run(const Settings& settings) {
    const oneapi::tbb::global_control threads{oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(settings.threads)};
    std::filesystem::create_directories(settings.output);
    const RenderSettings render{settings.width,       settings.seconds, settings.reference_samples,
                                settings.environment, settings.output,  settings.output.parent_path() / "references"};
    ProgressLine progress;
    std::vector<Study> studies;
    const auto finish = [&](Study study) {
        progress.clear();
        print_table(study);
        std::fflush(stdout);
        studies.push_back(std::move(study));
    };
    for (const tracer::SceneEntry& scene : tracer::scenes()) {
        finish(render_study(std::string{scene.name}, first_seeds(settings.seeds), render, std::ref(progress)));
    }
    // An integral's error is one number a run, where an image's is a mean over pixels: it takes more, shorter runs.
    for (Study& study : integral_studies(first_seeds(8 * settings.seeds), settings.seconds / 50, std::ref(progress))) {
        finish(std::move(study));
    }
    const StiffStudy stiff = stiff_study(2 * settings.seeds, settings.seconds / 200, std::ref(progress));
    progress.clear();
    print_table(stiff);
    write_csv(settings.output / "results.csv", studies);
    write_json(settings.output / "results.json", studies, stiff, settings.threads);
}

}  // namespace

int main(int argc, char** argv) {
    Settings settings;
    CLI::App app{"Measures the error of estimators against their run time."};
    app.add_option("--output", settings.output, "Folder for the results")->capture_default_str();
    app.add_option("--seeds", settings.seeds, "Independent runs of each estimator")
        ->check(CLI::Range(2, 1000))
        ->capture_default_str();
    app.add_option("--seconds", settings.seconds, "CPU time of each run of a scene")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--width", settings.width, "Of the images, in pixels")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    app.add_option("--reference-samples", settings.reference_samples, "A pixel, for each half of a reference")
        ->check(CLI::Range(8, 1 << 20))
        ->capture_default_str();
    app.add_option("--threads", settings.threads, "For rendering")->check(CLI::Range(1, 1024))->capture_default_str();
    app.add_option("--env", settings.environment, "Environment map of the scene sky, latitude-longitude");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try {
        run(settings);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "convergence: " << error.what() << '\n';
        return 1;
    }
}
