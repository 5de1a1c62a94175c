#include "row.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace stability {

namespace {

using nlohmann::json;

json number(const std::optional<double>& value) {
    return value && is_finite(*value) ? json(*value) : json(nullptr);
}

std::string text(const std::optional<double>& value, const char* format = "%.2g") {
    if (!value) return "-";
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, format, *value);
    return buffer;
}

json row_json(const Row& row) {
    const Measured& m = row.measured;
    return {{"kernel", row.kernel},
            {"case", row.swept},
            {"scalar", row.scalar},
            {"evaluations", m.evaluations()},
            {"misbehaved", m.misbehaved()},
            {"reference", row.reference},
            {"has_error", m.worst_error().has_value()},
            {"worst_error", number(m.worst_error())},
            {"error_limit", number(row.error_limit)},
            {"has_usual", m.usual_error().has_value()},
            {"usual_error", number(m.usual_error())},
            {"has_z", m.worst_z().has_value()},
            {"worst_z", number(m.worst_z())},
            {"z_limit", z_limit},
            {"standard_error", m.worst_z() ? number(m.standard_error()) : json(nullptr)},
            {"cpu_seconds", row.cpu_seconds},
            {"passed", row.passed()}};
}

}  // namespace

void print_heading() {
    std::printf("%-4s %-22s %-6s %12s %6s %8s %8s %8s %6s %8s %6s  %s\n", "", "kernel", "scalar", "evaluations",
                "broken", "error", "limit", "usual", "|z|", "st.err.", "CPU s", "swept");
}

void print(const Row& row) {
    const Measured& m = row.measured;
    const bool estimated = m.worst_z().has_value();
    std::printf("%-4s %-22s %-6s %12llu %6llu %8s %8s %8s %6s %8s %6.2f  %s\n", row.passed() ? "ok" : "FAIL",
                row.kernel.c_str(), row.scalar.c_str(), static_cast<unsigned long long>(m.evaluations()),
                static_cast<unsigned long long>(m.misbehaved()), text(m.worst_error()).c_str(),
                text(m.worst_error() ? row.error_limit : std::nullopt).c_str(), text(m.usual_error()).c_str(),
                text(m.worst_z(), "%.1f").c_str(),
                text(estimated ? std::optional{m.standard_error()} : std::nullopt).c_str(), row.cpu_seconds,
                row.swept.c_str());
    std::fflush(stdout);
}

void print_markdown(std::span<const Row> rows) {
    std::printf(
        "| kernel | swept | scalar | evaluations | broken | worst error | limit | usual formula | worst \\|z\\| | "
        "standard error | |\n| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n");
    for (const Row& row : rows) {
        const Measured& m = row.measured;
        const bool estimated = m.worst_z().has_value();
        std::printf("| %s | %s | %s | %llu | %llu | %s | %s | %s | %s | %s | %s |\n", row.kernel.c_str(),
                    row.swept.c_str(), row.scalar.c_str(), static_cast<unsigned long long>(m.evaluations()),
                    static_cast<unsigned long long>(m.misbehaved()), text(m.worst_error()).c_str(),
                    text(m.worst_error() ? row.error_limit : std::nullopt).c_str(), text(m.usual_error()).c_str(),
                    text(m.worst_z(), "%.1f").c_str(),
                    text(estimated ? std::optional{m.standard_error()} : std::nullopt).c_str(),
                    row.passed() ? "ok" : "**FAIL**");
    }
}

void write_json(const std::filesystem::path& file, std::span<const Row> rows, bool quick) {
    json result{{"schema", 1}, {"quick", quick}, {"rows", json::array()}};
    for (const Row& row : rows) result["rows"].push_back(row_json(row));
    std::ofstream out{file};
    out << result.dump(2) << '\n';
    out.close();
    if (!out) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace stability
