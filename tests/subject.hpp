// What the laws run over: a strategy with a chart that is dense where its density is.
#pragma once

#include <lumis/testing/agreement.hpp>
#include <lumis/testing/charts.hpp>
#include <lumis/testing/result.hpp>

#include <optional>
#include <string>

namespace subjects {

template <class S>
struct Subject {
    std::string label;
    S strategy;
    lumis::testing::DirectionChart chart;
    std::optional<double> probability = 1.0;  // of something being drawn; none: to be counted
    double blur = 0;  // by how much a slack for rounding at the support's edge may raise the integral, relative
    lumis::testing::AgreementOptions agreement{};
};

template <class... Parts>
std::string label(const Parts&... parts) {
    return lumis::testing::detail::text(parts...);
}

}  // namespace subjects
