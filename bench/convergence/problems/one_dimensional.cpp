// The two one-dimensional problems: a technique that is blind to most of the integral, and one that is too narrow.
#include "one_dimensional.hpp"

#include "problem.hpp"
#include <lumis/combine/mixture.hpp>

namespace {

using namespace convergence;

const Registered step{
    "step", [] {
        const Technique uniform{"uniform on [0, 1)", everywhere}, blind{"uniform on [0.9, 1)", above, false};
        Problem problem{
            "one-dimensional", "A step",
            "8 below 0.9 and 80 above. The second technique sees only what lies above: alone it converges to 8.",
            Answer{Step::integral}};
        return problem.compare(Step{}, Partition{[](double x) { return x < 0.9 ? 0 : 1; }}, uniform, blind);
    }};

const Registered bumps{
    "bumps", [] {
        const Technique gaussian{"narrow Gaussian", too_narrow};
        const Technique uniform{"uniform on [0, 1)", everywhere};
        const Technique defensive{"defensive",
                                  lumis::Mixture{lumis::choose(0.5, too_narrow), lumis::choose(0.5, everywhere)}};
        Problem problem{
            "one-dimensional", "Two bumps and a bad sampler",
            "A broad and a narrow bump. The Gaussian fits the narrow one; where it meets the broad one it is far "
            "too small, the estimate spikes, the more the longer it runs. Half a constant density mixed in, "
            "\"defensive\", bounds f/p.",
            Answer{TwoBumps::integral()}};
        const Partition near_peak{[](double x) { return std::abs(x - 0.7) < 0.15 ? 0 : 1; }};
        return problem.compare(TwoBumps{}, near_peak, gaussian, uniform).alone(TwoBumps{}, defensive);
    }};

}  // namespace
