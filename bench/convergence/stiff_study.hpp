// Near-mirror reflection of lights of all sizes: where each estimator breaks, at equal run time.
#pragma once

#include "study.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace convergence {

// The outcome of one estimator for one roughness and one size of the light.
struct StiffCell {
    double relative_error;     // root mean square over the runs, of the answer
    double bias_z;             // mean error over its standard error
    std::uint64_t not_finite;  // estimates of all runs
};

struct StiffStudy {
    std::vector<double> alphas, solid_angles;  // of the surface, in steradians
    double seconds;                            // CPU time of each run
    int runs;
    std::vector<std::string> integrators;
    std::vector<std::vector<std::vector<StiffCell>>> cells;  // by integrator, alpha, solid angle

    // The largest relative error of an integrator over all cases; NaN if one is not finite.
    [[nodiscard]] double worst_error(std::size_t integrator) const;
};

[[nodiscard]] StiffStudy stiff_study(int runs, double seconds, const Progress& progress);

void print_table(const StiffStudy& study);

}  // namespace convergence
