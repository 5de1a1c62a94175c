#include "results.hpp"

#include <nlohmann/json.hpp>

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

json file_or_null(const std::string& file) {
    return file.empty() ? json(nullptr) : json(file);
}

std::ofstream open(const std::filesystem::path& file) {
    std::ofstream out{file};
    if (!out) throw std::runtime_error("cannot write " + file.string());
    return out;
}

std::string cpu_model() {
    std::ifstream info{"/proc/cpuinfo"};
    for (std::string line; std::getline(info, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    return "unknown";
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

json point_json(const Series& series, std::size_t point) {
    const auto cpu = series.over_seeds(point, &Measurement::cpu_seconds);
    const auto relative = series.over_seeds(point, &Measurement::relative_squared_error);
    const Estimate rmse = root_mean_square(series, point);
    return {{"samples", series.samples[point]},
            {"cpu_seconds", number(cpu.mean())},
            {"cpu_seconds_standard_error", number(cpu.standard_error())},
            {"wall_seconds", number(series.over_seeds(point, &Measurement::wall_seconds).mean())},
            {"rmse", number(rmse.value)},
            {"rmse_standard_error", number(rmse.standard_error)},
            {"relative_mse", number(relative.mean())},
            {"relative_mse_standard_error", number(relative.standard_error())}};
}

json series_json(const Series& series, const Study& study) {
    const Estimate exponent = slope(series), efficiency = relative_efficiency(series, baseline(study));
    json result{{"name", series.name},
                {"unbiased", series.unbiased},
                {"slope", number(exponent.value)},
                {"slope_standard_error", number(exponent.standard_error)},
                {"efficiency_relative_to_power", number(efficiency.value)},
                {"efficiency_standard_error", number(efficiency.standard_error)}};
    for (std::size_t i = 0; i < series.samples.size(); ++i) result["points"].push_back(point_json(series, i));
    if (series.picture) {
        result["image"] = series.picture->file;
        result["image_spp"] = series.picture->samples;
        result["image_seconds"] = series.picture->cpu_seconds;
        result["fireflies"] = series.picture->fireflies;
    }
    return result;
}

json study_json(const Study& study) {
    json result{{"name", study.name},
                {"title", study.title},
                {"description", study.description},
                {"kind", study.width > 0 ? "render" : "integral"},
                {"strategies", study.strategies},
                {"runs", study.seeds.size()},
                {"reference",
                 {{"source", study.reference.source},
                  {"value", study.reference.value ? number(*study.reference.value) : json(nullptr)},
                  {"rmse", std::sqrt(study.reference.squared_error)},
                  {"relative_mse", study.reference.relative_squared_error},
                  {"image", file_or_null(study.reference.image)}}}};
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
        json errors, z;
        for (const auto& row : study.cells[i]) {
            json error_row, z_row;
            for (const StiffCell& cell : row) {
                error_row.push_back(number(cell.relative_error));
                z_row.push_back(number(cell.bias_z));
            }
            errors.push_back(error_row);
            z.push_back(z_row);
        }
        result["integrators"].push_back({{"name", study.integrators[i]}, {"relative_error", errors}, {"bias_z", z}});
    }
    return result;
}

}  // namespace

void print_table(const Study& study) {
    std::printf("\n%s: %s\n", study.name.c_str(), study.title.c_str());
    for (const std::string& strategy : study.strategies) std::printf("  %s\n", strategy.c_str());
    std::printf("  %-12s %10s %8s %8s  %-21s %-21s %-15s %-17s %s\n", "estimator", "samples", "CPU s", "wall s", "RMSE",
                "relative MSE", "slope", "efficiency/power", "fireflies");
    for (const Series& series : study.series) {
        const std::size_t last = series.samples.size() - 1;
        const Estimate rmse = root_mean_square(series, last), exponent = slope(series);
        const Estimate efficiency = relative_efficiency(series, baseline(study));
        const auto relative = series.over_seeds(last, &Measurement::relative_squared_error);
        std::printf("  %-12s %10lld %8.3f %8.3f  %9.3g +- %-8.2g %9.3g +- %-8.2g %6.3f +- %-5.2g %7.3g +- %-6.2g",
                    series.name.c_str(), static_cast<long long>(series.samples[last]),
                    series.over_seeds(last, &Measurement::cpu_seconds).mean(),
                    series.over_seeds(last, &Measurement::wall_seconds).mean(), rmse.value, rmse.standard_error,
                    relative.mean(), relative.standard_error(), exponent.value, exponent.standard_error,
                    efficiency.value, efficiency.standard_error);
        if (series.picture) std::printf(" %d", series.picture->fireflies);
        std::printf("%s\n", series.unbiased ? "" : " (converges elsewhere)");
    }
}

void write_csv(const std::filesystem::path& file, std::span<const Study> studies) {
    std::ofstream out = open(file);
    out << "problem,estimator,samples,cpu_seconds,cpu_seconds_se,wall_seconds,rmse,rmse_se,relative_mse,relative_mse_"
           "se,"
           "slope,slope_se,efficiency_relative_to_power,efficiency_se\n";
    for (const Study& study : studies) {
        for (const Series& series : study.series) {
            const Estimate exponent = slope(series), efficiency = relative_efficiency(series, baseline(study));
            for (std::size_t i = 0; i < series.samples.size(); ++i) {
                const auto cpu = series.over_seeds(i, &Measurement::cpu_seconds);
                const auto relative = series.over_seeds(i, &Measurement::relative_squared_error);
                const Estimate rmse = root_mean_square(series, i);
                out << study.name << ',' << series.name << ',' << series.samples[i] << ',' << cpu.mean() << ','
                    << cpu.standard_error() << ',' << series.over_seeds(i, &Measurement::wall_seconds).mean() << ','
                    << rmse.value << ',' << rmse.standard_error << ',' << relative.mean() << ','
                    << relative.standard_error() << ',' << exponent.value << ',' << exponent.standard_error << ','
                    << efficiency.value << ',' << efficiency.standard_error << '\n';
            }
        }
    }
}

void write_json(const std::filesystem::path& file, std::span<const Study> studies, const StiffStudy& stiff,
                int threads) {
    json result{{"schema", 1},
                {"machine",
                 {{"cpu", cpu_model()},
                  {"threads", threads},
                  {"compiler", compiler()},
                  {"flags", LUMIS_CXX_FLAGS},
                  {"date", today()}}},
                {"settings", {{"seeds", studies.front().seeds}}}};
    result["stiff"] = stiff_json(stiff);
    for (const Study& study : studies) result["problems"].push_back(study_json(study));
    open(file) << result.dump(2) << '\n';
}

}  // namespace convergence
