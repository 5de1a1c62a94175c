#include "command_line.hpp"

#include "images/image.hpp"
#include "scenes/scenes.hpp"
#include <lumis/version.hpp>

#include <CLI/CLI.hpp>
#include <oneapi/tbb/info.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <optional>
#include <set>
#include <sstream>

namespace tracer {

namespace {

// The names in a table of the tracer's.
std::vector<std::string> names_of(const auto& table) {
    std::vector<std::string> names;
    for (const auto& entry : table) names.emplace_back(entry.name);
    return names;
}

std::string check_output(const std::string& path) {
    return is_writable_format(path) ? std::string{} : path + " ends neither in .png nor in .exr";
}

std::string check_seconds(const std::string& text) {
    const double seconds = std::atof(text.c_str());
    return seconds > 0 && std::isfinite(seconds) ? std::string{} : text + " is no positive number";
}

std::string check_finite(const std::string& text) {
    return std::isfinite(std::strtof(text.c_str(), nullptr)) ? std::string{} : text + " is no finite number";
}

std::string check_angle(const std::string& text) {
    const float degrees = std::strtof(text.c_str(), nullptr);
    return degrees > 0 && degrees < 180 ? std::string{} : text + " is no angle between 0 and 180 degrees";
}

// Numbers below 0 are refused here: -1 would count as 2^64 - 1.
std::string check_seed(const std::string& text) {
    return text.starts_with('-') ? text + " is negative" : std::string{};
}

// Makes "0.01" of "1%".
std::string transform_error(std::string& text) {
    const bool is_percentage = text.ends_with('%');
    const std::string number = is_percentage ? text.substr(0, text.size() - 1) : text;
    char* end = nullptr;
    const double error = std::strtod(number.c_str(), &end) * (is_percentage ? 0.01 : 1);
    if (number.empty() || *end != '\0' || !(error > 0 && error < 1)) {
        return text + " is no error between 0 and 100 %, such as 1% or 0.01";
    }
    if (is_percentage) text = CLI::detail::to_string(error);
    return {};
}

// What no option by itself shows.
void check_together(const Settings& settings, bool has_environment, bool has_mesh) {
    if (has_environment && !find_scene(settings.scene)->has_sky) {
        throw CLI::ValidationError("--env", "the scene " + settings.scene + " has no sky");
    }
    if (has_environment && settings.environment.empty()) throw CLI::ValidationError("--env", "the file has no name");
    if (has_mesh && settings.scene != "mesh") {
        throw CLI::ValidationError("--mesh", "the scene " + settings.scene + " has no mesh");
    }
    if (has_mesh && settings.mesh.empty()) throw CLI::ValidationError("--mesh", "the file has no name");
    std::set<std::filesystem::path> files;
    const auto require_new = [&](const std::string& option, const std::string& file) {
        if (file.empty() || files.insert(weakly_canonical(absolute(std::filesystem::path{file}))).second) return;
        throw CLI::ValidationError(option, file + " is named twice");
    };
    for (const std::string& output : settings.outputs) require_new("--output", output);
    require_new("--error-output", settings.error_output);
    require_new("--checkpoint", settings.checkpoint);
}

// A camera as a checkpoint keeps it: "eye 1 2 3, field of view 40".
std::string text_of(const CameraOptions& camera) {
    std::ostringstream text;
    text << std::setprecision(std::numeric_limits<float>::max_digits10);
    const auto add = [&](const char* name) -> auto& {
        return text << (text.tellp() > 0 ? ", " : "") << name;
    };
    const auto add_vector = [&](const char* name, const std::optional<glm::vec3>& v) {
        if (v) add(name) << ' ' << v->x << ' ' << v->y << ' ' << v->z;
    };
    add_vector("eye", camera.eye);
    add_vector("target", camera.target);
    add_vector("up", camera.up);
    if (camera.field_of_view) add("field of view") << ' ' << *camera.field_of_view;
    return text.tellp() > 0 ? text.str() : "the scene's own";
}

}  // namespace

Origin origin_of(const Settings& settings) {
    return {{"version", std::to_string(LUMIS_VERSION)},
            {"scene", settings.scene},
            {"env", settings.environment.empty() ? "the scene's own" : checksum_of_file(settings.environment)},
            {"mesh", settings.mesh.empty() ? "the scene's own" : checksum_of_file(settings.mesh)},
            {"camera", text_of(settings.camera)},
            {"integrator", settings.integrator},
            {"bounces", std::to_string(settings.bounces)},
            {"sampler", settings.sampler},
            {"filter", settings.filter},
            {"seed", std::to_string(settings.seed)}};
}

std::variant<Settings, int> parse_command_line(int argc, char** argv) {
    Settings settings;
    settings.threads = oneapi::tbb::info::default_concurrency();
    int spp = 64;

    CLI::App app{
        "Renders a scene with Lumis: paths, whose every bounce combines the BSDF's samples with the lights'.\n"
        "Ends at whichever of --spp, --seconds and --error is reached first; Ctrl-C writes what there is."};
    const auto add_name = [&](const char* option, std::string& name, const std::vector<std::string>& names,
                              const char* description) {
        return app.add_option(option, name, description)->check(CLI::IsMember(names))->capture_default_str();
    };
    const CLI::Validator is_output{check_output, ""}, is_positive{check_seconds, ""}, is_finite{check_finite, ""},
        is_angle{check_angle, ""};
    const CLI::Range is_size{1, 16384};

    const auto* has_scene = add_name("--scene", settings.scene, names_of(scenes()), "What to render");
    add_name("--integrator", settings.integrator, {integrator_names().begin(), integrator_names().end()},
             "How to estimate its light");
    app.add_option("--bounces,--depth", settings.bounces, "Of a path: 0 shows what emits light, 1 adds direct light")
        ->check(CLI::Range(0, 1 << 16))
        ->capture_default_str();
    add_name("--sampler", settings.sampler, names_of(samplers), "Where the random numbers come from");
    add_name("--filter", settings.filter, names_of(filters), "How a pixel weighs what is around it");
    const auto* has_spp =
        app.add_option("--spp", spp, "Samples a pixel; without limit if --seconds or --error is given")
            ->check(CLI::Range(1, max_samples))
            ->capture_default_str();
    const auto* has_seconds =
        app.add_option("--seconds", settings.limits.seconds, "Ends this run after so long")->check(is_positive);
    const auto* has_error =
        app.add_option("--error", settings.limits.error, "Ends when the relative error is estimated to be less, as 1%")
            ->transform(CLI::Validator{transform_error, ""});
    app.add_option("--seed", settings.seed, "Of the random numbers")
        ->check(CLI::Validator{check_seed, ""})
        ->capture_default_str();
    app.add_option("--threads", settings.threads, "The image does not depend on them")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app.add_option("--width", settings.width, "In pixels; the scene's own by default")->check(is_size);
    app.add_option("--height", settings.height, "In pixels; the scene's own by default")->check(is_size);
    const auto* has_environment =
        app.add_option("--env", settings.environment,
                       "Environment map of the scenes sky and mesh, latitude-longitude: .hdr, .exr or .png");
    const auto* has_mesh =
        app.add_option("--mesh", settings.mesh, "OBJ file of the scene mesh, which it implies; y is up");
    const auto add_vector = [&](const char* option, std::optional<glm::vec3>& v, const char* description) {
        using Numbers = std::array<float, 3>;
        const auto set = [&v](const Numbers& x) { v = glm::vec3{x[0], x[1], x[2]}; };
        app.add_option_function<Numbers>(option, set, description)->type_name("X Y Z")->check(is_finite);
    };
    add_vector("--eye", settings.camera.eye, "Where the camera stands; the scene's own by default, as is what follows");
    add_vector("--target", settings.camera.target, "What it looks at");
    add_vector("--up", settings.camera.up, "Which way is up in the image");
    app.add_option("--field-of-view,--fov", settings.camera.field_of_view, "In degrees, on the image's smaller side")
        ->check(is_angle);
    app.add_option(
           "--output", settings.outputs,
           "A .png for the eye, a .exr for the linear values and layers (albedo, normal, variance, samples), or "
           "both")
        ->check(is_output)
        ->capture_default_str();
    app.add_option("--error-output", settings.error_output, "The standard error of each pixel, as an image of its own")
        ->check(is_output);
    auto* checkpoint = app.add_option("--checkpoint", settings.checkpoint,
                                      "Saves the rendering there now and then, at the end, and at Ctrl-C");
    app.add_option("--checkpoint-seconds", settings.checkpoint_seconds, "How often")
        ->check(is_positive)
        ->needs(checkpoint)
        ->capture_default_str();
    app.add_flag("--resume", settings.resume, "Continues from the checkpoint, if it is there")->needs(checkpoint);
    app.add_flag("--list", settings.list_only, "Show the scenes and integrators");

    try {
        app.parse(argc, argv);
        if (checkpoint->count() > 0 && settings.checkpoint.empty()) {
            throw CLI::ValidationError("--checkpoint", "the file has no name");
        }
        if (has_mesh->count() > 0 && has_scene->count() == 0) settings.scene = "mesh";
        check_together(settings, has_environment->count() > 0, has_mesh->count() > 0);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    const bool is_limited = has_seconds->count() > 0 || has_error->count() > 0;
    if (has_spp->count() > 0 || !is_limited) settings.limits.samples = spp;
    return settings;
}

}  // namespace tracer
