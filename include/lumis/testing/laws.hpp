// Laws that every strategy keeps, for the tests here and for users' own: one include, one line a law, any framework.
//     agreement(strategy)                 what sample draws, pdf agrees with
//     integrates(strategy, chart)         the density integrates to the probability that something is drawn
//     chi_square(strategy, chart)         samples are distributed as the density says
//     stays_finite(strategy)              no NaN, infinity or negative density, whatever it is asked
//     draws_nothing(strategy)             the same, of one that has nothing to draw
//     unbiased(estimate, answer)          an estimator's mean is the answer
// Each yields a LawResult. Needs Boost.Math; nothing else in Lumis includes this folder.
#pragma once

#include "lumis/testing/agreement.hpp"
#include "lumis/testing/charts.hpp"
#include "lumis/testing/chi_square.hpp"
#include "lumis/testing/integration.hpp"
#include "lumis/testing/result.hpp"
#include "lumis/testing/stability.hpp"
#include "lumis/testing/unbiased.hpp"
