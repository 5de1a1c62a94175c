// Studies of one-dimensional integrals whose answers are known in closed form.
#pragma once

#include "study.hpp"

namespace convergence {

// seconds: CPU time of each run.
[[nodiscard]] std::vector<Study> integral_studies(const std::vector<std::uint64_t>& seeds, double seconds,
                                                  const Progress& progress);

}  // namespace convergence
