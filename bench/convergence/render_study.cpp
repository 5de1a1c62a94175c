#include "render_study.hpp"

#include "error_image.hpp"
#include "image.hpp"
#include "left_out.hpp"
#include "reference_image.hpp"
#include "renderer.hpp"
#include <lumis/statistics/error_metrics.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace convergence {

namespace {

using tracer::Film;
using tracer::Image;

// One integrator's run to growing sample counts.
class Run {
  public:
    Run(const tracer::Renderer& renderer, std::string_view integrator, std::uint64_t seed, int width, int height)
        : renderer_{renderer}, integrator_{integrator}, seed_{seed}, film_{width, height} {}

    void advance_to(std::int64_t samples) {
        const auto start = std::chrono::steady_clock::now();
        cpu_seconds_ +=
            renderer_.add_pass(film_, integrator_, static_cast<int>(samples) - film_.samples(), seed_, pass_++);
        wall_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    [[nodiscard]] double cpu_seconds() const { return cpu_seconds_; }
    [[nodiscard]] double wall_seconds() const { return wall_seconds_; }
    [[nodiscard]] const Film& film() const { return film_; }
    [[nodiscard]] Image image() const { return film_.image(); }

  private:
    const tracer::Renderer& renderer_;
    std::string_view integrator_;
    std::uint64_t seed_;
    Film film_;
    std::uint64_t pass_ = 0;
    double cpu_seconds_ = 0, wall_seconds_ = 0;
};

// Lone pixels shown in white where the reference and all their neighbours are shown in less than half of it.
int count_fireflies(const Image& image, const Image& reference) {
    const auto shown = [](const Image& from, int x, int y) {
        if (x < 0 || y < 0 || x >= from.width || y >= from.height) return 0.0f;
        return std::min(tracer::luminance(from.pixels[static_cast<std::size_t>(y * from.width + x)]), 1.0f);
    };
    int count = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            float expected = shown(reference, x, y);
            for (const auto& [right, down] :
                 {std::pair{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}) {
                expected = std::max(expected, shown(image, x + right, y + down));
            }
            count += shown(image, x, y) == 1 && expected < 0.5f;
        }
    }
    return count;
}

// For further computation, and for the eye, to which a pixel that is not finite is magenta.
std::string write(const std::filesystem::path& folder, const std::string& stem, Image image) {
    tracer::write_image((folder / (stem + ".exr")).string(), image);
    for (glm::vec3& pixel : image.pixels) {
        if (!is_finite(pixel)) pixel = {1, 0, 1};
    }
    tracer::write_image((folder / (stem + ".png")).string(), image);
    return stem + ".png";
}

std::string write_error(const std::filesystem::path& folder, const std::string& stem, const Image& image,
                        const ReferenceImage& reference) {
    const std::string file = stem + "_error.png";
    tracer::write_grey((folder / file).string(), image.width, image.height, error_levels(image, reference));
    return file;
}

Measurement measure(const Run& run, const Image& image, const ReferenceImage& reference) {
    const auto estimate = values(image), truth = values(reference.image);
    return {run.cpu_seconds(), run.wall_seconds(), lumis::mean_squared_error(estimate, truth) - reference.squared_error,
            lumis::relative_mean_squared_error(estimate, truth, reference.floor) - reference.relative_squared_error};
}

// Counts and probabilities depend on how many lights have risen.
Recipe recipe(const std::string& integrator) {
    if (integrator == "bsdf" || integrator == "light") return {"alone"};
    if (integrator == "one-sample") return {"one-sample", "balance"};
    return {"multi-sample", integrator};
}

}  // namespace

Study render_study(const std::string& scene_name, const std::vector<std::uint64_t>& seeds,
                   const RenderSettings& settings, const Progress& progress) {
    const tracer::SceneEntry& scene = *tracer::find_scene(scene_name);
    Study study;
    study.name = scene.name;
    study.group = "scenes";
    study.title = scene.title;
    study.description = scene.description;
    study.seeds = seeds;
    study.height = scene.height * settings.width / tracer::widest_scene();
    study.width = scene.width * settings.width / tracer::widest_scene();
    const tracer::SceneOptions options{study.width, study.height, settings.environment};
    const auto renderer = scene.make(options);
    study.strategies = renderer->strategies("power");

    const ReferenceImage reference = reference_image(*renderer, study.width, study.height, settings.reference_samples,
                                                     settings.references, study.name, progress);
    study.reference = {"mean of power and balance, " + std::to_string(settings.reference_samples) + " samples each",
                       {},
                       reference.squared_error,
                       reference.relative_squared_error,
                       write(settings.output, study.name + "_reference", reference.image),
                       reference.agreement};

    // A first run finds how many samples fit in the time, and warms the machine up.
    for (const auto integrator : tracer::integrator_names) {
        Run trial{*renderer, integrator, 0, study.width, study.height};
        for (std::int64_t samples = 1; samples <= 2; ++samples) trial.advance_to(samples);
        const auto affordable = static_cast<std::int64_t>(2 * settings.seconds / trial.cpu_seconds());
        Series& series = study.series.emplace_back();
        series.name = integrator;
        series.recipe = recipe(series.name);
        series.samples = doubling_up_to(std::max(affordable, std::int64_t{2}));
        series.runs_per_seed.assign(series.samples.size(), 1);
    }
    // All integrators take turns, so that a drift of the machine's speed hits all alike.
    std::vector<Film> sums(study.series.size(), Film{study.width, study.height});
    std::vector<std::int64_t> not_finite(study.series.size());
    for (const std::uint64_t seed : seeds) {
        for (std::size_t i = 0; i < study.series.size(); ++i) {
            Series& series = study.series[i];
            progress(study.name + ", " + series.name);
            Run run{*renderer, series.name, seed, study.width, study.height};
            std::vector<Measurement> measurements;
            for (const std::int64_t samples : series.samples) {
                run.advance_to(samples);
                measurements.push_back(measure(run, run.image(), reference));
            }
            series.runs.push_back(std::move(measurements));
            sums[i].merge(run.film());
            const Image image = run.image();
            not_finite[i] += count_not_finite(image);
            if (series.picture) continue;
            const std::string stem = study.name + "_" + series.name;
            series.picture = Picture{
                write(settings.output, stem, image), write_error(settings.output, stem, image, reference),
                static_cast<int>(series.samples.back()), run.cpu_seconds(), count_fireflies(image, reference.image)};
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        Pooled& pooled = study.series[i].pooled;
        pooled = pool(sums[i].image(), reference);
        pooled.not_finite = not_finite[i];
        pooled.evaluated = std::int64_t{study.width} * study.height * static_cast<std::int64_t>(seeds.size());
    }
    study.left_out = left_out(study.name, *renderer, options, reference, seeds, settings.seconds / 4, progress);
    return study;
}

}  // namespace convergence
