// The estimators of direct light, each a way to compose a BSDF's strategy with a light's.
#pragma once

#include <lumis/lumis.hpp>

#include <string_view>

namespace tracer {

struct BsdfAlone {
    static constexpr std::string_view name = "bsdf";
    static auto compose(const auto& bsdf, const auto& /*light*/) {
        return multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, bsdf));
    }
};

struct LightAlone {
    static constexpr std::string_view name = "light";
    static auto compose(const auto& /*bsdf*/, const auto& light) {
        return multi_sample(lumis::BalanceHeuristic{}, lumis::take(1, light));
    }
};

// One sample of each, weighted by a heuristic.
template <class Heuristic>
struct Both {
    static auto compose(const auto& bsdf, const auto& light) {
        return multi_sample(Heuristic{}, lumis::take(1, bsdf), lumis::take(1, light));
    }
};
struct Balance : Both<lumis::BalanceHeuristic> {
    static constexpr std::string_view name = "balance";
};
struct Power : Both<lumis::PowerHeuristic> {
    static constexpr std::string_view name = "power";
};
struct Average : Both<lumis::EqualWeights> {
    static constexpr std::string_view name = "average";
};

// One sample of either.
struct OneOfBoth {
    static constexpr std::string_view name = "one-sample";
    static auto compose(const auto& bsdf, const auto& light) {
        return one_sample(lumis::BalanceHeuristic{}, lumis::choose(0.5f, bsdf), lumis::choose(0.5f, light));
    }
};

}  // namespace tracer
