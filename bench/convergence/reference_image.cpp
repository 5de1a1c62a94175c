#include "reference_image.hpp"

#include "agreement.hpp"
#include <lumis/statistics/error_metrics.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace convergence {

using tracer::Image;

bool is_finite(const glm::vec3& pixel) {
    return std::isfinite(pixel.r) && std::isfinite(pixel.g) && std::isfinite(pixel.b);
}

std::int64_t count_not_finite(const Image& image) {
    return std::ranges::count_if(image.pixels, std::not_fn(is_finite));
}

namespace {

Image render(const tracer::Renderer& renderer, const tracer::RenderOptions& options, int width, int height, int samples,
             const char* integrator, std::uint64_t seed, const std::string& name, const Progress& progress) {
    constexpr int longest_pass = 128;  // a few seconds
    tracer::Film film{width, height};
    while (film.samples() < samples) {
        progress(name + ", reference by " + integrator);
        const int count = std::min(longest_pass, samples - film.samples());
        renderer.add_pass(film, integrator, options, {static_cast<std::uint32_t>(film.samples()), count}, seed);
    }
    return film.image();
}

bool newer_than_program(const std::filesystem::path& file) {
    namespace fs = std::filesystem;
    return fs::exists(file) && fs::last_write_time(file) > fs::last_write_time("/proc/self/exe");
}

double mean(const Image& image) {
    Moments moments;
    for (const float value : values(image)) moments.add(value);
    return moments.mean();
}

// Errors are relative to a reference, which has to be finite everywhere and bright somewhere.
void check(const Image& image, const std::string& name, const std::string& integrator) {
    const std::string what = "the reference of " + name + " by " + integrator;
    if (const std::int64_t pixels = count_not_finite(image); pixels > 0) {
        throw std::runtime_error(what + " has " + std::to_string(pixels) + " pixels that are not finite");
    }
    if (!(mean(image) > 0)) throw std::runtime_error(what + " is black");
}

}  // namespace

std::span<const float> values(const Image& image) {
    return {&image.pixels.front().x, 3 * image.pixels.size()};
}

ReferenceImage reference_image(const tracer::Renderer& renderer, const tracer::RenderOptions& options, int width,
                               int height, int samples, const std::filesystem::path& folder, const std::string& name,
                               const Progress& progress) {
    std::filesystem::create_directories(folder);
    const std::array integrators{"power", "balance"};
    std::array<Image, 2> images;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const char* integrator = integrators[i];
        const std::uint64_t seed = 0x5eed0000 + i;  // apart from each other and from those of the runs
        const auto file = folder / (name + "_" + integrator + "_" + std::to_string(samples) + "spp_" +
                                    std::to_string(width) + "x" + std::to_string(height) + ".exr");
        if (!newer_than_program(file)) {
            tracer::write_image(file.string(),
                                render(renderer, options, width, height, samples, integrator, seed, name, progress));
        }
        images[i] = tracer::read_image(file.string());
        check(images[i], name, integrator);
    }
    auto& [power, balance] = images;
    const Agreement agreed = agreement(power, balance);
    if (!(agreed.worst_z <= agreed.limit)) {
        throw std::runtime_error(
            "the references of " + name + " by power and by balance disagree: a block differs by " +
            std::to_string(agreed.worst_z) + " standard errors, more than " + std::to_string(agreed.limit));
    }
    Image middle = power;
    for (std::size_t i = 0; i < middle.pixels.size(); ++i) {
        middle.pixels[i] = 0.5f * (power.pixels[i] + balance.pixels[i]);
    }
    // Half the difference of the two is the error of their middle.
    const double floor = 0.1 * mean(middle);
    const double squared_error = lumis::mean_squared_error(values(power), values(middle));
    const double relative = lumis::relative_mean_squared_error(values(power), values(middle), floor);
    return {std::move(middle), std::move(power), std::move(balance), floor, squared_error, relative, agreed};
}

}  // namespace convergence
