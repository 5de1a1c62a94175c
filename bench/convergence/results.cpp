#include "results.hpp"

#include "error_image.hpp"
#include "revision.hpp"

#include <nlohmann/json.hpp>
#include <sys/utsname.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <stdexcept>

namespace convergence {

namespace {

using nlohmann::json;

// In columns and in keys, a figure and its standard error stand side by side.
json number(double value) {
    return std::isfinite(value) ? json(value) : json(nullptr);
}

// As the terminal and the CSV file show it: a dash, or nothing, where there is no number.
std::string text(const char* format, double value, const char* none) {
    std::array<char, 32> result{};
    if (!std::isfinite(value)) return none;
    std::snprintf(result.data(), result.size(), format, value);
    return result.data();
}

std::string with_error(const char* format, double value, double error) {
    return text(format, value, "-") + (std::isfinite(value) ? " +- " + text("%.2g", error, "-") : "");
}

json text_or_null(const std::string& text) {
    return text.empty() ? json(nullptr) : json(text);
}

std::ofstream open(const std::filesystem::path& file) {
    std::ofstream out{file};
    if (!out) throw std::runtime_error("cannot write " + file.string());
    return out;
}

#ifdef NDEBUG
constexpr bool assertions = false;
#else
constexpr bool assertions = true;
#endif

std::string cpu_model() {
    std::ifstream info{"/proc/cpuinfo"};
    for (std::string line; std::getline(info, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    return "unknown";
}

std::string operating_system() {
    utsname system{};
    uname(&system);
    return std::string{system.sysname} + " " + system.release + ", " + system.machine;
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    char text[16];
    std::strftime(text, sizeof text, "%F", std::localtime(&now));
    return text;
}

std::string compiler() {
#if defined(__clang__)
    return "clang++ " __clang_version__;
#else
    return "g++ " __VERSION__;
#endif
}

json numbers_or_null(const auto& values) {
    return values.empty() ? json(nullptr) : json(values);
}

json effort_json(const std::optional<Effort>& effort) {
    if (!effort) return nullptr;
    return {{"samples", number(effort->samples)},
            {"cpu_seconds", number(effort->cpu_seconds)},
            {"extrapolated", effort->extrapolated}};
}

json spread_json(const Spread& spread) {
    if (std::isnan(spread.median)) return nullptr;
    return {spread.least, spread.lower_quartile, spread.median, spread.upper_quartile, spread.largest};
}

json point_json(const Series& series, std::size_t point) {
    const auto cpu = series.over_seeds(point, &Measurement::cpu_seconds);
    const auto relative = series.over_seeds(point, &Measurement::relative_squared_error);
    const Estimate rmse = root_mean_square(series, point);
    const Band band = relative_error(series, point);
    return {{"samples", series.samples[point]},
            {"runs", series.runs_per_seed[point] * static_cast<std::int64_t>(series.runs.size())},
            {"cpu_seconds", number(cpu.mean())},
            {"cpu_seconds_standard_error", number(cpu.standard_error())},
            {"wall_seconds", number(series.over_seeds(point, &Measurement::wall_seconds).mean())},
            {"rmse", number(rmse.value)},
            {"rmse_standard_error", number(rmse.standard_error)},
            {"relative_mse", number(relative.mean())},
            {"relative_mse_standard_error", number(relative.standard_error())},
            {"relative_rmse", number(band.value)},
            {"relative_rmse_low", number(band.low)},
            {"relative_rmse_high", number(band.high)}};
}

json series_json(const Series& series, const Study& study) {
    const Estimate exponent = slope(series), per_second = efficiency(series),
                   relative = relative_efficiency(series, baseline(study));
    json result{{"name", series.name},
                {"model", series.recipe.model},
                {"heuristic", text_or_null(series.recipe.heuristic)},
                {"counts", numbers_or_null(series.recipe.counts)},
                {"probabilities", numbers_or_null(series.recipe.probabilities)},
                {"headline", series.headline},
                {"whole_runs", series.is_whole},
                {"unbiased", series.unbiased},
                {"verdict", name(verdict(series))},
                {"not_finite", series.pooled.not_finite},
                {"evaluated", series.pooled.evaluated},
                {"mean", number(series.pooled.mean)},
                {"mean_standard_error", number(series.pooled.standard_error)},
                {"bias_z", number(series.pooled.bias_z)},
                {"tail_share", number(series.pooled.tail_share)},
                {"spread", spread_json(spread(series))},
                {"to_10_percent", effort_json(effort_to(series, 0.1))},
                {"to_1_percent", effort_json(effort_to(series, 0.01))},
                {"slope", number(exponent.value)},
                {"slope_standard_error", number(exponent.standard_error)},
                {"efficiency", number(per_second.value)},
                {"efficiency_relative_to_power", number(relative.value)},
                {"efficiency_standard_error", number(relative.standard_error)}};
    for (std::size_t i = 0; i < series.samples.size(); ++i) result["points"].push_back(point_json(series, i));
    if (series.picture) {
        result["image"] = series.picture->file;
        result["error_image"] = series.picture->error_file;
        result["image_spp"] = series.picture->samples;
        result["image_seconds"] = series.picture->cpu_seconds;
        result["fireflies"] = series.picture->fireflies;
    }
    return result;
}

json variant_json(const Variant& variant) {
    const auto& count = variant.instructions_per_sample;
    return {{"cpu_seconds_per_sample", number(variant.seconds_per_sample.mean())},
            {"cpu_seconds_per_sample_standard_error", number(variant.seconds_per_sample.standard_error())},
            {"instructions_per_sample", count ? json(*count) : json(nullptr)},
            {"relative_mse", number(variant.relative_squared_error.mean())},
            {"relative_mse_standard_error", number(variant.relative_squared_error.standard_error())}};
}

json left_out_json(const LeftOut& left_out) {
    const auto& [strategies, materials, composed, everything, seconds, instructions_by] = left_out;
    const Estimate time = ratio(everything.seconds_per_sample, composed.seconds_per_sample);
    json result{{"strategies", strategies},
                {"materials", materials},
                {"composed", variant_json(composed)},
                {"everything", variant_json(everything)},
                {"seconds", seconds},
                {"instructions_by", instructions_by},
                {"time_ratio", number(time.value)},
                {"time_ratio_standard_error", number(time.standard_error)},
                {"instructions_ratio", nullptr}};
    if (composed.instructions_per_sample && everything.instructions_per_sample) {
        result["instructions_ratio"] = *everything.instructions_per_sample / *composed.instructions_per_sample;
    }
    return result;
}

json study_json(const Study& study) {
    json result{{"name", study.name},
                {"title", study.title},
                {"description", study.description},
                {"group", study.group},
                {"kind", study.width > 0 ? "render" : "integral"},
                {"strategies", study.strategies},
                {"runs", study.seeds.size()},
                {"reference",
                 {{"source", study.reference.source},
                  {"value", study.reference.value ? number(*study.reference.value) : json(nullptr)},
                  {"rmse", std::sqrt(study.reference.squared_error)},
                  {"relative_mse", study.reference.relative_squared_error},
                  {"image", text_or_null(study.reference.image)}}}};
    if (study.reference.value) result["reference"]["value_error"] = std::sqrt(study.reference.squared_error);
    if (const auto& agreed = study.reference.agreement) {
        result["reference"]["agreement"] = {{"integrators", {"power", "balance"}},
                                            {"block", agreed->block},
                                            {"blocks", agreed->blocks},
                                            {"worst_z", number(agreed->worst_z)},
                                            {"limit", agreed->limit}};
    }
    if (study.left_out) result["left_out"] = left_out_json(*study.left_out);
    if (study.width > 0) result.update({{"width", study.width}, {"height", study.height}});
    for (const Series& series : study.series) result["integrators"].push_back(series_json(series, study));
    return result;
}

json stiff_json(const StiffStudy& study) {
    json result{{"alphas", study.alphas},
                {"solid_angles", study.solid_angles},
                {"seconds", study.seconds},
                {"runs", study.runs}};
    for (std::size_t i = 0; i < study.integrators.size(); ++i) {
        json errors, z, not_finite;
        for (const auto& row : study.cells[i]) {
            json error_row, z_row, not_finite_row;
            for (const StiffCell& cell : row) {
                error_row.push_back(number(cell.relative_error));
                z_row.push_back(number(cell.bias_z));
                not_finite_row.push_back(cell.not_finite);
            }
            errors.push_back(error_row);
            z.push_back(z_row);
            not_finite.push_back(not_finite_row);
        }
        result["integrators"].push_back(
            {{"name", study.integrators[i]}, {"relative_error", errors}, {"bias_z", z}, {"not_finite", not_finite}});
    }
    return result;
}

}  // namespace

void print_table(const Study& study) {
    std::printf("\n%s: %s\n", study.name.c_str(), study.title.c_str());
    for (const std::string& strategy : study.strategies) std::printf("  %s\n", strategy.c_str());
    std::printf("  %-24s %10s %8s %-21s %-21s %-16s %-18s %8s %s\n", "estimator", "samples", "CPU s", "RMSE",
                "relative MSE", "slope", "efficiency/power", "bias z", "verdict");
    for (const Series& series : study.series) {
        if (!series.headline) continue;
        const std::size_t last = series.samples.size() - 1;
        const Estimate rmse = root_mean_square(series, last), exponent = slope(series);
        const Estimate efficiency = relative_efficiency(series, baseline(study));
        const auto relative = series.over_seeds(last, &Measurement::relative_squared_error);
        std::printf("  %-24s %10lld %8.3g %-21s %-21s %-16s %-18s %8s %s", series.name.c_str(),
                    static_cast<long long>(series.samples[last]),
                    series.over_seeds(last, &Measurement::cpu_seconds).mean(),
                    with_error("%9.3g", rmse.value, rmse.standard_error).c_str(),
                    with_error("%9.3g", relative.mean(), relative.standard_error()).c_str(),
                    with_error("%6.3f", exponent.value, exponent.standard_error).c_str(),
                    with_error("%7.3g", efficiency.value, efficiency.standard_error).c_str(),
                    text("%.3g", series.pooled.bias_z, "-").c_str(), name(verdict(series)).data());
        if (series.pooled.not_finite > 0) {
            std::printf(": %lld of %lld %s", static_cast<long long>(series.pooled.not_finite),
                        static_cast<long long>(series.pooled.evaluated), study.width > 0 ? "pixels" : "samples");
        }
        if (series.picture) std::printf(", %d fireflies", series.picture->fireflies);
        std::printf("%s\n", series.unbiased ? "" : " (in theory it converges elsewhere)");
    }
    if (const auto& left_out = study.left_out) {
        const Estimate time = ratio(left_out->everything.seconds_per_sample, left_out->composed.seconds_per_sample);
        std::printf("  with everything in: %.3f +- %.2g times the time", time.value, time.standard_error);
        const auto &composed = left_out->composed.instructions_per_sample,
                   &everything = left_out->everything.instructions_per_sample;
        if (composed && everything) std::printf(", %.3f times the instructions", *everything / *composed);
        std::printf("\n");
    }
}

void write_csv(const std::filesystem::path& file, std::span<const Study> studies) {
    std::ofstream out = open(file);
    out << "problem,estimator,verdict,not_finite,samples,cpu_seconds,cpu_seconds_se,wall_seconds,rmse,rmse_se,"
           "relative_mse,relative_mse_se,slope,slope_se,efficiency,efficiency_relative_to_power,"
           "efficiency_relative_to_power_se\n";
    for (const Study& study : studies) {
        for (const Series& series : study.series) {
            const Estimate exponent = slope(series), efficiency = relative_efficiency(series, baseline(study));
            const double per_second = convergence::efficiency(series).value;
            for (std::size_t i = 0; i < series.samples.size(); ++i) {
                const auto cpu = series.over_seeds(i, &Measurement::cpu_seconds);
                const auto relative = series.over_seeds(i, &Measurement::relative_squared_error);
                const Estimate rmse = root_mean_square(series, i);
                out << study.name << ',' << series.name << ',' << name(verdict(series)) << ','
                    << series.pooled.not_finite << ',' << series.samples[i];
                for (const double figure :
                     {cpu.mean(), cpu.standard_error(), series.over_seeds(i, &Measurement::wall_seconds).mean(),
                      rmse.value, rmse.standard_error, relative.mean(), relative.standard_error(), exponent.value,
                      exponent.standard_error, per_second, efficiency.value, efficiency.standard_error}) {
                    out << ',' << text("%.6g", figure, "");
                }
                out << '\n';
            }
        }
    }
}

void write_json(const std::filesystem::path& file, std::span<const Study> studies,
                const std::optional<StiffStudy>& stiff, const Settings& settings) {
    json result{{"schema", 1}, {"problems", json::array()}};
    result["machine"] = {{"cpu", cpu_model()},     {"threads", settings.threads}, {"system", operating_system()},
                         {"compiler", compiler()}, {"flags", LUMIS_CXX_FLAGS},    {"date", today()}};
    result["build"] = {{"version", LUMIS_PROJECT_VERSION},
                       {"revision", text_or_null(revision)},
                       {"type", LUMIS_BUILD_TYPE},
                       {"assertions", assertions}};
    result["arguments"] = settings.arguments();
    result["settings"] = {{"seeds", settings.seeds},
                          {"seconds_of_each_run_of_a_scene", settings.seconds},
                          {"seconds_of_each_run_of_an_integral", settings.seconds_of_integrals()},
                          {"reference_samples", settings.reference_samples},
                          {"widest_image", settings.width}};
    result["rules"] = {{"bias_z_limit", Rules::bias_z_limit},
                       {"tail_share_limit", Rules::tail_share_limit},
                       {"tail_share_limit_of_images", Rules::tail_share_limit_of_images},
                       {"slope_significance", Rules::slope_significance}};
    result["error_scale"] = {{"low", ErrorScale::low}, {"high", ErrorScale::high}};
    for (const Study& study : studies) result["problems"].push_back(study_json(study));
    if (stiff) result["stiff"] = stiff_json(*stiff);
    open(file) << result.dump(2) << '\n';
}

}  // namespace convergence
