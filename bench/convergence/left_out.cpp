#include "left_out.hpp"

#include "paths/packet.hpp"
#include "render_study.hpp"
#include "report_scenes.hpp"
#include <lumis/statistics/error_metrics.hpp>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#define LUMIS_CALLGRIND
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string_view>

namespace convergence {

namespace {

using tracer::Film;

// What only `everything` consists of. A line of strategies() is "kind: strategy", the kind that of a material or "light".
void list_missing(LeftOut& result, const std::vector<std::string>& composed,
                  const std::vector<std::string>& everything) {
    const auto occurs = [&](const std::string& part) {
        return std::ranges::any_of(composed, [&](const std::string& line) { return line.find(part) != line.npos; });
    };
    for (const std::string& line : everything) {
        const std::size_t colon = line.find(": ");
        const std::string kind = line.substr(0, colon), strategy = line.substr(colon + 2);
        if (!occurs(strategy)) result.strategies.push_back(strategy);
        if (kind != "light" && !occurs(kind + ": ")) result.materials.push_back(kind);
    }
}

constexpr int counted_width = 48, counted_height = 32, counted_samples = 8;

// The instructions that callgrind counts in this program, between the marks of render_for_instructions.
std::optional<double> instructions_per_sample(const std::string& scene, const std::string& variant) {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::string command = "valgrind --tool=callgrind --instr-atstart=no --callgrind-out-file=/dev/null '" +
                                program + "' --instructions " + scene + " " + variant + " " +
                                std::to_string(counted_samples) + " 2>&1";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe{popen(command.c_str(), "r"), pclose};
    if (!pipe) return {};
    double collected = 0;
    for (std::array<char, 512> line{}; std::fgets(line.data(), line.size(), pipe.get()) != nullptr;) {
        constexpr std::string_view label = "Collected : ";
        const auto at = std::string_view{line.data()}.find(label);
        if (at != std::string_view::npos) collected = std::atof(line.data() + at + label.size());
    }
    if (!(collected > 0)) return {};
    return collected / (counted_width * counted_height * counted_samples);
}

// The error is brought to equal time, for which random numbers are needed: it falls with their number as theory says.
tracer::RenderOptions counted_options(const std::string& scene) {
    tracer::RenderOptions options = render_options(scene);
    options.sampler = tracer::Sampler::Random;
    return options;
}

std::unique_ptr<tracer::Renderer> make(const std::string& scene, const std::string& variant,
                                       const tracer::SceneOptions& options) {
    if (variant == "everything") return make_with_everything(scene, options);
    return report_scene(scene).make(options);
}

}  // namespace

std::optional<LeftOut> left_out(const std::string& scene, const tracer::Renderer& composed,
                                const tracer::SceneOptions& options, const ReferenceImage& reference,
                                const std::vector<std::uint64_t>& seeds, double seconds, const Progress& progress) {
    const auto everything = make_with_everything(scene, options);
    if (!everything) return {};
    const tracer::RenderOptions rendering = counted_options(scene);
    LeftOut result{};
    result.seconds = seconds;
    list_missing(result, composed.strategies(), everything->strategies());
    struct Runner {
        const tracer::Renderer& renderer;
        Variant& variant;
        int samples;
    };
    constexpr int width = static_cast<int>(tracer::lanes<tracer::Packet>);
    std::array runners{Runner{composed, result.composed, 0}, Runner{*everything, result.everything, 0}};
    for (Runner& runner : runners) {
        Film trial{options.width, options.height};
        const double taken = runner.renderer.add_pass(trial, "power", rendering, {0, width}, 0);
        runner.samples = width * std::max(1, static_cast<int>(seconds / taken));
    }
    for (const std::uint64_t seed : seeds) {
        for (const Runner& runner : runners) {
            progress(scene + (&runner == &runners[0] ? ", composed" : ", with everything in"));
            Film film{options.width, options.height};
            const double taken = runner.renderer.add_pass(film, "power", rendering, {0, runner.samples}, seed);
            const double pixels = static_cast<double>(film.pixels.size());
            runner.variant.seconds_per_sample.add(taken / (pixels * runner.samples));
            const tracer::Image image = film.image();
            const double error =
                lumis::relative_mean_squared_error(values(image), values(reference.image), reference.floor);
            // Samples are whole: brought to exactly `seconds`.
            runner.variant.relative_squared_error.add((error - reference.relative_squared_error) * taken / seconds);
        }
    }
    progress(scene + ", counting instructions");
    result.composed.instructions_per_sample = instructions_per_sample(scene, "composed");
    if (result.composed.instructions_per_sample) {
        result.everything.instructions_per_sample = instructions_per_sample(scene, "everything");
        result.instructions_by = "callgrind, one thread";
    } else {
        result.instructions_by = "missing: valgrind is not installed, or does not know instructions of this processor";
    }
    return result;
}

void render_for_instructions(const std::string& scene, const std::string& variant, int samples) {
    const auto renderer = make(scene, variant, {counted_width, counted_height, {}});
    const tracer::RenderOptions rendering = counted_options(scene);
    Film film{counted_width, counted_height};
    renderer->add_pass(film, "power", rendering, {0, samples}, 1);  // threads and tables are there from now on
#ifdef LUMIS_CALLGRIND
    CALLGRIND_START_INSTRUMENTATION;
    renderer->add_pass(film, "power", rendering, {static_cast<std::uint32_t>(samples), samples}, 1);
    CALLGRIND_STOP_INSTRUMENTATION;
#endif
}

}  // namespace convergence
