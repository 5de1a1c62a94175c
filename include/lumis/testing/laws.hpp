// Laws that every strategy keeps, for the tests here and for users' own: one include, one line a law, any framework.
//     agreement(strategy)                 what sample draws, pdf agrees with
//     integrates(strategy, chart)         the density integrates to the probability that something is drawn
//     covers(strategy, f, chart)          the density is positive wherever the integrand f is not 0
//     chi_square(strategy, chart)         samples are distributed as the density says
//     jacobian(strategy)                  the density is 1 / |det J| of sample
//     round_trip(strategy)                invert undoes sample
//     draws_deltas(strategy)              a delta strategy has no density, and a probability
//     stays_finite(strategy)              no NaN, infinity or negative density, whatever it is asked
//     draws_nothing(strategy)             the same, of one that has nothing to draw
//     stays_near(in_float, in_double)     float draws nearly what double draws
//     stability(parameters, make)         finite, and float near double, over a sweep
//     unbiased(estimate, answer)          an estimator's mean is the answer
//     agreement(estimate, other)          two estimators have the same mean
//     unbiased_under_every_heuristic(f, answer, factors, options, strategies...)
//                                         the same, of strategies combined in all ways, or of an estimator of one's own
//     weighs(strategy, f_cos)             the weight that a material's samples report is f cos / pdf
//     is_reciprocal(f)                    a material looks the same both ways
//     conserves_energy(f, wo, chart)      a material gives no more light than it gets
// With Sequential{false_alarm, at_most} as their last argument, chi_square, and unbiased and agreement of estimates with a bound,
// stop as soon as they know.
// Each yields a LawResult, which tests as a bool and prints itself. Needs Boost.Math; nothing else in Lumis includes this folder.
#pragma once

#include "lumis/testing/agreement.hpp"
#include "lumis/testing/bounded.hpp"
#include "lumis/testing/charts.hpp"
#include "lumis/testing/chi_square.hpp"
#include "lumis/testing/coverage.hpp"
#include "lumis/testing/delta.hpp"
#include "lumis/testing/every_heuristic.hpp"
#include "lumis/testing/integration.hpp"
#include "lumis/testing/jacobian.hpp"
#include "lumis/testing/materials.hpp"
#include "lumis/testing/points.hpp"
#include "lumis/testing/result.hpp"
#include "lumis/testing/round_trip.hpp"
#include "lumis/testing/sequential.hpp"
#include "lumis/testing/stability.hpp"
#include "lumis/testing/two_estimators.hpp"
#include "lumis/testing/unbiased.hpp"
