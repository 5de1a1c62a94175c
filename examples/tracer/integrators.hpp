// The estimators of direct light, each a way to compose a BSDF's strategy with those of the lights.
#pragma once

#include <lumis/lumis.hpp>

#include <algorithm>
#include <string_view>
#include <tuple>

namespace tracer {

// A light as seen from a point. One that stays below the point's horizon is left out of the estimate there: its count is
// 0. S is a strategy, or a reference to one that is too large to copy.
template <class S>
struct Light {
    S strategy;
    bool risen;
};

[[nodiscard]] auto take_light(const auto& light) {
    return lumis::take(light.risen ? 1 : 0, light.strategy);
}

// Where no light has risen, sampling the BSDF finds none either.
[[nodiscard]] auto take_bsdf(const auto& bsdf, const auto&... lights) {
    return lumis::take((lights.risen || ...) ? 1 : 0, bsdf);
}

struct BsdfAlone {
    static constexpr std::string_view name = "bsdf";
    static auto compose(const auto& bsdf, const auto&... lights) {
        return multi_sample(lumis::BalanceHeuristic{}, take_bsdf(bsdf, lights...));
    }
};

struct LightAlone {
    static constexpr std::string_view name = "light";
    static auto compose(const auto& /*bsdf*/, const auto&... lights) {
        return multi_sample(lumis::BalanceHeuristic{}, take_light(lights)...);
    }
};

// One sample of each, weighted by a heuristic.
template <class Heuristic>
struct All {
    static auto compose(const auto& bsdf, const auto&... lights) {
        return multi_sample(Heuristic{}, take_bsdf(bsdf, lights...), take_light(lights)...);
    }
};
struct Balance : All<lumis::BalanceHeuristic> {
    static constexpr std::string_view name = "balance";
};
struct Power : All<lumis::PowerHeuristic> {
    static constexpr std::string_view name = "power";
};
struct Average : All<lumis::EqualWeights> {
    static constexpr std::string_view name = "average";
};

// One sample of the BSDF, or else of one of the lights that have risen.
struct OneOfAll {
    static constexpr std::string_view name = "one-sample";
    static auto compose(const auto& bsdf, const auto&... lights) {
        const int risen = (int{lights.risen} + ...);
        const float half = risen > 0 ? 0.5f : 0.0f, share = half / static_cast<float>(std::max(risen, 1));
        return one_sample(lumis::BalanceHeuristic{}, lumis::choose(half, bsdf),
                          lumis::choose(lights.risen ? share : 0.0f, lights.strategy)...);
    }
};

using AllIntegrators = std::tuple<BsdfAlone, LightAlone, Balance, Power, OneOfAll, Average>;

}  // namespace tracer
