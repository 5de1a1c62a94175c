// Measures the error of estimators against their run time, and draws the page about it.
#include "left_out.hpp"
#include "page.hpp"
#include "problem_study.hpp"
#include "render_study.hpp"
#include "report_scenes.hpp"
#include "results.hpp"
#include "stiff_study.hpp"

#include <CLI/CLI.hpp>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <tuple>

namespace {

using namespace convergence;

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

constexpr const char* stiff_name = "stiff";

std::vector<std::string> all_problems() {
    std::vector<std::string> names;
    for (const ReportScene& scene : report_scenes()) names.emplace_back(scene.entry.name);
    for (const Entry& entry : registered_problems()) names.push_back(entry.name);
    names.emplace_back(stiff_name);
    std::ranges::sort(names);
    const auto twice = std::ranges::adjacent_find(names);
    if (twice != names.end()) throw std::logic_error("two problems are called " + *twice);
    return names;
}

void list() {
    for (const auto& [scene, _] : report_scenes()) std::cout << scene.name << ": " << scene.title << '\n';
    for (const Entry& entry : registered_problems()) std::cout << entry.name << ": " << entry.make().title << '\n';
    std::cout << stiff_name << ": Near-mirror surfaces under lights of all sizes\n";
}

// Where reference images are kept, those under another environment map apart.
std::filesystem::path references(const Settings& settings) {
    const std::filesystem::path folder = settings.output.parent_path() / "references";
    if (settings.environment.empty()) return folder;
    const std::filesystem::path map = std::filesystem::canonical(settings.environment);
    const auto changed = std::filesystem::last_write_time(map).time_since_epoch().count();
    return folder / std::to_string(std::hash<std::string>{}(map.string() + std::to_string(changed)));
}

void run(const Settings& settings) {
    std::filesystem::create_directories(settings.output);
    const RenderSettings render{settings.width,       settings.seconds, settings.reference_samples,
                                settings.environment, settings.output,  references(settings)};
    const auto asked_for = [&](const std::string& name) {
        return settings.problems.empty() || std::ranges::count(settings.problems, name) > 0;
    };
    ProgressLine progress;
    std::vector<Study> studies;
    const auto finish = [&](Study study) {
        progress.clear();
        print_table(study);
        std::fflush(stdout);
        studies.push_back(std::move(study));
    };
    for (const auto& [scene, is_in_demo] : report_scenes()) {
        const std::string name{scene.name};
        const bool is_meant = is_in_demo || settings.all_scenes || !settings.problems.empty();
        if (asked_for(name) && is_meant) finish(render_study(name, settings.seeds, render, std::ref(progress)));
    }
    for (const Entry& entry : registered_problems()) {
        if (!asked_for(entry.name)) continue;
        finish(problem_study(entry.name, entry.make(), settings.seeds, settings.seconds_of_integrals(),
                             std::ref(progress)));
    }
    std::optional<StiffStudy> stiff;
    if (asked_for(stiff_name)) {
        stiff = stiff_study(2 * static_cast<int>(settings.seeds.size()), settings.seconds / 200, std::ref(progress));
        progress.clear();
        print_table(*stiff);
    }
    write_csv(settings.output / "results.csv", studies);
    write_json(settings.output / "results.json", studies, stiff, settings);
    if (!settings.page) return;
    if (settings.problems.empty()) measure_extremes(settings.output);
    draw_page(settings.output);
}

}  // namespace

int main(int argc, char** argv) {
    Settings settings;
    settings.threads = oneapi::tbb::info::default_concurrency();
    int seeds = 8;
    bool thorough = false, list_only = false;
    std::tuple<std::string, std::string, int> counted;

    CLI::App app{"Measures the error of estimators against their run time."};
    app.add_option("--output", settings.output, "Folder for the results and their page")->capture_default_str();
    app.add_option("--problem", settings.problems, "Only these, see --list")->check(CLI::IsMember(all_problems()));
    app.add_flag("--list", list_only, "Show the problems");
    app.add_flag("--all", thorough,
                 "Take a quarter of an hour for more scenes, seeds, time and pixels, unless these are given");
    const auto* seeds_option = app.add_option("--seeds", seeds, "Independent runs of each estimator")
                                   ->check(CLI::Range(2, 1000))
                                   ->capture_default_str();
    const auto* seconds_option = app.add_option("--seconds", settings.seconds, "CPU time of each run of a scene")
                                     ->check(CLI::PositiveNumber)
                                     ->capture_default_str();
    const auto* width_option = app.add_option("--width", settings.width, "Of the images, in pixels")
                                   ->check(CLI::Range(16, 4096))
                                   ->capture_default_str();
    const auto* reference_option =
        app.add_option("--reference-samples", settings.reference_samples, "A pixel, for each half of a reference")
            ->check(CLI::Range(8, 1 << 20))
            ->capture_default_str();
    app.add_option("--threads", settings.threads, "For rendering")->check(CLI::Range(1, 1024))->capture_default_str();
    app.add_option("--env", settings.environment, "Environment map of the scene sky, latitude-longitude");
    app.add_flag("!--no-page", settings.page, "Only results.json and results.csv");
    auto* counted_option = app.add_option("--instructions", counted,
                                          "Only render this scene, composed or with everything, with so many samples a "
                                          "pixel, for a program that counts instructions");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    settings.all_scenes = thorough;
    if (thorough) {
        if (seeds_option->count() == 0) seeds = 16;
        if (seconds_option->count() == 0) settings.seconds = 1;
        if (width_option->count() == 0) settings.width = 384;
        if (reference_option->count() == 0) settings.reference_samples = 1024;
    }
    settings.seeds.resize(static_cast<std::size_t>(seeds));
    std::iota(settings.seeds.begin(), settings.seeds.end(), std::uint64_t{1});
    if (counted_option->count() > 0) settings.threads = 1;
    const oneapi::tbb::global_control threads{oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(settings.threads)};
    try {
        if (list_only) {
            list();
        } else if (counted_option->count() > 0) {
            std::apply(render_for_instructions, counted);
        } else {
            run(settings);
        }
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "convergence: " << error.what() << '\n';
        return 1;
    }
}
