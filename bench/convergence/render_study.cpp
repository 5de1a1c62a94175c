#include "render_study.hpp"

#include "error_image.hpp"
#include "fireflies.hpp"
#include "images/image.hpp"
#include "left_out.hpp"
#include "paths/packet.hpp"
#include "reference_image.hpp"
#include "report_scenes.hpp"
#include <lumis/statistics/error_metrics.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string_view>
#include <tuple>
#include <utility>

namespace convergence {

namespace {

using tracer::Film;
using tracer::Image;

// An estimator of images, and how its error falls.
struct Estimator {
    std::string_view integrator;
    tracer::RenderOptions options;
    bool is_whole;  // its samples are the points of one set, or are learnt from together: another length starts anew
};

// One estimator's run to growing sample counts.
class Run {
  public:
    Run(const tracer::Renderer& renderer, const Estimator& estimator, std::uint64_t seed, int width, int height)
        : renderer_{renderer}, estimator_{estimator}, seed_{seed}, film_{width, height} {}

    void advance_to(std::int64_t samples) {
        if (estimator_.is_whole) {
            film_ = Film{film_.width, film_.height};
            cpu_seconds_ = wall_seconds_ = 0;
        }
        const auto start = std::chrono::steady_clock::now();
        const int before = film_.samples();
        const tracer::SampleRange pass{static_cast<std::uint32_t>(before), static_cast<int>(samples) - before};
        cpu_seconds_ += renderer_.add_pass(film_, estimator_.integrator, estimator_.options, pass, seed_);
        wall_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    [[nodiscard]] double cpu_seconds() const { return cpu_seconds_; }
    [[nodiscard]] double wall_seconds() const { return wall_seconds_; }
    [[nodiscard]] const Film& film() const { return film_; }
    [[nodiscard]] Image image() const { return film_.image(); }

  private:
    const tracer::Renderer& renderer_;
    const Estimator& estimator_;
    std::uint64_t seed_;
    Film film_;
    double cpu_seconds_ = 0, wall_seconds_ = 0;
};

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

// Counts and probabilities are those of the scene's types: as many samples as it has techniques, or one of two halves.
Recipe recipe(std::string_view integrator) {
    if (integrator == "bsdf" || integrator == "light") return {"alone"};
    if (integrator == "one-sample") return {"one-sample", "balance"};
    if (integrator == "optimal") return {"optimal"};
    return {"multi-sample", std::string{integrator}};
}

// All integrators with random numbers, which makes them comparable, and power once more with Sobol's points.
std::pair<std::vector<Series>, std::vector<Estimator>> contestants(tracer::RenderOptions options) {
    std::pair<std::vector<Series>, std::vector<Estimator>> result;
    const auto enter = [&](std::string_view name, std::string_view integrator, const Recipe& recipe, bool is_whole) {
        result.second.push_back({integrator, options, is_whole});
        Series& series = result.first.emplace_back();
        series.name = name;
        series.recipe = recipe;
        series.is_whole = is_whole;
    };
    options.sampler = tracer::Sampler::Random;
    for (const auto name : tracer::integrator_names()) enter(name, name, recipe(name), name == "optimal");
    options.sampler = tracer::Sampler::Sobol;
    enter("sobol", "power", {"sobol", "power"}, true);
    return result;
}

// Sample counts from a packet's width on, each double the one before, as far as the time goes; two at least.
std::vector<std::int64_t> doubling_within(std::int64_t affordable) {
    constexpr std::int64_t fewest = tracer::lanes<tracer::Packet>;
    std::vector<std::int64_t> counts{fewest, 2 * fewest};
    while (2 * counts.back() <= affordable) counts.push_back(2 * counts.back());
    return counts;
}

}  // namespace

tracer::RenderOptions render_options(std::string_view scene) {
    tracer::RenderOptions options;
    if (scene == "veach" || scene == "veach-metal" || scene == "sky") options.bounces = 1;
    return options;
}

Study render_study(const std::string& scene_name, const std::vector<std::uint64_t>& seeds,
                   const RenderSettings& settings, const Progress& progress) {
    const tracer::SceneEntry& scene = report_scene(scene_name);
    Study study;
    study.name = scene.name;
    study.group = "scenes";
    study.title = scene.title;
    study.description = scene.description;
    study.seeds = seeds;
    study.height = scene.height * settings.width / widest_scene();
    study.width = scene.width * settings.width / widest_scene();
    const tracer::SceneOptions options{study.width, study.height, settings.environment};
    const auto renderer = scene.make(options);
    study.strategies = renderer->strategies();
    const tracer::RenderOptions rendering = render_options(scene_name);
    study.description += rendering.bounces == 1 ? " Direct light."
                                                : " Paths of up to " + std::to_string(rendering.bounces) + " bounces.";

    const ReferenceImage reference =
        reference_image(*renderer, rendering, study.width, study.height, settings.reference_samples,
                        settings.references, study.name, progress);
    study.reference = {"mean of power and balance, " + std::to_string(settings.reference_samples) + " samples each",
                       {},
                       reference.squared_error,
                       reference.relative_squared_error,
                       write(settings.output, study.name + "_reference", reference.image),
                       reference.agreement};

    // A first run finds how many samples fit in the time, and warms the machine up.
    std::vector<Estimator> estimators;
    std::tie(study.series, estimators) = contestants(rendering);
    for (std::size_t i = 0; i < estimators.size(); ++i) {
        Run trial{*renderer, estimators[i], 0, study.width, study.height};
        trial.advance_to(tracer::lanes<tracer::Packet>);
        const double affordable = settings.seconds / trial.cpu_seconds() * tracer::lanes<tracer::Packet>;
        Series& series = study.series[i];
        series.samples = doubling_within(static_cast<std::int64_t>(affordable));
        series.runs_per_seed.assign(series.samples.size(), 1);
    }
    // All integrators take turns, so that a drift of the machine's speed hits all alike.
    std::vector<Film> sums(study.series.size(), Film{study.width, study.height});
    std::vector<std::int64_t> not_finite(study.series.size());
    for (const std::uint64_t seed : seeds) {
        for (std::size_t i = 0; i < study.series.size(); ++i) {
            Series& series = study.series[i];
            progress(study.name + ", " + series.name);
            Run run{*renderer, estimators[i], seed, study.width, study.height};
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
