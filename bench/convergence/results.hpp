// What a study leaves behind: a table on the terminal, a CSV file, and the JSON that the report is drawn from (SCHEMA.md).
#pragma once

#include "stiff_study.hpp"
#include "study.hpp"

#include <filesystem>
#include <span>

namespace convergence {

void print_table(const Study& study);
void write_csv(const std::filesystem::path& file, std::span<const Study> studies);
void write_json(const std::filesystem::path& file, std::span<const Study> studies, const StiffStudy& stiff,
                int threads);

}  // namespace convergence
