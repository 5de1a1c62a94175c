// What a study leaves behind: a table on the terminal, a CSV file, and the JSON that the report is drawn from (SCHEMA.md).
#pragma once

#include "settings.hpp"
#include "stiff_study.hpp"
#include "study.hpp"

#include <filesystem>
#include <optional>
#include <span>

namespace convergence {

void print_table(const Study& study);
void write_csv(const std::filesystem::path& file, std::span<const Study> studies);
void write_json(const std::filesystem::path& file, std::span<const Study> studies,
                const std::optional<StiffStudy>& stiff, const Settings& settings);

}  // namespace convergence
