// Measures a problem: every estimator, error against run time.
#pragma once

#include "problem.hpp"

namespace convergence {

// seconds: CPU time of each run, one for each estimator and seed.
[[nodiscard]] Study problem_study(const std::string& name, const Problem& problem,
                                  const std::vector<std::uint64_t>& seeds, double seconds, const Progress& progress);

}  // namespace convergence
