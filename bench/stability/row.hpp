// A line of the table: a case in float or in double, what it measured, and what it may.
#pragma once

#include "measured.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace stability {

// The limit for about 560 estimates: given new seeds, a correct library would exceed it once in 3000 runs.
inline constexpr double z_limit = 5;

struct Row {
    std::string kernel, swept, scalar;
    std::string reference;              // what the error is against
    std::optional<double> error_limit;  // none where a case has no error to bound
    Measured measured;
    double cpu_seconds;

    // What is not finite fails.
    [[nodiscard]] bool passed() const {
        const auto within = [](const std::optional<double>& worst, double limit) {
            return !worst || (is_finite(*worst) && *worst <= limit);
        };
        const bool accurate = within(measured.worst_error(), error_limit.value_or(0));
        const bool unbiased = within(measured.worst_z(), z_limit);
        return measured.misbehaved() == 0 && measured.evaluations() > 0 && accurate && unbiased;
    }
};

void print_heading();
void print(const Row& row);
void print_markdown(std::span<const Row> rows);
void write_json(const std::filesystem::path& file, std::span<const Row> rows, bool quick);

}  // namespace stability
