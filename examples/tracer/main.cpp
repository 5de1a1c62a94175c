// Renders one scene with one integrator. What can be known to be wrong is found before rendering. Exit codes: 0, 1 for files,
// memory and a camera that looks nowhere, 2 for a wrong command, 128 + the signal's number after an interruption.
// The root does all of this if there is MPI, and the other ranks render passes for it.
#include "command_line.hpp"
#include "images/image.hpp"
#include "interruption.hpp"
#include "passes.hpp"
#include "progress.hpp"
#include "ranks.hpp"
#include "renderer.hpp"
#include "scenes/scenes.hpp"

#include <oneapi/tbb/global_control.h>

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
#include <sstream>
#include <variant>

namespace {

using namespace tracer;

void list() {
    for (const SceneEntry& scene : scenes()) {
        std::cout << "scene " << scene.name << ": " << scene.title << ", " << scene.width << " x " << scene.height
                  << '\n';
    }
    for (const auto name : integrator_names()) std::cout << "integrator " << name << '\n';
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
void require_memory(int width, int height, std::size_t films) {
    constexpr std::size_t bytes_of_file = 4 * 13;  // three channels, and those of the layers
    const std::size_t bytes_of_pixel =
        films * sizeof(Pixel) + sizeof(glm::vec3) + 2 * bytes_of_file;  // the file in two copies
    const double needed = static_cast<double>(bytes_of_pixel) * width * height, available = available_memory();
    if (needed <= available) return;
    std::ostringstream message;
    message << std::fixed << std::setprecision(1) << "an image of " << width << " x " << height << " needs "
            << needed / 1e9 << " GB of memory, and " << available / 1e9 << " GB are available";
    throw std::runtime_error(message.str());
}

// Saves a rendering again and again. A disk that is full now must not end it.
class Saving {
  public:
    explicit Saving(const Settings& settings)
        : path_{settings.checkpoint},
          interval_{settings.checkpoint_seconds},
          origin_{path_.empty() ? Origin{} : origin_of(settings)} {}

    // The rendering to continue, or an empty one.
    [[nodiscard]] Checkpoint begin(const Settings& settings, int width, int height) const {
        if (!path_.empty()) {
            const bool exists = std::filesystem::exists(path_);
            if (exists && settings.resume) return load_checkpoint(path_, origin_, width, height);
            if (exists) throw FileError(path_ + " exists already: continue it with --resume, or remove it");
            if (settings.resume) std::cerr << "tracer: there is no " << path_ << " yet: rendering from the start\n";
            require_checkpoint_writable(path_);
        }
        return {Film{width, height}, samples_of_pass(settings.limits)};
    }

    void save(const Checkpoint& checkpoint) {
        if (path_.empty()) return;
        try {
            save_checkpoint(path_, origin_, checkpoint);
            failure_.clear();
        } catch (const FileError& error) {
            if (failure_.empty()) std::cerr << "\ntracer: " << error.what() << '\n';
            failure_ = error.what();
        }
        saved_ = std::chrono::steady_clock::now();
    }
    void save_if_due(const Checkpoint& checkpoint) {
        if (std::chrono::steady_clock::now() - saved_ >= interval_) save(checkpoint);
    }

    // Why the last attempt failed, or empty.
    [[nodiscard]] const std::string& failure() const { return failure_; }

  private:
    std::string path_;  // empty: nothing is saved
    std::chrono::duration<double> interval_;
    Origin origin_;
    std::string failure_;
    std::chrono::steady_clock::time_point saved_ = std::chrono::steady_clock::now();
};

// Adds passes until a limit is reached or the user interrupts.
void render(Passes& passes, const Settings& settings, Checkpoint& rendering, Saving& saving) {
    Film& film = rendering.film;
    const Limits& limits = settings.limits;
    if (film.samples() > limits.samples) {
        throw FileError(settings.checkpoint + " holds " + std::to_string(film.samples()) +
                        " samples of a pixel, more than --spp " + std::to_string(limits.samples));
    }
    const int samples_before = film.samples();
    Progress progress{settings.scene + ", " + settings.integrator, limits, samples_before};
    double error = is_error_due(film.passes()) ? film.relative_error() : std::numeric_limits<double>::infinity();
    bool is_whole = true;
    while (Interruption::received() == 0) {
        const int samples = passes.samples_of(film.passes());
        const bool is_late = film.samples() > samples_before && progress.seconds() >= limits.seconds;
        if (samples == 0 || error < limits.error || is_late) break;
        // A checkpoint holds whole passes, so that it can be continued to more samples than were asked for now.
        is_whole = samples == rendering.pass_samples;
        if (!is_whole) saving.save(rendering);
        rendering.cpu_seconds += passes.add_to(film);
        if (is_error_due(film.passes())) error = film.relative_error();
        if (is_whole) saving.save_if_due(rendering);
        progress.show(film.samples(), error, false);
    }
    if (film.samples() == 0) return;
    if (is_whole) saving.save(rendering);
    error = film.relative_error();
    progress.show(film.samples(), error, true);
    std::printf("%d samples a pixel in %.2f s, %.2f s of CPU", film.samples(), progress.seconds(),
                rendering.cpu_seconds);
    if (std::isfinite(error)) std::printf(", relative error %.3g %%", 100 * error);
    std::printf("\n");
}

// All outputs that can be written; what went wrong with the others is thrown.
void write(const Settings& settings, const Film& film, std::string wrong) {
    const auto attempt = [&](const std::string& output, const Image& image, const std::vector<Layer>& layers) {
        try {
            write_image(output, image, layers);
            std::printf("wrote %s\n", output.c_str());
        } catch (const FileError& error) {
            wrong += (wrong.empty() ? "" : "; ") + std::string{error.what()};
        }
    };
    if (std::ranges::all_of(film.pixels, [](const Pixel& pixel) { return pixel.sum == glm::dvec3{0}; })) {
        std::cerr << "tracer: the image is black, for no path has found light: --eye and --target move the camera\n";
    }
    for (const std::string& output : settings.outputs) attempt(output, film.image(), film.layers());
    if (!settings.error_output.empty()) attempt(settings.error_output, film.standard_error(), {});
    if (!wrong.empty()) throw FileError(wrong);
}

// What every rank has: its threads, and the scene at the size of the image.
struct Work {
    oneapi::tbb::global_control threads;
    const SceneEntry& scene;
    int width, height;

    explicit Work(const Settings& settings)
        : threads{oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(settings.threads)},
          scene{*find_scene(settings.scene)},
          width{settings.width > 0 ? settings.width : scene.width},
          height{settings.height > 0 ? settings.height : scene.height} {}

    [[nodiscard]] std::unique_ptr<Renderer> make_renderer(const Settings& settings) const {
        return scene.make({width, height, settings.environment, settings.mesh, settings.camera});
    }
};

int run(const Ranks& ranks, const Settings& settings) {
    const Work work{settings};
    const int width = work.width, height = work.height;
    for (const std::string& output : settings.outputs) require_writable(output);
    if (!settings.error_output.empty()) require_writable(settings.error_output);
    require_memory(width, height, ranks.count() > 1 ? 2 : 1);  // one more for the passes of other ranks
    bool any = false;
    try {
        Saving saving{settings};
        Checkpoint rendering = saving.begin(settings, width, height);
        const auto renderer = work.make_renderer(settings);
        for (const std::string& note : renderer->notes())
            std::cerr << "tracer: " << settings.mesh + ": " + note << '\n';
        Interruption::watch();
        Passes passes{ranks, *renderer, settings, rendering};
        render(passes, settings, rendering, saving);
        any = rendering.film.samples() > 0;
        if (any) write(settings, rendering.film, saving.failure());
    } catch (const std::bad_alloc&) {
        throw std::runtime_error("there is not enough memory for an image of " + std::to_string(width) + " x " +
                                 std::to_string(height));
    }
    if (Interruption::received() == 0) return 0;
    std::cerr << "tracer: interrupted" << (any ? "" : " before the first pass, nothing is written") << '\n';
    return 128 + Interruption::received();
}

// Renders what the root asks for, at every other rank. The command line is read after the root has found it right.
void serve(const Ranks& ranks, int argc, char** argv) {
    Interruption::watch();  // the root decides what it means
    SampleRange task = ranks.receive_task();
    if (task.count == 0) return;
    const Settings settings = std::get<Settings>(parse_command_line(argc, argv));
    const Work work{settings};
    const auto renderer = work.make_renderer(settings);
    for (; task.count > 0; task = ranks.receive_task()) {
        Film film{work.width, work.height};
        const double cpu_seconds =
            renderer->add_pass(film, settings.integrator, settings.options(), task, settings.seed);
        ranks.send_pass(film, cpu_seconds);
    }
}

int lead(const Ranks& ranks, int argc, char** argv) {
    const auto parsed = parse_command_line(argc, argv);
    if (const int* code = std::get_if<int>(&parsed)) return *code;
    const Settings& settings = std::get<Settings>(parsed);
    if (!settings.list_only) return run(ranks, settings);
    list();
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const Ranks ranks{argc, argv};
    try {
        if (ranks.rank() == 0) return lead(ranks, argc, argv);
        serve(ranks, argc, argv);
        return 0;
    } catch (const std::exception& error) {
        const std::string at = ranks.rank() == 0 ? "" : "rank " + std::to_string(ranks.rank()) + ": ";
        std::cerr << "tracer: " + at + error.what() + '\n';
    }
    if (ranks.rank() != 0) ranks.abort(1);  // the root waits for its pass
    return 1;
}
