// The area of a quarter of the unit disk: a problem of one's own, from integrand to report. See docs/problems.md.
#include "one_dimensional.hpp"
#include "problem.hpp"

#include <cmath>
#include <numbers>

namespace {

using namespace convergence;

// Density 2 (1 - x) over [0, 1]: a strategy made for this integrand.
struct Falling {
    using Scalar = double;
    using Point = double;
    using Measure = lumis::measure::Lebesgue;
    static constexpr int dimensions = 1;

    [[nodiscard]] lumis::Sample<double, double> sample(glm::dvec1 u) const noexcept {
        const double x = 1 - std::sqrt(1 - u.x);
        return {x, pdf(x)};
    }
    [[nodiscard]] double pdf(double x) const noexcept { return x >= 0 && x <= 1 ? 2 * (1 - x) : 0; }
};

Problem quarter_circle() {
    const auto height = [](double x) { return std::sqrt(1 - x * x); };
    Problem problem{"one-dimensional", "A quarter of a disk", "The height of a circle over [0, 1].",
                    Answer{std::numbers::pi / 4}};
    return problem.compare(height, Technique{"uniform", everywhere}, Technique{"falling", Falling{}});
}

const Registered registered{"quarter-circle", quarter_circle};

}  // namespace
