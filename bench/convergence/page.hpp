// The page of a run: index.html beside results.json.
#pragma once

#include <filesystem>

namespace convergence {

// Measures the extreme cases into the same folder, by the program `stability`.
void measure_extremes(const std::filesystem::path& folder);

// Draws the page of what the folder holds, by report/report.py, which prints where it is.
void draw_page(const std::filesystem::path& folder);

}  // namespace convergence
